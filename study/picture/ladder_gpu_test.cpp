// The ladder on a small scene: its sum, a rung that is switched off, and the errors' own properties.
#include "study/picture/picture_study.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "plan/plan.h"

namespace cuticle::study::ladder_gpu_test {
namespace {

LadderRequest small_request(const std::string& hair) {
  LadderRequest request;
  request.name = "small";
  request.scene = *scene::load_scene(CUTICLE_SOURCE_DIR "/scenes/still.json", plan::catalogue());
  request.scene.strand_count = 600;
  request.scene.camera.camera.resolution = {24, 24};
  request.scene.material.lut_size = 16;
  const auto& passes = plan::catalogue().passes;
  const auto dual = std::ranges::find(passes, "dual_scattering", &registry::Entry::name);
  request.scene.passes.emplace("dual_scattering", registry::default_values((*dual)->parameters));
  request.hair = hair;
  request.samples = 4;
  request.batches = 2;
  request.truth_coverage = 4;
  return request;
}

using tests::device;

const Ladder& small_ladder() {
  static const Ladder ladder = *climb(device(), small_request("blond"), silent_progress());
  return ladder;
}

TEST(Ladder, Steps_AddUpToTheTotalWithTheirProducts) {
  const LadderSum sum = sum_of(small_ladder());
  ASSERT_EQ(sum.added.size() + 1, small_ladder().rungs.size());
  EXPECT_GT(sum.total, 0);
  EXPECT_NEAR(sum.sum + sum.products, sum.total, 1e-6 * sum.total);
  EXPECT_NEAR(sum.remainder, sum.products, 1e-6 * sum.sum);
  EXPECT_EQ(sum.against_truth.back(), sum.total);
  EXPECT_GT(sum.noise, 0);
}

TEST(Ladder, Rungs_EachChangesThePicture) {
  const auto& rungs = small_ladder().rungs;
  for (std::size_t k = 1; k < rungs.size(); ++k)
    EXPECT_NE(mean_of(rungs[k].picture).pixels, mean_of(rungs[k - 1].picture).pixels) << rungs[k].rung.name;
}

Rung named(const std::vector<Rung>& rungs, std::string_view name) {
  return *std::ranges::find(rungs, name, &Rung::name);
}

// Traced, shaded at the vertices, drawn by a device: the picture has the bits of that of the rung before.
TEST(Ladder, ARungSwitchedOff_ReturnsTheFormerPicture) {
  LadderRequest request = small_request("");
  const std::vector<Rung> all = *rungs_of(request);
  for (const auto& [second, third] : {std::pair("single_scattering", "strand_space"), {"strand_space", "coverage"}}) {
    const std::vector<Rung> rungs = {all[0], named(all, second), named(all, third)};
    request.without = {second};
    const Ladder ladder = *climb(device(), rungs, request, silent_progress());
    EXPECT_EQ(ladder.rungs[1].picture.batches[0].pixels, ladder.rungs[0].picture.batches[0].pixels) << second;
    EXPECT_NE(ladder.rungs[2].picture.batches[0].pixels, ladder.rungs[1].picture.batches[0].pixels) << third;
    request.without = {third};
    const Ladder other = *climb(device(), rungs, request, silent_progress());
    EXPECT_EQ(other.rungs[2].picture.batches[0].pixels, other.rungs[1].picture.batches[0].pixels) << third;
    EXPECT_NE(other.rungs[1].picture.batches[0].pixels, other.rungs[0].picture.batches[0].pixels) << second;
  }
}

TEST(Ladder, AnUnknownRung_IsRefusedByName) {
  LadderRequest request = small_request("");
  request.without = {"tabels"};
  EXPECT_NE(rungs_of(request).error().message.find("tabels"), std::string::npos);
}

// A head that turns: the last rung alone has the scene's own steps.
TEST(Ladder, HairThatMoves_HasARungOfItsSteps) {
  LadderRequest request = small_request("");
  const scene::Scene turn = *scene::load_scene(CUTICLE_SOURCE_DIR "/scenes/head_turn.json", plan::catalogue());
  request.scene.motion = turn.motion;
  request.scene.simulation = turn.simulation;
  request.scene.simulation.settle_time = 0;
  request.scene.strand_count = 200;
  request.frame = 8;
  request.reference_steps = 8;
  const std::vector<Rung> all = *rungs_of(request);
  ASSERT_EQ(all.back().name, "simulation_steps");
  const std::vector<Rung> rungs = {all[0], named(all, "coverage"), all.back()};
  const Ladder ladder = *climb(device(), rungs, request, silent_progress());
  EXPECT_NE(ladder.rungs[2].picture.batches[0].pixels, ladder.rungs[1].picture.batches[0].pixels);
  EXPECT_EQ(ladder.rungs[0].pose, ladder.rungs[1].pose);
  EXPECT_TRUE(ladder.rungs[2].pose->simulate_further());
  request.without = {"simulation_steps"};
  const Ladder other = *climb(device(), rungs, request, silent_progress());
  EXPECT_EQ(other.rungs[2].picture.batches[0].pixels, other.rungs[1].picture.batches[0].pixels);
  EXPECT_EQ(other.rungs[1].picture.batches[0].pixels, ladder.rungs[1].picture.batches[0].pixels);
}

}  // namespace
}  // namespace cuticle::study::ladder_gpu_test
