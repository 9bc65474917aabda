// Frames of small scenes: what is dispatched equals the plan, frames repeat bit by bit, and the picture is lit hair.
#include <cuticle/plan/frame_runner_gpu.h>

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::plan {
namespace {

constexpr std::string_view k_light = R"("lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}])";
constexpr std::string_view k_shadow = R"("shadow": {"method": {"opacity_map": {"resolution": 64}}})";
constexpr std::string_view k_simulation = R"("simulation": {"solver": {"classic": {}}, "effects": {"gravity": {}}})";
constexpr std::string_view k_colliders = R"("colliders": {"head": true})";
constexpr std::string_view k_tiles = R"("render": {"method": "tiles"})";
constexpr std::string_view k_quads = R"("render": {"method": "quads"})";
constexpr std::string_view k_truth = R"("render": {"method": "truth"})";
constexpr std::string_view k_motion = R"("motion": {"bvh": "motion/head_turn.bvh"})";

std::shared_ptr<gpu::Device> device() {
  static const auto opened = gpu::Device::open({.choice = "cpu", .validation = true});
  EXPECT_TRUE(opened) << (opened ? "" : opened.error().message);
  return opened ? *opened : nullptr;
}

std::unique_ptr<FrameRunner> runner(std::initializer_list<std::string_view> parts) {
  std::string text = R"({"schema_version": 1, "strand_count": 500, "strand_vertices": 12, "material": {"lut_size": 32},
    "camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 30, "resolution_px": [64, 64]})";
  for (std::string_view part : parts) text += ", " + std::string(part);
  const auto scene = scene::parse_scene(text + "}", CUTICLE_SOURCE_DIR "/scenes", "test", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  auto made = FrameRunner::create(device(), *scene, silent_progress());
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return std::move(*made);
}

FrameResult frame_of(FrameRunner& runner, int frame) {
  auto result = runner.run(frame, {.render = true, .read_state = true});
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return std::move(*result);
}

std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> planned(const Plan& plan) {
  std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> counts;
  for (const PlannedPass& pass : plan.passes)
    if (pass.dispatches + pass.draws > 0) counts[std::string(pass.entry->name)] = {pass.dispatches, pass.draws};
  return counts;
}

std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> counted(const gpu::SubmitCost& cost) {
  std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> counts;
  for (const gpu::PassCost& pass : cost.passes)
    if (pass.dispatches + pass.draws > 0) counts[pass.name] = {pass.dispatches, pass.draws};
  return counts;
}

std::vector<float> luminance(const Image& image) {
  std::vector<float> values;
  for (std::size_t p = 0; p < image.pixels.size(); p += 4)
    values.push_back(0.2126f * image.pixels[p] + 0.7152f * image.pixels[p + 1] + 0.0722f * image.pixels[p + 2]);
  return values;
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (float value : values) sum += double(value);
  return sum / double(values.size());
}

TEST(FrameRunner, DispatchesOfEveryKindOfScene_EqualThePlan) {
  const std::vector<std::vector<std::string_view>> parts = {{},
                                                            {k_light},
                                                            {k_light, k_shadow, k_motion},
                                                            {k_simulation, k_colliders},
                                                            {k_light, k_shadow, k_simulation, k_colliders, k_motion},
                                                            {k_tiles},
                                                            {k_light, k_shadow, k_tiles},
                                                            {k_light, k_shadow, k_quads},
                                                            {k_light, k_truth}};
  for (const auto& part : parts) {
    std::string text = R"("name": "grid")";
    for (std::string_view piece : part) text += ", " + std::string(piece);
    const auto made = runner({text});
    for (int frame : {0, 1})
      EXPECT_EQ(counted(frame_of(*made, frame).cost), planned(made->plan())) << text << " frame " << frame;
  }
}

TEST(FrameRunner, TwoRuns_AreBitIdentical) {
  std::vector<std::vector<float>> runs;
  for (int run = 0; run < 2; ++run) {
    const auto made = runner({k_light, k_shadow, k_simulation, k_colliders, k_motion});
    runs.push_back(frame_of(*made, 4).color.pixels);
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST(FrameRunner, TwoRunsByTiles_AreBitIdentical) {
  std::vector<std::vector<float>> runs;
  for (int run = 0; run < 2; ++run)
    runs.push_back(frame_of(*runner({k_light, k_shadow, k_motion, k_tiles}), 2).color.pixels);
  EXPECT_EQ(runs[0], runs[1]);
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t p = 0; p < a.pixels.size(); ++p) sum += std::abs(double(a.pixels[p]) - double(b.pixels[p]));
  return sum / double(a.pixels.size());
}

// Hair before, behind and beside a head: far nearer to brute force than the head alone is.
TEST(FrameRunner, Tiles_AreNearTheTruthAroundAHead) {
  const Image truth = frame_of(*runner({k_light, k_shadow, k_truth}), 0).color;
  const Image tiles = frame_of(*runner({k_light, k_shadow, k_tiles}), 0).color;
  const Image bald = frame_of(*runner({k_light, R"("passes": {"tiles": {"opacity": 0}})", k_tiles}), 0).color;
  const double error = mean_difference(tiles, truth);
  RecordProperty("mean_error", std::to_string(error));
  EXPECT_LT(error, 0.004);
  EXPECT_LT(5 * error, mean_difference(bald, truth));
}

TEST(FrameRunner, Quads_AreNearTheTruthAroundAHeadTheMoreSamplesTheNearer) {
  const Image truth = frame_of(*runner({k_light, k_shadow, k_truth}), 0).color;
  double last = 1;
  for (std::string_view samples :
       {R"("passes": {"quads": {"samples": 1}})", R"("passes": {"quads": {"samples": 4}})"}) {
    const Image quads = frame_of(*runner({k_light, k_shadow, k_quads, samples}), 0).color;
    const double error = mean_difference(quads, truth);
    std::printf("quads: mean error %.5f\n", error);
    EXPECT_LT(error, last);
    last = error;
  }
  EXPECT_LT(last, 0.008);
}

// H11: a quarter of the strands, four times as wide, shadows all of them.
TEST(FrameRunner, FewerThickerCasters_TakeAsMuchLight) {
  constexpr std::string_view few = R"("shadow": {"method": {"opacity_map": {"resolution": 64}}, "caster_share": 0.25})";
  const double all = mean(luminance(frame_of(*runner({k_light, k_shadow}), 0).color));
  const double quarter = mean(luminance(frame_of(*runner({k_light, few}), 0).color));
  const double open = mean(luminance(frame_of(*runner({k_light}), 0).color));
  std::printf("mean luminance: %.5f by all, %.5f by a quarter, %.5f without shadow\n", all, quarter, open);
  EXPECT_LT(std::abs(quarter - all), 0.16 * (open - all));
}

TEST(FrameRunner, AnEarlierFrame_StartsAnewAndRepeats) {
  const auto made = runner({k_light, k_simulation, k_motion});
  const std::vector<float> first = frame_of(*made, 2).color.pixels;
  frame_of(*made, 5);
  EXPECT_EQ(frame_of(*made, 2).color.pixels, first);
}

TEST(FrameRunner, Picture_IsCoveredFiniteAndHighlit) {
  const auto made = runner({k_light, k_shadow, R"("head": {"present": false})"});
  const Image color = frame_of(*made, 0).color;
  for (float value : color.pixels) ASSERT_TRUE(std::isfinite(value));
  double covered = 0;
  for (std::size_t p = 3; p < color.pixels.size(); p += 4) covered += double(color.pixels[p]) / (64.0 * 64.0);
  EXPECT_GT(covered, 0.05);
  EXPECT_LT(covered, 0.8);
  std::vector<float> lit = luminance(color);
  std::erase_if(lit, [](float value) { return value < 1e-3f; });
  ASSERT_GT(lit.size(), 100u);
  std::ranges::sort(lit);
  EXPECT_GT(lit[lit.size() * 99 / 100], 1.6f * lit[lit.size() / 2]) << "no highlight stands out";
}

TEST(FrameRunner, NoLight_IsBlack) {
  const Image color = frame_of(*runner({}), 0).color;
  EXPECT_THAT(luminance(color), testing::Each(0.0f));
}

TEST(FrameRunner, Shadows_TakeLightAway) {
  constexpr std::string_view bare = R"("head": {"present": false})";
  const double open = mean(luminance(frame_of(*runner({k_light, bare}), 0).color));
  const double shadowed = mean(luminance(frame_of(*runner({k_light, k_shadow, bare}), 0).color));
  EXPECT_GT(open, 0);
  EXPECT_LT(shadowed, 0.9 * open);
  EXPECT_GT(shadowed, 0.05 * open);
}

TEST(FrameRunner, WithoutSimulation_HairFollowsTheHeadRigidly) {
  const auto made = runner({k_motion});
  const std::vector<glm::vec3> rest = frame_of(*made, 0).state.positions, turned = frame_of(*made, 15).state.positions;
  ASSERT_EQ(rest.size(), turned.size());
  double furthest = 0;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    EXPECT_NEAR(glm::distance(rest[i], rest[i - 1]), glm::distance(turned[i], turned[i - 1]), 1e-5);
    furthest = std::max(furthest, double(glm::distance(rest[i], turned[i])));
  }
  EXPECT_GT(furthest, 0.03);
}

TEST(FrameRunner, DrawnStrands_HaveTheScenesCounts) {
  const auto made = runner({});
  frame_of(*made, 0);
  const auto strands = made->drawn_strands();
  ASSERT_TRUE(strands);
  EXPECT_EQ(strands->strand_count(), 500u);
  EXPECT_EQ(strands->vertex_count(), 6000u);
  EXPECT_TRUE(strands::validate(*strands));
}

}  // namespace
}  // namespace cuticle::plan
