// The ladder on a small scene: its sum, a rung that is switched off, and the errors' own properties.
#include "study/picture/picture_study.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

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
  request.truth_coverage = 4;
  return request;
}

std::shared_ptr<gpu::Device> device() {
  static const std::shared_ptr<gpu::Device> opened = *gpu::Device::open({});
  return opened;
}

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
  const LadderSum sum = sum_of(small_ladder());
  for (std::size_t k = 0; k < sum.added.size(); ++k) EXPECT_GT(sum.added[k], 0) << small_ladder().rungs[k + 1].rung.name;
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
    EXPECT_EQ(ladder.rungs[1].color.pixels, ladder.rungs[0].color.pixels) << second;
    EXPECT_NE(ladder.rungs[2].color.pixels, ladder.rungs[1].color.pixels) << third;
    request.without = {third};
    const Ladder other = *climb(device(), rungs, request, silent_progress());
    EXPECT_EQ(other.rungs[2].color.pixels, other.rungs[1].color.pixels) << third;
    EXPECT_NE(other.rungs[1].color.pixels, other.rungs[0].color.pixels) << second;
  }
}

TEST(Ladder, AnUnknownRung_IsRefusedByName) {
  LadderRequest request = small_request("");
  request.without = {"tabels"};
  EXPECT_NE(rungs_of(request).error().message.find("tabels"), std::string::npos);
}

TEST(StrandErrors, AStrandTwiceAsBright_IsOffByItsShareOfTheMean) {
  Image truth = make_image(8, 1, {"R", "G", "B", "A"}), picture = truth;
  for (std::size_t k = 0; k < truth.pixels.size(); ++k) {
    truth.pixels[k] = 1;
    picture.pixels[k] = k < 16 && k % 4 < 3 ? 2.0f : 1.0f;
  }
  const std::vector<double> errors = strand_errors(picture, truth, {0, 0, 0, 0, 1, 1, 1, -1});
  ASSERT_EQ(errors.size(), 1u);  // three pixels are too few
  EXPECT_NEAR(errors[0], 1, 1e-6);
  EXPECT_NEAR(squared_errors(truth, picture, truth)[0], 0.5, 1e-6);
  EXPECT_EQ(squared_errors(truth, picture, truth)[7], 0);
}

}  // namespace
}  // namespace cuticle::study::ladder_gpu_test
