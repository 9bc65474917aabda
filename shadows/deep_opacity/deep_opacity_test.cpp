#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "shadows/deep_opacity/deep_map.h"
#include "shadows/method.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::shadows::deep_opacity_test {

namespace {

Result<Transmittance> run(const strands::Groom& groom, std::span<const glm::vec3> points, const std::string& set,
                          double alpha = 0.4, glm::dvec3 light = {0, 1, 0}, std::string_view name = "deep_opacity") {
  return tests::run_shadow(name, groom, points, set, alpha, light);
}
float one(const strands::Groom& groom, glm::vec3 point, const std::string& set = "", double alpha = 0.4) {
  return tests::shadow_at("deep_opacity", groom, point, set, alpha);
}
using tests::mean;
deep_opacity::Map map_of(const strands::Groom& groom, const std::string& set, glm::dvec3 to_light = {0, 1, 0}) {
  const auto values = registry::parse_assignments((*find_method("deep_opacity"))->entry.parameters, set).value();
  return deep_opacity::build_map(groom, 0.4, light_axes(unit_to_light(to_light).value()),
                                 settings_from<deep_opacity::Settings>(values).value());
}
/// A fibre along x at each height, 0.1 m long.
strands::Groom pile(std::initializer_list<float> heights) {
  strands::Groom groom;
  for (const float y : heights) tests::add_strand(groom, {{-0.05f, y, 0}, {0.05f, y, 0}}, 0.005f);
  tests::add_strand(groom, {{-0.05f, 0, -0.05f}, {0.05f, 0, -0.05f}}, 0.0001f);
  return groom;
}

/// Mean T half-way through opaque hair, off the exact list's: measured .016 with one layer (.038 where sigma grows
/// evenly in a layer).
constexpr float k_of_random_depths = 0.025f;

}  // namespace

TEST(DeepOpacity, RandomSlab_FollowsTheExponentialLaw) {
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, 2e-5f, 7);
  const double area = 4e-5 * tests::length_per_area(groom, 0.02, -1);
  for (const double alpha : {0.1, 0.5, 1.0}) {
    auto result = run(groom, tests::grid_below(-0.06), "layers=8,accumulate=poisson,filter_texels=3", alpha);
    ASSERT_TRUE(result);
    EXPECT_NEAR(mean(result->values) / std::exp(-alpha * area), 1, 0.01);
  }
}

TEST(DeepOpacity, HalfWayThroughASlab_HalfTheDepthCounts) {
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, 2e-5f, 7);
  const double area = 4e-5 * tests::length_per_area(groom, 0.02, 0.025);
  for (const char* spacing : {"equal_opacity", "geometric", "equal"}) {
    auto result = run(groom, tests::grid_below(0.025),
                      std::string("layers=16,accumulate=poisson,filter_texels=3,spacing=") + spacing);
    ASSERT_TRUE(result);
    EXPECT_NEAR(mean(result->values) / std::exp(-0.4 * area), 1, 0.015) << spacing;
  }
}

TEST(DeepOpacity, SparseTiles_SameShadowInFewerBytes) {
  const strands::Groom groom = tests::coat(300, 8, 0.03, 1e-4f, 3);
  for (const std::string storage : {"words", "bytes"}) {
    const std::string set = "layers=3,filter_texels=2,storage=" + storage;
    const auto all = run(groom, groom.positions, set).value();
    const auto sparse = run(groom, groom.positions, set + ",tiles=sparse").value();
    EXPECT_EQ(all.values, sparse.values) << storage;
    EXPECT_LT(sparse.cost.bytes, all.cost.bytes * 3 / 4) << storage;
    EXPECT_EQ(sparse.clamped, 0u);
  }
}

TEST(DeepOpacity, TilesWithoutRoom_LetLightThroughAndAreCounted) {
  const strands::Groom groom = tests::coat(300, 8, 0.03, 1e-4f, 3);
  const auto all = run(groom, groom.positions, "layers=3").value();
  const auto cut = run(groom, groom.positions, "layers=3,tiles=sparse,tile_share=0.1").value();
  EXPECT_GT(cut.clamped, 0u);
  EXPECT_GT(mean(cut.values), mean(all.values) + 0.01);
  for (std::size_t i = 0; i < all.values.size(); ++i) EXPECT_GE(cut.values[i] + 1e-6f, all.values[i]) << i;
}

