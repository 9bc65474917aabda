#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "shadows/method.h"
#include "shadows/opacity_map/map.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::opacity_map_test {

namespace {

Result<Transmittance> run(const strands::Groom& groom, std::span<const glm::vec3> points, const std::string& set,
                          double alpha = 0.4, glm::dvec3 light = {0, 1, 0}) {
  return tests::run_shadow("opacity_map", groom, points, set, alpha, light);
}
float one(const strands::Groom& groom, glm::vec3 point, const std::string& set = "", double alpha = 0.4) {
  return tests::shadow_at("opacity_map", groom, point, set, alpha);
}
using tests::mean;
std::vector<float> run_on_segments(const strands::Groom& groom, std::span<const glm::vec3> points,
                                   std::span<const SegmentPlace> places, const std::string& set) {
  const auto values = tests::values_of("opacity_map", set).value();
  return (*find_method("opacity_map"))->evaluate({&groom}, {points, {}, places}, values).value().values;
}
opacity_map::Map map_of(const strands::Groom& groom, glm::dvec3 to_light) {
  return opacity_map::build_map(groom, 0.4, light_axes(to_light), {});
}
strands::Groom upright() {
  strands::Groom groom;
  tests::add_strand(groom, {{0, 0.1f, 0}, {0, 0.05f, 0}, {0, 0, 0}}, 0.001f);
  tests::add_strand(groom, {{0.01f, 0.1f, 0.01f}, {0.01f, 0, 0.01f}}, 0.0001f);
  tests::add_strand(groom, {{-0.01f, 0.1f, -0.01f}, {-0.01f, 0, -0.01f}}, 0.0001f);
  return groom;
}

}  // namespace

// The optical depth of a layer of fibres crossed square on is their area per area times alpha (fibres at random
// places).
TEST(OpacityMap, RandomSlab_FollowsTheExponentialLaw) {
  const float radius = 2e-5f;
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, radius, 7);
  const double area = 2 * double(radius) * tests::length_per_area(groom, 0.02, -1);
  for (const double alpha : {0.1, 0.5, 1.0}) {
    auto result = run(groom, tests::grid_below(-0.001), "slices=64,accumulate=poisson,filter_texels=3", alpha);
    ASSERT_TRUE(result);
    EXPECT_NEAR(mean(result->values) / std::exp(-alpha * area), 1, 0.01);
  }
}

TEST(OpacityMap, HalfWayThroughASlab_HalfTheDepthCounts) {
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, 2e-5f, 7);
  const double area = 4e-5 * tests::length_per_area(groom, 0.02, 0.025);
  auto result = run(groom, tests::grid_below(0.025), "slices=64,accumulate=poisson,filter_texels=3");
  ASSERT_TRUE(result);
  EXPECT_NEAR(mean(result->values) / std::exp(-0.4 * area), 1, 0.01);
}

// Half way between two slices opaque fibres leave the light that passes by those which lie before the point.
TEST(OpacityMap, OpaqueHairBetweenFewSlices_KeepsTheLightBeforeIt) {
  const strands::Groom groom = tests::random_slab(1500, 0.1, 0.05, 1e-4f, 7);
  const auto points = tests::grid_below(0.025);
  const std::string map = "resolution=512,filter_texels=1";
  const float wanted = mean(tests::run_shadow("exact_list", groom, points, map, 1).value().values);
  for (const std::string slices : {"2", "4", "16"}) {
    const float random = mean(run(groom, points, map + ",slices=" + slices, 1).value().values);
    const float even = mean(run(groom, points, map + ",between=even,slices=" + slices, 1).value().values);
    std::printf("%s slices leave %.3f of the light, spread evenly %.3f, the exact list %.3f\n", slices.c_str(),
                double(random), double(even), double(wanted));
    EXPECT_NEAR(random, wanted, 0.02) << slices;
    EXPECT_LT(even, random) << slices;
  }
}

TEST(OpacityMap, EmptyGroom_LetsAllThrough) { EXPECT_EQ(one({}, {0, 0, 0}), 1.0f); }

TEST(OpacityMap, AlphaZero_LetsAllThrough) { EXPECT_EQ(one(upright(), {0, -1, 0}, "", 0), 1.0f); }

