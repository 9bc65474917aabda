// F10: prefixes of the order are spread over all strands.
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "strands/lod/spread_order.h"

namespace cuticle::strands::spread_order_test {
namespace {

std::vector<StrandShape> row(std::size_t count) {
  std::vector<StrandShape> shapes(count);
  for (std::size_t k = 0; k < count; ++k) shapes[k].fill({float(k), 0, 0});
  return shapes;
}

/// Strands by chance in a square, that lean.
std::vector<StrandShape> meadow(std::size_t count) {
  std::mt19937 chance(3);
  std::uniform_real_distribution<float> place(0, 1), lean(-0.1f, 0.1f);
  std::vector<StrandShape> shapes(count);
  for (StrandShape& shape : shapes) {
    const glm::vec3 root(place(chance), place(chance), 0), way(lean(chance), lean(chance), 0.3f);
    for (std::size_t k = 0; k < shape.size(); ++k) shape[k] = root + float(k) / 3 * way;
  }
  return shapes;
}

/// Mean over all strands of the distance from a strand's root to the nearest root of the prefix.
double mean_distance(const std::vector<StrandShape>& shapes, const std::vector<std::uint32_t>& order,
                     std::size_t prefix) {
  double sum = 0;
  for (const StrandShape& shape : shapes) {
    double nearest = 1e9;
    for (std::size_t k = 0; k < prefix; ++k)
      nearest = std::min(nearest, double(glm::distance(shape[0], shapes[order[k]][0])));
    sum += nearest;
  }
  return sum / double(shapes.size());
}

TEST(SpreadOrder, AnyCount_IsAPermutationAndTheSameAgain) {
  for (std::size_t count : {0, 1, 2, 3, 7, 1000}) {
    const auto shapes = meadow(count);
    const auto order = spread_order(shapes);
    EXPECT_EQ(order.size(), count);
    EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), count);
    EXPECT_EQ(order, spread_order(shapes));
  }
}

TEST(SpreadOrder, PrefixOfAPowerOfTwo_HasOneStrandOfEachPart) {
  const auto order = spread_order(row(64));
  for (std::size_t prefix = 2; prefix <= 64; prefix *= 2) {
    std::set<std::size_t> parts;
    for (std::size_t k = 0; k < prefix; ++k) parts.insert(order[k] * prefix / 64);
    EXPECT_EQ(parts.size(), prefix);
  }
}

// A quarter of the strands, in parts of four: each of the four is as likely to be the first, 128 of 512 and three
// standard deviations of chance about it.
TEST(SpreadOrder, FirstOfAPart_IsAnyOfIt) {
  const auto order = spread_order(row(2048));
  std::array<int, 4> counts{};
  for (std::size_t k = 0; k < 512; ++k) ++counts[order[k] % 4];
  for (int count : counts) EXPECT_NEAR(count, 128, 30);
}

TEST(SpreadOrder, Prefix_IsNearerToAllThanOneByChance) {
  const auto shapes = meadow(4000);
  const auto order = spread_order(shapes);
  std::vector<std::uint32_t> by_chance(4000);
  std::iota(by_chance.begin(), by_chance.end(), 0u);  // the meadow is by chance already
  for (std::size_t prefix : {40, 250, 600}) {
    const double spread = mean_distance(shapes, order, prefix), chance = mean_distance(shapes, by_chance, prefix);
    std::printf("%zu of 4000: %.4f from the nearest, %.4f by chance\n", prefix, spread, chance);
    EXPECT_LT(spread, 0.95 * chance);
  }
}

TEST(SpreadOrder, StrandsOfOneShape_AllStand) {
  std::vector<StrandShape> shapes(300);
  for (StrandShape& shape : shapes) shape.fill({1, 2, 3});
  const auto order = spread_order(shapes);
  EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), 300u);
}

}  // namespace
}  // namespace cuticle::strands::spread_order_test