TEST(DeepOpacity, NearestFibre_IsLitAndTakesAlphaBehindIt) {
  const strands::Groom groom = pile({0.05f});
  EXPECT_EQ(one(groom, {0, 0.05f, 0}), 1.0f);
  EXPECT_EQ(one(groom, {0, 0.06f, 0}), 1.0f);
  EXPECT_NEAR(one(groom, {0, 0, 0}), 0.6, 1e-4);
  EXPECT_EQ(one(groom, {0, 0, 0.02f}), 1.0f) << "beside the fibre";
}

TEST(DeepOpacity, BehindTheLastLayer_EveryFibreCounts) {
  EXPECT_NEAR(one(pile({0.05f, 0.04f, 0.001f}), {0, -1, 0}, "layers=2"), 0.216, 2e-4);
  EXPECT_NEAR(one(pile({0.05f, 0.04f, 0.001f}), {0, -1, 0}, "layers=1"), 0.216, 2e-4);
}

// What the method is for: a surface that is not square to the light. Evenly spaced slices put the front fibres and
// those behind them into one interval; layers that start at the front do not.
TEST(DeepOpacity, SlantedSheet_FrontIsLitWhereSlicesShadowIt) {
  std::vector<glm::vec3> front;
  const strands::Groom groom = tests::slanted_sheet(front);
  const auto deep = run(groom, front, "layers=4"),
             slices = run(groom, front, "slices=4", 0.4, {0, 1, 0}, "opacity_map"),
             list = run(groom, front, "", 0.4, {0, 1, 0}, "exact_list");
  std::printf("front of a slanted sheet: %.3f with 4 layers, %.3f with 4 slices, %.3f by the exact list\n",
              mean(deep->values), mean(slices->values), mean(list->values));
  EXPECT_LT(mean(slices->values), 0.75);
  EXPECT_NEAR(mean(deep->values), mean(list->values), 0.02);
}

// A texel's hair is known to begin and to end with a fibre: where there are two, one layer holds both in their places.
TEST(DeepOpacity, TwoFibresInOneLayer_EachCountsWhereItLies) {
  strands::Groom groom = pile({0.05f, 0.03f});
  for (int i = 0; i < 20; ++i)  // what a fibre covers is sampled, from the first segment on
    tests::add_strand(groom, {{-0.05f, 0.001f * float(i), 0.05f}, {0.05f, 0.001f * float(i), 0.05f}}, 0.005f);
  for (const char* layers : {"layers=1", "layers=4"}) {
    EXPECT_NEAR(one(groom, {0, 0.049f, 0}, layers), 0.6, 1e-3) << layers;
    EXPECT_NEAR(one(groom, {0, 0.031f, 0}, layers), 0.6, 1e-3) << layers;
    EXPECT_NEAR(one(groom, {0, 0.029f, 0}, layers), 0.36, 1e-3) << layers;
  }
}

TEST(DeepOpacity, OpaqueHairInFewLayers_KeepsTheLightBeforeIt) {
  const strands::Groom groom = tests::random_slab(1500, 0.1, 0.05, 1e-4f, 7);
  const auto points = tests::grid_below(0.025);
  const std::string map = "resolution=512,filter_texels=1";
  const float wanted = mean(run(groom, points, map, 1, {0, 1, 0}, "exact_list").value().values);
  for (const std::string layers : {"1", "4", "16"}) {
    const float got = mean(run(groom, points, map + ",layers=" + layers, 1).value().values);
    std::printf("%s layers leave %.3f of the light, the exact list %.3f\n", layers.c_str(), double(got),
                double(wanted));
    EXPECT_NEAR(got, wanted, k_of_random_depths) << layers;
  }
}

TEST(DeepOpacity, EqualOpacity_EndsSplitTheHairEvenly) {
  for (const int strands : {6000, 60000}) {  // of which the histogram counts all segments and one run of 64 in thirteen
    const strands::Groom groom = tests::random_slab(strands, 0.1, 0.05, 2e-5f, 7);
    const deep_opacity::Map map = map_of(groom, "layers=4,resolution=64,layer_range=map");
    std::vector<double> sums(4);
    for (std::size_t t = 0; t < map.ranges.size(); ++t)
      for (std::size_t l = 0; l < 4; ++l) sums[l] += map.sums[4 * t + l];
    for (std::size_t l = 0; l < 4; ++l) EXPECT_NEAR(sums[l] / sums[3], double(l + 1) / 4, 0.02) << strands << " " << l;
  }
}