TEST(OpacityMap, OpaqueWideFibre_LetsNothingThrough) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0.05f, 0}, {0.05f, 0.05f, 0}}, 0.01f);
  tests::add_strand(groom, {{0, 0, -0.05f}, {0, 0, 0.05f}}, 0.001f);
  EXPECT_LT(one(groom, {0, 0, 0}, "slices=16", 1), 1e-4f);
}

TEST(OpacityMap, SingleFibre_CrossingTakesAlpha) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0.05f, 0}, {0, 0.05f, 0}, {0.05f, 0.05f, 0}}, 0.005f);
  tests::add_strand(groom, {{-0.05f, 0, -0.05f}, {0.05f, 0, -0.05f}}, 0.0001f);
  EXPECT_NEAR(one(groom, {0, 0, 0}), 0.6, 1e-4);
  EXPECT_EQ(one(groom, {0, 0.06f, 0}), 1.0f);
  EXPECT_EQ(one(groom, {0, 0, 0.02f}), 1.0f);
}

TEST(OpacityMap, FlatGroom_FrontFreeAndBackShadowed) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0, 0}, {0.05f, 0, 0}}, 0.005f);
  EXPECT_EQ(one(groom, {0, 0, 0}), 1.0f);
  EXPECT_NEAR(one(groom, {0, -0.01f, 0}), 0.6, 1e-4);
}

TEST(OpacityMap, LightParallelToTheStrands_EachCastsItsCrossSection) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 6400; ++i) points.emplace_back(0.00005 * (i % 80 - 40), -0.01, 0.00005 * (i / 80 - 40));
  auto result = run(upright(), points, "accumulate=poisson,filter_texels=0,k=1,resolution=512");
  ASSERT_TRUE(result);
  double area = 0;
  for (float t : result->values) area -= std::log(double(t)) / 0.4 * 0.00005 * 0.00005;
  EXPECT_NEAR(area / (3.14159265 * 1e-6), 1, 0.04);
}

TEST(OpacityMap, PrintedSpacing_LastPlaneStopsShort) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0.1f, 0}, {0.05f, 0.1f, 0}}, 0.005f);
  tests::add_strand(groom, {{-0.05f, 0.001f, 0}, {0.05f, 0.001f, 0}}, 0.005f);
  tests::add_strand(groom, {{-0.05f, 0, -0.05f}, {0.05f, 0, -0.05f}}, 0.0001f);
  EXPECT_NEAR(one(groom, {0, -1, 0}, "slices=8,spacing=last_plane"), 0.36, 1e-4);
  EXPECT_NEAR(one(groom, {0, -1, 0}, "slices=8,spacing=printed"), 0.6, 1e-4);
}

TEST(OpacityMap, DoubledFilter_MillimetresAndTexelsAgree) {
  const strands::Groom groom = tests::coat(500, 6, 0.03, 1e-4f, 3);
  const auto map = map_of(groom, {0, 1, 0});
  const std::string set = "filter_radius_mm=" + std::to_string(3000.0 / double(map.view.scale.x));
  EXPECT_NEAR(one(groom, {0, 0, 0}, set), one(groom, {0, 0, 0}, "filter_texels=3"), 1e-4);
}

TEST(OpacityMap, FilterFinerThanATexel_StaysHalfATexel) {
  const strands::Groom groom = tests::coat(500, 6, 0.03, 1e-4f, 3);
  EXPECT_EQ(one(groom, {0, 0, 0}, "filter_radius_mm=0.0001"), one(groom, {0, 0, 0}, "filter_texels=0.5"));
}

TEST(OpacityMap, AnyThreadCount_SameIntegers) {
  const strands::Groom groom = tests::coat(2000, 8, 0.03, 1e-4f, 3);
  const auto all = map_of(groom, {0.6, 0.8, 0});
  tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(map_of(groom, {0.6, 0.8, 0}).sums, all.sums);
}

TEST(OpacityMap, FixedPointScale_LeavesRoomForEverySegment) {
  for (const std::size_t segments : {1u, 5000u, 400000u})
    for (const double alpha : {0.01, 0.4, 1.0}) {
      const double scale = fixed_point_scale(alpha, {}, segments);
      const double most = double(deposit_table(alpha, {}, scale).back()) * double(segments);
      EXPECT_LT(most, 4294967296.0);
      EXPECT_TRUE(most > 4294967296.0 / 4 || scale == 0x1p20) << "room is not wasted";
    }
}

