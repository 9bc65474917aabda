// N5, H8: how many roots, on which triangle, and how even they lie in it, by every rule.
#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "strands/growing/roots.h"
#include <glm/geometric.hpp>

namespace cuticle::strands::roots_test {
namespace {

/// A right triangle of area 0.5 and one of area 1.5 beside it.
Mesh two_triangles() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {4, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  return mesh;
}

/// About `count` roots by a rule.
std::vector<Root> placed(const Mesh& mesh, RootRule rule, std::size_t count, std::uint64_t seed) {
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += 0.5 * double(glm::length(glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                                mesh.positions[t[2]] - mesh.positions[t[0]])));
  return place_roots(mesh, {.density = double(count) / area, .rule = rule, .seed = seed}).value().roots;
}

TEST(Roots, Weights_SumToOneAndAreNeverNegative) {
  for (const Root& root : scatter_roots(two_triangles(), 20000, 5)) {
    ASSERT_NEAR(double(root.weights.x + root.weights.y + root.weights.z), 1, 1e-6);
    ASSERT_GE(std::min({root.weights.x, root.weights.y, root.weights.z}), -1e-7f);
  }
}

TEST(Roots, Triangles_AreChosenByArea) {
  constexpr int count = 40000;
  int second = 0;
  for (const Root& root : scatter_roots(two_triangles(), count, 5)) second += root.triangle == 1;
  const double sigma = std::sqrt(count * 0.75 * 0.25);
  EXPECT_NEAR(second, 0.75 * count, 4 * sigma);
}

TEST(Roots, WithinATriangle_DensityIsEven) {
  Mesh mesh = two_triangles();
  mesh.triangles.pop_back();
  // 103.4: the 0.999 quantile of chi-square with 63 degrees of freedom. The table's 256 places are drawn by a hash.
  EXPECT_LT(evenness(scatter_roots(mesh, 64000, 9)).chi_square, 103.4);
  EXPECT_LT(evenness(placed(mesh, RootRule::table, 64000, 9)).chi_square, 103.4);
}

TEST(Roots, EvenRules_AreFarMoreEvenThanChance) {
  Mesh mesh = two_triangles();
  mesh.triangles.pop_back();
  for (std::size_t count : {256u, 4096u})
    for (RootRule rule : {RootRule::folded, RootRule::table, RootRule::recurrence, RootRule::van_der_corput}) {
      const Evenness even = evenness(placed(mesh, rule, count, 3));
      std::printf("%5zu roots, %-15s chi-square %7.2f  discrepancy %.5f\n", count,
                  std::string(k_root_rules[std::size_t(rule)]).c_str(), even.chi_square, even.discrepancy);
      if (rule == RootRule::recurrence || rule == RootRule::van_der_corput) {
        EXPECT_LT(even.chi_square, 40) << count;
        EXPECT_LT(even.discrepancy, 0.9 / std::sqrt(double(count))) << count;
      }
    }
}

TEST(Roots, VanDerCorput_OnePointInEachOfTheEqualTriangles) {
  Mesh mesh = two_triangles();
  mesh.triangles.pop_back();
  EXPECT_EQ(evenness(placed(mesh, RootRule::van_der_corput, 64, 3)).chi_square, 0);
}

TEST(Roots, Evenness_OfRootsInOneCorner_IsBad) {
  const std::vector<Root> roots(640, Root{0, {1, 0, 0}});
  const Evenness even = evenness(roots);
  EXPECT_NEAR(even.chi_square, 630.0 * 630 / 10 + 63 * 10, 1e-6);
  EXPECT_GT(even.discrepancy, 0.99);
}

TEST(Roots, EveryRule_ChoosesTrianglesByAreaAndPrefixesAgree) {
  for (RootRule rule : {RootRule::folded, RootRule::table, RootRule::recurrence, RootRule::van_der_corput}) {
    const auto many = placed(two_triangles(), rule, 4000, 5), few = placed(two_triangles(), rule, 40, 5);
    int second = 0;
    for (const Root& root : many) second += root.triangle == 1;
    EXPECT_NEAR(second, 3000, 4 * std::sqrt(4000 * 0.75 * 0.25));
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].weights, many[i].weights);
  }
}

TEST(Roots, DensityMap_ThinsWithinATriangle) {
  Mesh mesh = two_triangles();
  mesh.triangles.pop_back();
  const std::vector<float> map{1, 0, 0, 0};  // density is the first weight: its mean over the roots is 1/2, not 1/3
  for (RootRule rule : {RootRule::folded, RootRule::table, RootRule::recurrence, RootRule::van_der_corput}) {
    const auto found = place_roots(mesh, {.density = 24000, .density_map = map, .rule = rule}).value();
    ASSERT_EQ(found.roots.size(), 4000u);
    double mean = 0;
    for (const Root& root : found.roots) mean += double(root.weights.x) / 4000;
    EXPECT_NEAR(mean, 0.5, 0.015) << k_root_rules[std::size_t(rule)];
  }
}

TEST(Roots, BadMeshesAndMaps_AreCounted) {
  Mesh mesh = two_triangles();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.positions.push_back({nan, 0, 0});
  mesh.triangles.insert(mesh.triangles.end(), {{0, 0, 1}, {0, 1, 4}, {0, 1, 99}});
  const std::vector<float> map{0, 0, 0, 1, nan};
  const auto found = place_roots(mesh, {.density = 1000, .density_map = map}).value();
  EXPECT_EQ(found.report.degenerate_triangles, 3u);
  EXPECT_EQ(found.report.bare_triangles, 1u);
  EXPECT_EQ(found.report.bad_densities, 1u);
  EXPECT_EQ(found.roots.size(), 500u);  // 1.5 square metres with a mean density of 1/3
  for (const Root& root : found.roots) ASSERT_EQ(root.triangle, 1u);
}

TEST(Roots, BadRequests_AreRefused) {
  const Mesh mesh = two_triangles();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const RootRequest& request :
       {RootRequest{.density = nan}, RootRequest{.density = -1}, RootRequest{.density = 1e300},
        RootRequest{.density = 6e6}, RootRequest{.share = nan}, RootRequest{.share = 1.1}})
    EXPECT_FALSE(place_roots(mesh, request));
  const std::vector<float> short_map{1};
  EXPECT_FALSE(place_roots(mesh, {.density_map = short_map}));
  EXPECT_EQ(place_roots(Mesh(), {}).value().roots.size(), 0u);
}

TEST(Roots, SameSeed_SameRoots_AndAPrefixOfMore) {
  const auto few = scatter_roots(two_triangles(), 10, 7), many = scatter_roots(two_triangles(), 100, 7);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].triangle, many[i].triangle);
    EXPECT_EQ(few[i].weights, many[i].weights);
  }
  EXPECT_NE(scatter_roots(two_triangles(), 1, 8)[0].weights, few[0].weights);
}

TEST(Roots, DegenerateTriangle_IsNeverChosen) {
  Mesh mesh = two_triangles();
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  mesh.triangles.push_back({2, 2, 2});
  for (const Root& root : scatter_roots(mesh, 5000, 5)) ASSERT_TRUE(root.triangle == 1 || root.triangle == 2);
}

TEST(Roots, Identity_EachStrandItsOwnHair) {
  const auto roots = identity_roots(3);
  ASSERT_EQ(roots.size(), 3u);
  EXPECT_EQ(roots[2].triangle, 2u);
  EXPECT_EQ(roots[2].weights, glm::vec3(1, 0, 0));
}

}  // namespace
}  // namespace cuticle::strands::roots_test