// The first i of n layers of each texel hold (i / n)^1.5 of its hair.
TEST(DeepOpacity, EqualOpacityByTexel_LayersAreThinnerTowardTheLight) {
  const strands::Groom groom = tests::random_slab(6000, 0.1, 0.05, 2e-5f, 7);
  const deep_opacity::Map map = map_of(groom, "layers=4,resolution=64");
  std::vector<double> sums(4);
  for (std::size_t t = 0; t < map.ranges.size(); ++t)
    for (std::size_t l = 0; l < 4; ++l) sums[l] += map.sums[4 * t + l];
  for (std::size_t l = 0; l < 4; ++l) EXPECT_NEAR(sums[l] / sums[3], std::pow(double(l + 1) / 4, 1.5), 0.02) << l;
}

// What layers of each texel are for: thin hair, a few fibres before many, beside deep hair. One range of layers for
// both holds all of the thin hair in its first layer.
TEST(DeepOpacity, ThinHairBesideDeepHair_LayersFollowBoth) {
  strands::Groom groom = tests::random_slab(3000, 0.1, 0.2, 1e-4f, 7);
  for (const auto& [strands, height] : {std::pair(300, 0.01f), std::pair(1200, 0.0f)}) {
    strands::Groom sheet = tests::random_slab(strands, 0.1, 0.002, 1e-4f, 9);
    for (glm::vec3& point : sheet.positions) point += glm::vec3(0.6f, height, 0);
    strands::append(groom, sheet);
  }
  std::vector<glm::vec3> between;
  for (int i = 0; i < 400; ++i)
    between.emplace_back(0.57f + 0.003f * float(i / 20), 0.006f, -0.03f + 0.003f * float(i % 20));
  const std::string map = "resolution=256,filter_texels=1";
  const std::vector<float> list = run(groom, between, map, 0.4, {0, 1, 0}, "exact_list").value().values;
  const auto error_of = [&](const std::string& range) {
    const std::vector<float> got = run(groom, between, map + ",layers=4,layer_range=" + range).value().values;
    double sum = 0;
    for (std::size_t i = 0; i < got.size(); ++i) sum += double(std::abs(got[i] - list[i])) / double(got.size());
    return sum;
  };
  const double by_texel = error_of("texel"), by_map = error_of("map");
  std::printf("behind a thin front: off by %.4f with layers of each texel, by %.4f with those of the map\n", by_texel,
              by_map);
  EXPECT_LT(by_texel, 0.012);
  EXPECT_GT(by_map, 0.05);
}

TEST(DeepOpacity, PartsOfATexelsDepth_AreWholeQuotients) {
  for (std::uint32_t extent = 1; extent <= deep_opacity::k_depth_steps + 1; ++extent)
    for (std::uint32_t behind = 0; behind < extent; ++behind)
      ASSERT_EQ(deep_opacity::layer_step(behind, extent, true), behind * deep_opacity::k_depth_steps / extent)
          << behind << " " << extent;
}

// Half-way through a layer of even hair: half of it lies before a point, less before one that is seen with the light.
TEST(DeepOpacity, SeenPoint_ThePowerOfItsShareLiesBefore) {
  const deep_opacity::Layer layer{1, 100, 200};
  const auto before = [&](double power) {
    return deep_opacity::exponent_within(layer, 1000.0, 150.0, 1.0, -1.0, -2.0, 0.0, 0.0, 0.0, power);
  };
  EXPECT_NEAR(before(1), -1.5, 1e-12);
  EXPECT_NEAR(before(1.5), -1 - std::pow(0.5, 1.5), 1e-12);
}

TEST(DeepOpacity, GeometricLayers_GrowByOneRatio) {
  const deep_opacity::Map map = map_of(pile({0.05f, 0.04f, 0.001f}), "layers=8,spacing=geometric");
  for (std::uint32_t l = 2; l < 7; ++l) EXPECT_NEAR(double(map.ends.end[l]) / map.ends.end[l - 1], 2, 0.05) << l;
  EXPECT_EQ(map.ends.end[7], deep_opacity::k_no_end);
}