TEST(OpacityMap, ALotOfOpaqueFibres_SumsDoNotWrap) {
  strands::Groom groom;
  for (int i = 0; i < 5000; ++i)
    tests::add_strand(groom, {{-0.05f, 1e-5f * float(i), 0}, {0.05f, 1e-5f * float(i), 0}}, 0.02f);
  EXPECT_LT(one(groom, {0, -1, 0}, "resolution=16,slices=2", 1), 1e-4f);
}

// T at the front of a slanted surface swings with the slices that pass through it; it does no more where the interval
// between them is as deep as the surface's own step within a texel.
TEST(OpacityMap, SlantedSheet_StripesFadeWithTheNumberOfSlices) {
  std::vector<glm::vec3> front;
  const strands::Groom groom = tests::slanted_sheet(front);
  double before = 1;
  for (const char* slices : {"4", "8", "16", "32", "64", "128", "256"}) {
    const auto result = run(groom, front, std::string("slices=") + slices);
    ASSERT_TRUE(result);
    double squares = 0;
    for (const float t : result->values)
      squares += (double(t) - mean(result->values)) * (double(t) - mean(result->values));
    const double stripes = std::sqrt(squares / double(front.size()));
    std::printf("%s slices: T %.3f, stripes %.4f\n", slices, mean(result->values), stripes);
    EXPECT_LT(stripes, before) << slices;
    before = stripes;
  }
  EXPECT_LT(before, 0.04);
}

TEST(OpacityMap, BadInput_IsRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  strands::Groom broken = upright();
  broken.positions[1].y = nan;
  const glm::vec3 good(0), bad(nan, 0, 0);
  EXPECT_FALSE(run(broken, std::span(&good, 1), ""));
  EXPECT_FALSE(run(upright(), std::span(&bad, 1), ""));
  EXPECT_FALSE(run(upright(), std::span(&good, 1), "", 1.5));
  EXPECT_FALSE(run(upright(), std::span(&good, 1), "", 0.4, {0, 0, 0}));
  EXPECT_FALSE(run(upright(), std::span(&good, 1), "slices=1"));
  EXPECT_FALSE(run(upright(), std::span(&good, 1), "slices=256,resolution=4096"));
  EXPECT_FALSE(run(upright(), std::span(&good, 1), "filter_radius_mm=900,resolution=1024"));
}

TEST(OpacityMap, EightBits_CutSigmaOffAtOneAndCountIt) {
  strands::Groom groom;
  for (int i = 0; i < 4; ++i)
    tests::add_strand(groom, {{-0.05f, 0.01f * float(i), 0}, {0.05f, 0.01f * float(i), 0}}, 0.005f);
  tests::add_strand(groom, {{-0.05f, -0.01f, -0.05f}, {0.05f, -0.01f, -0.05f}}, 0.0001f);
  const glm::vec3 behind(0, -0.05f, 0);
  const auto cut = run(groom, std::span(&behind, 1), "form=graphics_8bit", 0.9);
  const auto whole = run(groom, std::span(&behind, 1), "", 0.9);
  ASSERT_TRUE(cut && whole);
  EXPECT_NEAR(cut->values[0], std::exp(-5.5), 1e-5);
  EXPECT_NEAR(whole->values[0], 1e-4, 1e-6);
  EXPECT_GT(cut->clamped, 0u);
  EXPECT_EQ(whole->clamped, 0u);
  EXPECT_EQ(cut->cost.bytes, 16u * 256 * 256);
  EXPECT_LE(whole->cost.bytes, 4u * 15 * 256 * 256);
  EXPECT_GT(whole->cost.bytes, 4u * 15 * 255 * 256);
}

TEST(OpacityMap, HalfFloats_ChangeSigmaByLessThanAThousandth) {
  strands::Groom groom = tests::coat(2000, 8, 0.03, 1e-4f, 3);
  for (const float corner : {-0.2f, 0.2f})  // the map of half floats is always square
    tests::add_strand(groom, {{corner, 0, corner}, {corner, 0.001f, corner}}, 1e-4f);
  const auto half = run(groom, groom.positions, "form=graphics_half"), whole = run(groom, groom.positions, "");
  double worst = 0;
  for (std::size_t i = 0; i < groom.positions.size(); ++i)
    worst = std::max(worst, std::abs(std::log(double(half->values[i])) - std::log(double(whole->values[i]))));
  EXPECT_GT(worst, 0);
  EXPECT_LT(worst, 5e-3);
}

