#include "core/image/cryptomatte.h"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <unordered_set>

#include <fmt/core.h>

#include "core/json/json.h"

namespace cuticle {
namespace {

std::uint32_t mixed(std::uint32_t block) { return std::rotl(block * 0xcc9e2d51U, 15) * 0x1b873593U; }

/// The hash as a number whose float is neither 0, subnormal, infinite nor NaN.
std::uint32_t matte_hash(std::string_view name) {
  const std::uint32_t hash = murmur_hash(name), exponent = hash >> 23 & 255U;
  return exponent == 0 || exponent == 255 ? hash ^ (1U << 23) : hash;
}

/// Weights by object in one pixel: few, so that a list is searched.
struct Weight {
  float id, weight;
};
using PixelWeights = std::vector<Weight>;

void add(PixelWeights& weights, float id, float weight) {
  const auto found = std::ranges::find(weights, id, &Weight::id);
  if (found == weights.end())
    weights.push_back({id, weight});
  else
    found->weight += weight;
}

/// Adds channels of floats to each pixel.
void append(Image& image, const std::vector<std::string>& names, const std::vector<PixelWeights>& pixels) {
  const std::size_t before = image.channel_names.size(), more = names.size();
  std::vector<float> all;
  all.reserve(pixels.size() * (before + more));
  for (std::size_t p = 0; p < pixels.size(); ++p) {
    const auto first = image.pixels.begin() + std::ptrdiff_t(p * before);
    all.insert(all.end(), first, first + std::ptrdiff_t(before));
    for (std::size_t k = 0; k < more / 2; ++k) {
      const Weight kept = k < pixels[p].size() ? pixels[p][k] : Weight{0, 0};
      all.insert(all.end(), {kept.id, kept.weight});
    }
  }
  image.pixels = std::move(all);
  image.channel_names.insert(image.channel_names.end(), names.begin(), names.end());
}

std::vector<std::string> channels_of(std::string_view layer) {
  std::vector<std::string> names;
  for (int k = 0; k < k_matte_ranks / 2; ++k)
    for (const char channel : {'R', 'G', 'B', 'A'}) names.push_back(fmt::format("{}{:02d}.{}", layer, k, channel));
  return names;
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
  std::uint32_t hash = 0, tail = 0;
  const auto byte = [&](std::size_t k) { return std::uint32_t(static_cast<unsigned char>(text[k])); };
  const std::size_t blocks = text.size() / 4;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::uint32_t block = byte(4 * b) | byte(4 * b + 1) << 8 | byte(4 * b + 2) << 16 | byte(4 * b + 3) << 24;
    hash = std::rotl(hash ^ mixed(block), 13) * 5 + 0xe6546b64U;
  }
  for (std::size_t k = text.size(); k-- > 4 * blocks;) tail = tail << 8 | byte(k);
  hash ^= mixed(tail) ^ std::uint32_t(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bU;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35U;
  return hash ^ hash >> 16;
}

float matte_id(std::string_view name) { return std::bit_cast<float>(matte_hash(name)); }

void add_matte(Image& image, std::map<std::string, std::string>& attributes, std::string_view layer,
               std::span<const SeenShare> shares, const std::function<std::string(std::uint32_t object)>& name_of) {
  std::vector<PixelWeights> pixels(std::size_t(image.width) * std::size_t(image.height));
  std::unordered_map<std::uint32_t, float> ids;
  std::string manifest;
  std::unordered_set<std::string> named;
  for (const SeenShare& share : shares) {
    if (share.object == 0) continue;
    auto found = ids.find(share.object);
    if (found == ids.end()) {
      const std::string name = name_of(share.object);
      found = ids.emplace(share.object, name.empty() ? 0 : matte_id(name)).first;
      if (!name.empty() && named.insert(name).second)
        manifest += fmt::format("{}{}:\"{:08x}\"", manifest.empty() ? "{" : ",", Json(name).dump(), matte_hash(name));
    }
    if (found->second != 0) add(pixels[share.pixel], found->second, share.light.w);
  }
  for (PixelWeights& weights : pixels)
    std::ranges::stable_sort(weights, [](const Weight& a, const Weight& b) { return a.weight > b.weight; });
  append(image, channels_of(layer), pixels);
  const std::string key = fmt::format("cryptomatte/{}/", fmt::format("{:08x}", matte_hash(layer)).substr(0, 7));
  attributes[key + "name"] = layer;
  attributes[key + "hash"] = "MurmurHash3_32";
  attributes[key + "conversion"] = "uint32_to_float32";
  attributes[key + "manifest"] = manifest.empty() ? "{}" : manifest + "}";
}

}  // namespace cuticle
