// N5: roots scattered by area, two uniforms folded into the triangle.
#include <cmath>

#include <gtest/gtest.h>

#include <cuticle/strands/growing/growing.h>

namespace cuticle::strands {
namespace {

/// A right triangle of area 0.5 and one of area 1.5 beside it.
Mesh two_triangles() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {4, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  return mesh;
}

double chi_square(const std::vector<int>& counts, double expected) {
  double sum = 0;
  for (int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
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
  // The triangle cut into 64 equal ones by a grid of 8 x 8 in (u, v): whole cells hold two, diagonal cells one.
  constexpr int side = 8, count = 64000;
  std::vector<int> counts(side * side * 2, 0);
  Mesh mesh = two_triangles();
  mesh.triangles.pop_back();
  for (const Root& root : scatter_roots(mesh, count, 9)) {
    const double u = double(root.weights.y) * side, v = double(root.weights.z) * side;
    const int i = std::min(int(u), side - 1), j = std::min(int(v), side - 1);
    ++counts[std::size_t(2 * (i * side + j) + (u - i + v - j > 1))];
  }
  std::vector<int> inside;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int half = 0; half < 2; ++half)
        if (i + j + half < side) inside.push_back(counts[std::size_t(2 * (i * side + j) + half)]);
  ASSERT_EQ(inside.size(), 64u);
  EXPECT_LT(chi_square(inside, double(count) / 64), 103.4);  // 0.999 quantile of chi-square with 63 degrees of freedom
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
}  // namespace cuticle::strands