// N19. A sheet that takes 0.4 half way along a segment, whose ends lie before the first plane and behind the last:
// their weights give the sheet in proportion, whose T is 0.6^f; the fragment's own give all or nothing.
TEST(TentWeights, SegmentThroughASheet_VerticesSpreadItsShadow) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0.05f, 0}, {0.05f, 0.05f, 0}}, 0.005f);
  tests::add_strand(groom, {{-0.05f, 0.1f, -0.05f}, {-0.05f, 0, -0.05f}}, 0.0001f);
  std::vector<glm::vec3> points;
  std::vector<SegmentPlace> places;
  for (const float f : {0.0f, 0.25f, 0.75f, 1.0f}) {
    places.push_back({{0, 0.1f, 0}, {0, 0, 0}, f});
    points.emplace_back(0, 0.1f - 0.1f * f, 0);
  }
  for (const char* form : {"compute", "graphics_half"}) {
    const std::string set = std::string("form=") + form;
    const auto own = run_on_segments(groom, points, places, set);
    const auto interpolated = run_on_segments(groom, points, places, set + ",weights=per_vertex");
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(own[i], places[i].fraction < 0.5f ? 1 : 0.6, 1e-3) << form << i;
      EXPECT_NEAR(interpolated[i], std::pow(0.6, double(places[i].fraction)), 1e-3) << form << i;
    }
  }
}

// The measured difference of N19: what weights per vertex change where segments pass several planes.
TEST(TentWeights, MorePlanesASegment_MoreDifference) {
  const strands::Groom groom = tests::coat(2000, 8, 0.03, 1e-4f, 3);
  std::vector<glm::vec3> points;
  std::vector<SegmentPlace> places;
  for (std::size_t v = 0; v + 1 < groom.vertex_count(); v += 4) {
    places.push_back({groom.positions[v], groom.positions[v + 1], 0.5f});
    points.push_back(0.5f * (groom.positions[v] + groom.positions[v + 1]));
  }
  double before = 0;
  for (const std::string slices : {"4", "16", "64"}) {
    const auto own = run_on_segments(groom, points, places, "between=even,slices=" + slices);
    const auto interpolated = run_on_segments(groom, points, places, "weights=per_vertex,slices=" + slices);
    double sum = 0, most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      sum += std::abs(double(own[i] - interpolated[i]));
      most = std::max(most, std::abs(double(own[i] - interpolated[i])));
    }
    const double mean_difference = sum / double(points.size());
    std::printf("%s slices: T differs by %.5f in the mean, %.4f at most\n", slices.c_str(), mean_difference, most);
    EXPECT_GT(mean_difference, before) << slices;
    EXPECT_LT(mean_difference, 0.02) << slices;
    before = mean_difference;
  }
}

TEST(TentWeights, UnsoundSegments_AreRefused) {
  const strands::Groom groom = upright();
  const auto values = tests::values_of("opacity_map", "weights=per_vertex").value();
  const Method& method = **find_method("opacity_map");
  const glm::vec3 points[] = {glm::vec3(0), glm::vec3(0)};
  const SegmentPlace bad[] = {{glm::vec3(0), glm::vec3(0), 0.5f}, {glm::vec3(0), glm::vec3(0), 1.5f}};
  EXPECT_EQ(method.evaluate({&groom}, {points, {}, bad}, values).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(method.evaluate({&groom}, {points, {}, std::span(bad, 1)}, values).error().kind, ErrorKind::usage);
}

TEST(OpacityMap, MorePlanesThanTheTargetsHold_AreRefused) {
  const glm::vec3 point(0);
  EXPECT_TRUE(run(upright(), std::span(&point, 1), "form=graphics_half,slices=17"));
  const auto refused = run(upright(), std::span(&point, 1), "form=graphics_half,slices=18");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::usage);
}

}  // namespace cuticle::shadows::opacity_map_test
