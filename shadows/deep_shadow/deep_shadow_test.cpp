#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "shadows/deep_shadow/visibility.h"
#include "shadows/method.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::deep_shadow::deep_shadow_test {

namespace {

std::vector<float> run(const std::string& name, const strands::Groom& groom, const std::string& set,
                       std::size_t* bytes = nullptr) {
  const Method& method = **find_method(name);
  std::vector<glm::vec3> points = groom.positions;
  for (glm::vec3& point : points) point += glm::vec3(1e-4f);  // so that they lie in no strand's own depth step
  auto result = method.evaluate({&groom, 0.4, {1, 1, 0.3}}, {points, {}},
                                registry::parse_assignments(method.entry.parameters, set).value());
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  if (!result) return {};
  if (bytes != nullptr) *bytes = result->cost.bytes;
  return result->values;
}
double largest_difference(std::span<const float> a, std::span<const float> b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(double(a[i]) - double(b[i])));
  return worst;
}
/// Fragments at random depths, several in one step now and then.
std::vector<Knot> random_function(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Fragment> fragments;
  std::uint32_t depth = 100, sum = 0;
  for (int i = 0; i < 200; ++i) {
    depth += std::uint32_t(tests::uniform(random) * tests::uniform(random) * 500);
    fragments.push_back({depth, sum += 1 + std::uint32_t(3000 * tests::uniform(random))});
  }
  std::vector<Knot> knots;
  exact_function(fragments, -1e-5f, knots);
  return knots;
}
double value_at(std::span<const Knot> knots, double depth) {
  if (depth <= double(knots.front().depth)) return double(knots.front().visibility);
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double a = double(knots[i - 1].depth), b = double(knots[i].depth);
    if (depth <= b)
      return std::lerp(double(knots[i - 1].visibility), double(knots[i].visibility), (depth - a) / (b - a));
  }
  return double(knots.back().visibility);
}
strands::Groom fur() { return tests::coat(3000, 6, 0.03, 1e-4f, 3); }

}  // namespace

TEST(Compress, AnyBound_IsKeptEverywhereAndNeverRises) {
  for (const double bound : {0.003, 0.02, 0.1}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const std::vector<Knot> exact = random_function(seed);
      std::vector<Knot> knots;
      compress(exact, bound, knots);
      EXPECT_LT(knots.size(), exact.size());
      for (const Knot& point : exact)
        EXPECT_NEAR(value_at(knots, double(point.depth)), double(point.visibility), bound + 1e-6);
      for (std::size_t i = 1; i < knots.size(); ++i) EXPECT_LE(knots[i].visibility, knots[i - 1].visibility);
    }
  }
}

TEST(Compress, AWiderBound_NeedsFewerKnots) {
  const std::vector<Knot> exact = random_function(4);
  std::size_t last = exact.size();
  for (const double bound : {0.005, 0.02, 0.08, 0.3}) {
    std::vector<Knot> knots;
    compress(exact, bound, knots);
    EXPECT_LT(knots.size(), last);
    last = knots.size();
  }
}

TEST(CompressTo, FewPieces_AreEnoughForAnyFunction) {
  for (const std::size_t pieces : {1u, 2u, 5u}) {
    std::vector<Knot> knots;
    compress_to(random_function(5), 0, pieces, knots);
    EXPECT_LE(knots.size(), pieces + 1);
    EXPECT_GT(knots.size(), 1u);
  }
}

TEST(Compress, NoFragments_NoKnots) {
  std::vector<Knot> exact{{1, 1}}, knots{{1, 1}};
  exact_function({}, -1, exact);
  compress(exact, 0.01, knots);
  EXPECT_TRUE(exact.empty());
  EXPECT_TRUE(knots.empty());
}

// A lookup averages texels, so it is no farther from the exact list's than the bound of each.
TEST(DeepShadow, AnyBound_IsThatFarFromTheExactListAtMost) {
  const strands::Groom groom = fur();
  const std::vector<float> exact = run("exact_list", groom, "resolution=128");
  for (const double bound : {0.01, 0.05}) {
    const auto values = run("deep_shadow", groom, "resolution=128,error_bound=" + std::to_string(bound));
    const double worst = largest_difference(values, exact);
    std::printf("bound %g: largest difference from the exact list %.4f\n", bound, worst);
    EXPECT_LT(worst, bound + 0.001) << "and the rounding of knots";
  }
}

TEST(DeepShadow, FewerPieces_FewerBytes) {
  const strands::Groom groom = fur();
  std::size_t few = 0, many = 0;
  run("deep_shadow", groom, "resolution=100,pieces=2", &few);
  run("deep_shadow", groom, "resolution=100,pieces=16", &many);
  EXPECT_LT(double(few), 0.75 * double(many));
}

TEST(DeepShadow, ATexelCountThatIsNoWholeRun_AgreesWithTheExactList) {
  const strands::Groom groom = fur();
  for (const char* set : {"resolution=33", "resolution=33,accumulate=poisson"}) {
    const auto values = run("deep_shadow", groom, std::string(set) + ",error_bound=0.001");
    EXPECT_LT(largest_difference(values, run("exact_list", groom, set)), 0.02) << set;
  }
}

TEST(DeepShadow, OneAndThreeThreads_SameBits) {
  const strands::Groom groom = fur();
  std::vector<float> values[2];
  for (int i = 0; i < 2; ++i) {
    tbb::global_control threads(tbb::global_control::max_allowed_parallelism, i == 0 ? 1 : 3);
    values[i] = run("deep_shadow", groom, "resolution=128");
  }
  EXPECT_EQ(values[0], values[1]);
}

TEST(DeepShadow, EmptyGroom_LetsAllThrough) {
  const Method& method = **find_method("deep_shadow");
  const glm::vec3 point(0);
  const strands::Groom none;
  auto result = method.evaluate({&none, 0.4, {0, 1, 0}}, {std::span(&point, 1), {}},
                                registry::default_values(method.entry.parameters));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->values[0], 1.0f);
}

}  // namespace cuticle::shadows::deep_shadow::deep_shadow_test