TEST(DeepOpacity, TransparentOrEmpty_LetsAllThrough) {
  EXPECT_EQ(one({}, {0, 0, 0}), 1.0f);
  EXPECT_EQ(one(pile({0.05f}), {0, -1, 0}, "", 0), 1.0f);
}

TEST(DeepOpacity, OpaqueWideFibre_LetsNothingThrough) { EXPECT_LT(one(pile({0.05f}), {0, 0, 0}, "", 1), 1e-4f); }

TEST(DeepOpacity, FlatGroom_FrontFreeAndBackShadowed) {
  strands::Groom groom;
  tests::add_strand(groom, {{-0.05f, 0, 0}, {0.05f, 0, 0}}, 0.005f);
  EXPECT_EQ(one(groom, {0, 0, 0}, "layers=16"), 1.0f);
  EXPECT_NEAR(one(groom, {0, -0.01f, 0}, "layers=16"), 0.6, 1e-4);
}

TEST(DeepOpacity, LightAlongTheStrands_TheDepthOfEachPieceCounts) {
  strands::Groom groom;
  tests::add_strand(groom, {{0, 0.1f, 0}, {0, 0.05f, 0}, {0, 0, 0}}, 0.01f);
  tests::add_strand(groom, {{-0.05f, 0, 0}, {0.05f, 0, 0}}, 0.0001f);
  EXPECT_EQ(one(groom, {0, 0.1f, 0}, "layers=16"), 1.0f);
  EXPECT_LT(one(groom, {0, -0.01f, 0}, "layers=16"), 0.7f);
}

TEST(DeepOpacity, AnyThreadCount_SameIntegers) {
  const strands::Groom groom = tests::coat(2000, 8, 0.03, 1e-4f, 3);
  const deep_opacity::Map all = map_of(groom, "", {0.6, 0.8, 0});
  tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const deep_opacity::Map alone = map_of(groom, "", {0.6, 0.8, 0});
  EXPECT_EQ(alone.sums, all.sums);
  EXPECT_EQ(alone.ranges, all.ranges);
}

TEST(DeepOpacity, BadInput_IsRefused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  strands::Groom broken = pile({0.05f});
  broken.positions[1].y = nan;
  const glm::vec3 good(0), bad(nan, 0, 0);
  EXPECT_FALSE(run(broken, std::span(&good, 1), ""));
  EXPECT_FALSE(run(pile({0.05f}), std::span(&bad, 1), ""));
  EXPECT_FALSE(run(pile({0.05f}), std::span(&good, 1), "", 1.5));
  EXPECT_FALSE(run(pile({0.05f}), std::span(&good, 1), "", 0.4, {0, 0, 0}));
  EXPECT_FALSE(run(pile({0.05f}), std::span(&good, 1), "layers=17"));
  EXPECT_FALSE(run(pile({0.05f}), std::span(&good, 1), "filter_radius_mm=900"));
}

TEST(DeepOpacity, StorageInBytes_IsCloseAndAQuarterOfTheSize) {
  const strands::Groom groom = tests::coat(2000, 6, 0.03, 1e-4f, 3);
  const Method& method = **find_method("deep_opacity");
  const auto evaluate = [&](const std::string& set) {
    const auto values = registry::parse_assignments(method.entry.parameters, "layers=16,resolution=128" + set).value();
    return method.evaluate({&groom, 0.4, {1, 1, 0.3}}, {groom.positions, {}}, values).value();
  };
  const Transmittance words = evaluate(""), bytes = evaluate(",storage=bytes");
  const std::size_t texels = words.cost.bytes / (17 * 4);
  EXPECT_EQ(words.cost.bytes, texels * 17 * 4);
  EXPECT_LE(texels, 128u * 128);
  EXPECT_GT(texels, 127u * 128);
  EXPECT_NEAR(double(bytes.cost.bytes), 20.0 * double(texels), 6) << "whole words";
  float worst = 0;
  for (std::size_t i = 0; i < words.values.size(); ++i)
    worst = std::max(worst, std::abs(words.values[i] - bytes.values[i]));
  std::printf("8 bits: largest difference %.5f\n", double(worst));
  EXPECT_LT(worst, 0.5f / 255 + 1e-4f) << "rounding to 255ths";
  EXPECT_GT(worst, 0.0f);
}

}  // namespace cuticle::shadows::deep_opacity_test
