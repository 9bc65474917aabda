#include "core/image/deep.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/core.h>
#include <glm/vec3.hpp>

#include "core/file.h"

namespace cuticle {
namespace {

bool is_finite(const SeenShare& share) {
  return std::isfinite(share.depth) && std::isfinite(share.light.x + share.light.y + share.light.z + share.light.w);
}

/// One share for each object of each pixel, pixel by pixel.
std::vector<SeenShare> merged(std::vector<SeenShare> shares) {
  std::ranges::stable_sort(shares, [](const SeenShare& a, const SeenShare& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.object < b.object;
  });
  std::vector<SeenShare> whole;
  for (const SeenShare& share : shares) {
    if (whole.empty() || whole.back().pixel != share.pixel || whole.back().object != share.object) {
      whole.push_back(share);
      continue;
    }
    SeenShare& all = whole.back();
    const float sum = all.light.w + share.light.w;
    if (sum > 0) all.depth = (all.depth * all.light.w + share.depth * share.light.w) / sum;
    all.light += share.light;
  }
  return whole;
}

/// Of what the samples before it leave.
DeepSample sample_of(const SeenShare& share, double& left) {
  constexpr double k_least = 1e-6;
  const double opacity = left > k_least ? std::min(double(share.light.w) / left, 1.0) : 0;
  const double scale = left > k_least ? 1 / left : 1 / k_least;
  left *= 1 - opacity;
  return {share.depth, glm::vec4(glm::vec3(share.light) * float(scale), float(opacity)), share.object};
}

Imf::Header header_of(const DeepImage& deep, const std::map<std::string, std::string>& attributes) {
  Imf::Header header(deep.width, deep.height);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.setType(Imf::DEEPSCANLINE);
  for (const char* name : {"R", "G", "B", "A", "Z"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  header.channels().insert("id", Imf::Channel(Imf::UINT));
  for (const auto& [name, text] : attributes) header.insert(name, Imf::StringAttribute(text));
  return header;
}

/// Where OpenEXR finds each pixel's samples of one channel.
class Pointers {
 public:
  Pointers(const DeepImage& deep, std::size_t offset) {
    const char* const first = reinterpret_cast<const char*>(deep.samples.data());
    for (std::size_t p = 0; p + 1 < deep.offsets.size(); ++p)
      at_.push_back(const_cast<char*>(first + deep.offsets[p] * sizeof(DeepSample) + offset));
  }
  Imf::DeepSlice slice(Imf::PixelType type, int width) {
    return {type, reinterpret_cast<char*>(at_.data()), sizeof(char*), sizeof(char*) * std::size_t(width),
            sizeof(DeepSample)};
  }

 private:
  std::vector<char*> at_;
};

void write_samples(const std::string& path, const DeepImage& deep,
                   const std::map<std::string, std::string>& attributes) {
  constexpr std::size_t k_color = offsetof(DeepSample, color);
  const std::pair<const char*, std::size_t> channels[] = {{"R", k_color},
                                                          {"G", k_color + sizeof(float)},
                                                          {"B", k_color + 2 * sizeof(float)},
                                                          {"A", k_color + 3 * sizeof(float)},
                                                          {"Z", offsetof(DeepSample, depth)},
                                                          {"id", offsetof(DeepSample, object)}};
  std::vector<unsigned> counts;
  for (std::size_t p = 0; p + 1 < deep.offsets.size(); ++p) counts.push_back(deep.offsets[p + 1] - deep.offsets[p]);
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), sizeof(unsigned),
                                           sizeof(unsigned) * std::size_t(deep.width)));
  std::vector<Pointers> pointers;
  for (const auto& [name, offset] : channels) pointers.emplace_back(deep, offset);
  for (std::size_t c = 0; c < std::size(channels); ++c)
    buffer.insert(channels[c].first,
                  pointers[c].slice(channels[c].first[0] == 'i' ? Imf::UINT : Imf::FLOAT, deep.width));
  Imf::DeepScanLineOutputFile file(path.c_str(), header_of(deep, attributes));
  file.setFrameBuffer(buffer);
  file.writePixels(deep.height);
}

}  // namespace

DeepImage deep_image(glm::ivec2 size, std::vector<SeenShare> shares) {
  const std::size_t pixels = std::size_t(size.x) * std::size_t(size.y);
  std::erase_if(shares, [&](const SeenShare& share) { return share.pixel >= pixels || !is_finite(share); });
  shares = merged(std::move(shares));
  std::ranges::stable_sort(shares, [](const SeenShare& a, const SeenShare& b) {
    return a.pixel != b.pixel ? a.pixel < b.pixel : a.depth < b.depth;
  });
  DeepImage deep{size.x, size.y, {}, {}};
  std::size_t next = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    deep.offsets.push_back(std::uint32_t(deep.samples.size()));
    double left = 1;
    for (; next < shares.size() && shares[next].pixel == p; ++next)
      deep.samples.push_back(sample_of(shares[next], left));
  }
  deep.offsets.push_back(std::uint32_t(deep.samples.size()));
  return deep;
}

std::vector<SeenShare> with_rest(std::vector<SeenShare> shares, const Image& color, std::span<const float> behind,
                                 double farthest) {
  constexpr float k_room = 1e-5F;
  std::vector<glm::vec4> rest;
  for (std::size_t p = 0; p < color.pixels.size() / 4; ++p)
    rest.emplace_back(color.pixels[4 * p], color.pixels[4 * p + 1], color.pixels[4 * p + 2], color.pixels[4 * p + 3]);
  for (const SeenShare& share : shares) rest[share.pixel] -= share.light;
  for (std::size_t p = 0; p < rest.size(); ++p) {
    if (rest[p] == glm::vec4(0)) continue;
    const bool has_room = rest[p].w > k_room, is_placed = p < behind.size() && behind[p] > 0;
    const float depth = !has_room ? 0 : is_placed ? behind[p] : float(farthest);
    shares.push_back({std::uint32_t(p), 0, depth, {glm::vec3(rest[p]), has_room ? rest[p].w : 0}});
  }
  return shares;
}

Image flatten(const DeepImage& deep) {
  Image image = make_image(deep.width, deep.height, {"R", "G", "B", "A"});
  for (std::size_t p = 0; p + 1 < deep.offsets.size(); ++p) {
    glm::dvec4 sum(0);
    double left = 1;
    for (std::uint32_t k = deep.offsets[p]; k < deep.offsets[p + 1]; ++k) {
      sum += left * glm::dvec4(deep.samples[k].color);
      left *= 1 - double(deep.samples[k].color.w);
    }
    for (int c = 0; c < 4; ++c) image.pixels[4 * p + std::size_t(c)] = float(sum[c]);
  }
  return image;
}

Result<void> write_deep_exr(const std::string& path, const DeepImage& deep,
                            const std::map<std::string, std::string>& attributes) {
  if (deep.width < 1 || deep.height < 1)
    return bad_input(fmt::format("{}: a picture of {}x{} cannot be written", path, deep.width, deep.height));
  return write_through_temporary(path, [&](const std::string& name) -> Result<void> {
    try {
      write_samples(name, deep, attributes);
      return {};
    } catch (const std::exception& error) {
      return bad_input(fmt::format("{}: cannot write ({})", path, error.what()), "check the folder and the free space");
    }
  });
}

}  // namespace cuticle
