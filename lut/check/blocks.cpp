#include "lut/check/blocks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/packing.hpp>

namespace cuticle::lut::check {
namespace {

constexpr int k_side = 4;
constexpr double k_near_step = 0.01;    ///< of a block's range: BC6H and BC7 round their steps to 1/64
constexpr double k_least_range = 0.02;  ///< of the channel's largest number, for a block to count as varying

using Block = std::array<double, std::size_t(k_side) * k_side>;

Block block_at(const Image& image, int x0, int y0, int channel) {
  Block block{};
  for (int i = 0; i < k_side * k_side; ++i) block[i] = double(image.at(x0 + i % k_side, y0 + i / k_side, channel));
  return block;
}

bool on_steps(const Block& block, int steps) {
  const auto [least, largest] = std::minmax_element(block.begin(), block.end());
  const double low = *least, range = *largest - low;
  return std::all_of(block.begin(), block.end(), [&](double value) {
    const double place = (value - low) / range * steps;
    return std::abs(place - std::round(place)) <= k_near_step * steps;
  });
}

bool is_stepped(const Block& block) {
  Block bits{};
  std::transform(block.begin(), block.end(), bits.begin(),
                 [](double value) { return double(glm::packHalf1x16(float(value))); });
  for (const int steps : {3, 7, 15})
    if (on_steps(block, steps) || on_steps(bits, steps)) return true;
  return false;
}

double largest_of(const Image& image, int channel) {
  double largest = 0;
  for (std::size_t i = channel; i < image.pixels.size(); i += image.channels())
    largest = std::max(largest, double(image.pixels[i]));
  return largest;
}

bool varies(const Block& block, double largest) {
  const auto [low, high] = std::minmax_element(block.begin(), block.end());
  return *high - *low > k_least_range * largest;
}

}  // namespace

double share_of_stepped_blocks(const Image& image) {
  double varying = 0, stepped = 0;
  for (int c = 0; c < image.channels(); ++c) {
    const double largest = largest_of(image, c);
    for (int y = 0; y + k_side <= image.height; y += k_side)
      for (int x = 0; x + k_side <= image.width; x += k_side) {
        const Block block = block_at(image, x, y, c);
        if (!varies(block, largest)) continue;
        varying += 1;
        stepped += is_stepped(block) ? 1 : 0;
      }
  }
  return varying > 0 ? stepped / varying : 0;
}

bool made_of_squares(const Image& image, int side) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels(); ++c)
        if (image.at(x, y, c) != image.at(x / side * side, y / side * side, c)) return false;
  return true;
}

}  // namespace cuticle::lut::check
