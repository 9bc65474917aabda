#include "render/reference/film.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/file.h"

namespace cuticle::render::reference {

namespace {

const glm::dvec3 k_rec709{0.2126, 0.7152, 0.0722};
constexpr char k_magic[8] = {'C', 'U', 'T', 'P', 'A', 'T', 'H', '1'};

/// Variance of the mean of `count` samples from their sum and that of their squares.
glm::dvec3 variance_of_mean(const glm::dvec3& sum, const glm::dvec3& squares, double count) {
  if (count < 2) return glm::dvec3(0);
  const glm::dvec3 mean = sum / count;
  return glm::max(squares / count - mean * mean, glm::dvec3(0)) / (count - 1);
}

template <class T>
void append(std::vector<std::byte>& bytes, std::span<const T> values) {
  const auto more = std::as_bytes(values);
  bytes.insert(bytes.end(), more.begin(), more.end());
}

template <class T>
void take(std::span<const std::byte>& bytes, std::span<T> values) {
  if (values.empty()) return;
  std::memcpy(values.data(), bytes.data(), values.size_bytes());
  bytes = bytes.subspan(values.size_bytes());
}

}  // namespace

struct Film::Header {
  char magic[8];
  std::uint64_t key;
  std::int32_t width, height;
  std::uint64_t pixel_bytes, layer_pixels;
  bool operator==(const Header&) const = default;
};

Film::Film(glm::ivec2 size, std::vector<std::string> split_names, bool strands)
    : size_(size), names_(std::move(split_names)) {
  pixels_.resize(std::size_t(size.x) * std::size_t(size.y));
  if (strands) seen_.resize(pixels_.size());
  if (names_.empty()) return;
  first_.resize(pixels_.size());
  splits_.resize(pixels_.size() * k_splits, glm::vec3(0));
}

void Film::note_seen(std::vector<SeenStrand>& seen, const PathLight& light) {
  auto found = std::ranges::find(seen, light.first.strand, &SeenStrand::strand);
  if (found == seen.end()) found = seen.insert(found, {.strand = light.first.strand});
  const double share = light.covered ? 1 : 0;
  found->light += glm::dvec4(light.radiance, share);
  found->depth += share * double(light.first.depth);
}

std::vector<SeenShare> Film::shares() const {
  std::vector<SeenShare> shares;
  for (std::size_t p = 0; p < seen_.size(); ++p)
    for (const SeenStrand& seen : seen_[p]) {
      const double depth = seen.light.w > 0 ? seen.depth / seen.light.w : 0;
      if (seen.light != glm::dvec4(0))
        shares.push_back(
            {std::uint32_t(p), seen.strand, float(depth), glm::vec4(seen.light / double(pixels_[p].samples))});
    }
  return shares;
}

void Film::add(std::uint32_t at, const PathLight& light, const LightSplits* splits) {
  Pixel& pixel = pixels_[at];
  pixel.sum += light.radiance;
  pixel.squares += light.radiance * light.radiance;
  pixel.covered += std::uint32_t(light.covered);
  ++pixel.samples;
  if (!seen_.empty()) note_seen(seen_[at], light);
  if (names_.empty()) return;
  const SeenFirst& first = first_[at];
  if (light.covered && (first.depth == 0 || (first.strand == 0 && light.first.strand > 0))) first_[at] = light.first;
  for (std::size_t k = 0; k < k_splits; ++k) splits_[at * k_splits + k] += glm::vec3((*splits)[k]);
}

Film::Noise Film::noise(std::span<const std::uint32_t> pixels) const {
  double mean = 0, variance = 0;
  for (const std::uint32_t at : pixels) {
    const Pixel& pixel = pixels_[at];
    if (pixel.samples == 0) continue;
    mean += glm::dot(pixel.sum, k_rec709) / pixel.samples;
    const glm::dvec3 error = glm::sqrt(variance_of_mean(pixel.sum, pixel.squares, pixel.samples));
    const double luminance = glm::dot(error, k_rec709);  // the channels of a path rise and fall together
    variance += luminance * luminance;
  }
  const double count = double(std::max(pixels.size(), std::size_t(1)));
  return {mean / count, std::sqrt(variance / count)};
}

Image Film::color() const {
  Image image = make_image(size_.x, size_.y, {"R", "G", "B", "A"});
  for (std::size_t p = 0; p < pixels_.size(); ++p) {
    const double scale = pixels_[p].samples > 0 ? 1.0 / pixels_[p].samples : 0;
    for (int c = 0; c < 3; ++c) image.pixels[4 * p + std::size_t(c)] = float(scale * pixels_[p].sum[c]);
    image.pixels[4 * p + 3] = float(scale * pixels_[p].covered);
  }
  return image;
}

Image Film::layers() const {
  std::vector<std::string> channels = {"R", "G", "B", "A", "variance.R", "variance.G", "variance.B", "samples.Y"};
  if (!names_.empty())
    for (const char* name : {"coverage.Y", "depth.Z", "tangent.X", "tangent.Y", "tangent.Z", "strand.id"})
      channels.emplace_back(name);
  for (const std::string& name : names_)
    for (const char* channel : {".R", ".G", ".B"})
      if (!name.empty()) channels.push_back(name + channel);
  const Image plain = color();
  Image image = make_image(size_.x, size_.y, channels);
  auto out = image.pixels.begin();
  for (std::size_t p = 0; p < pixels_.size(); ++p) {
    const Pixel& pixel = pixels_[p];
    out = std::copy_n(plain.pixels.begin() + std::ptrdiff_t(4 * p), 4, out);
    const glm::dvec3 variance = variance_of_mean(pixel.sum, pixel.squares, pixel.samples);
    for (int c = 0; c < 3; ++c) *out++ = float(variance[c]);
    *out++ = float(pixel.samples);
    if (names_.empty()) continue;
    const SeenFirst& first = first_[p];
    for (const float value :
         {plain.pixels[4 * p + 3], first.depth, first.tangent.x, first.tangent.y, first.tangent.z, float(first.strand)})
      *out++ = value;
    const float scale = pixel.samples > 0 ? 1 / float(pixel.samples) : 0;
    for (std::size_t k = 0; k < k_splits; ++k)
      for (int c = 0; c < 3 && !names_[k].empty(); ++c) *out++ = scale * splits_[p * k_splits + k][c];
  }
  return image;
}

Film::Header Film::header(std::uint64_t key) const {
  Header header{{}, key, size_.x, size_.y, sizeof(Pixel), std::uint64_t(first_.size())};
  std::copy(std::begin(k_magic), std::end(k_magic), header.magic);
  return header;
}

Result<void> Film::save(const std::string& path, std::uint64_t key) const {
  std::vector<std::byte> bytes;
  const Header head = header(key);
  append(bytes, std::span<const Header>(&head, 1));
  append(bytes, std::span<const Pixel>(pixels_));
  append(bytes, std::span<const SeenFirst>(first_));
  append(bytes, std::span<const glm::vec3>(splits_));
  return write_file(path, bytes);
}

Result<bool> Film::load(const std::string& path, std::uint64_t key) {
  if (!std::filesystem::exists(path)) return false;
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
  const Header expected = header(key);
  Header found{};
  if (bytes.size() >= sizeof found) std::memcpy(&found, bytes.data(), sizeof found);
  if (found != expected)
    return bad_input(
        fmt::format("{}: not the sums of this picture: another scene, size, seed or choice of layers", path),
        "name another state file, or remove this one");
  const std::size_t size = sizeof found + pixels_.size() * sizeof(Pixel) + first_.size() * sizeof(SeenFirst) +
                           splits_.size() * sizeof(glm::vec3);
  if (bytes.size() != size)
    return bad_input(fmt::format("{}: {} bytes, where the sums of this picture take {}", path, bytes.size(), size));
  std::span<const std::byte> rest = std::span(bytes).subspan(sizeof found);
  take(rest, std::span<Pixel>(pixels_));
  take(rest, std::span<SeenFirst>(first_));
  take(rest, std::span<glm::vec3>(splits_));
  return true;
}

}  // namespace cuticle::render::reference
