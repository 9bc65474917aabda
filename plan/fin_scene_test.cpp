// The fins of scenes/nalu.json: rigid at the root, soft at the tip, drawn where they are.
#include "plan/frame_runner_gpu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "gpu/tests/test_device.h"
#include "plan/head_path.h"
#include "plan/strand_set.h"

namespace cuticle::plan::fin_scene_test {
namespace {

scene::Scene small_mermaid() {
  auto scene = scene::load_scene(CUTICLE_SOURCE_DIR "/scenes/nalu.json", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  scene->strand_count = 60;
  scene->material.lut_size = 16;
  scene->camera.camera.resolution = {96, 96};
  scene->shadow.reset();
  return std::move(*scene);
}

std::unique_ptr<FrameRunner> runner_of(const scene::Scene& scene) {
  auto runner = FrameRunner::create(tests::device(), scene, silent_progress());
  EXPECT_TRUE(runner) << (runner ? "" : runner.error().message);
  return std::move(*runner);
}

/// What make_fins.py paints.
double painted(const glm::dvec2& uv) {
  const double along = std::clamp((uv.y - 0.1) / 0.9, 0.0, 1.0),
               spine = 0.5 + 0.5 * std::cos(12 * std::numbers::pi * uv.x);
  return along * along * (3 - 2 * along) * (1 - 0.3 * spine * (1 - along));
}

TEST(FinScene, PaintedWeights_AreThoseOfTheMapAtTheMeshesCoordinates) {
  const auto set = build_strand_set(small_mermaid());
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->fin_weights.size(), 260u);  // 2 fans of 13 rays x 10, one vertex a place
  double worst = 0;
  for (std::size_t i = 0; i < set->fin_weights.size(); ++i)
    worst = std::max(worst, std::abs(double(set->fin_weights[i]) - painted(glm::dvec2(set->fins.uv[i]))));
  std::printf("weights off by at most %.3f\n", worst);
  EXPECT_LT(worst, 0.005);  // 64 texels of 8 bits
}

TEST(FinScene, RootsGoWithTheHeadAndTipsLag_EdgesHold) {
  const scene::Scene scene = small_mermaid();
  const auto set = build_strand_set(scene);
  const auto path = HeadPath::create(scene, set->pivot);
  const auto runner = runner_of(scene);
  double off_root = 0, lag = 0, stretched = 0;
  for (int frame = 0; frame < 30; ++frame) {
    ASSERT_TRUE(runner->run(frame, {.render = false}));
    const strands::Mesh &fins = *runner->fins(), rigid = strands::transformed(set->fins, path->at(frame));
    for (std::size_t i = 0; i < fins.positions.size(); ++i) {
      const double off = double(glm::distance(fins.positions[i], rigid.positions[i]));
      double& worst = set->fin_weights[i] == 0 ? off_root : lag;
      worst = std::max(worst, off);
    }
    for (const auto& t : fins.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const double rest = double(glm::distance(rigid.positions[t[k]], rigid.positions[t[(k + 1) % 3]]));
        const double now = double(glm::distance(fins.positions[t[k]], fins.positions[t[(k + 1) % 3]]));
        stretched = std::max(stretched, now / rest - 1);
      }
  }
  std::printf("fins: roots %.1e m off the head, tips up to %.3f m behind, edges stretched by %.2f\n", off_root, lag,
              stretched);
  EXPECT_LT(off_root, 1e-6);
  EXPECT_GT(lag, 0.02);
  EXPECT_LT(lag, 0.2);
  EXPECT_LT(stretched, 0.45);  // where simulated and rigid places are mixed
}

glm::dvec2 pixel_of(const glm::dmat4& to_clip, const glm::vec3& point, const Image& image) {
  const glm::dvec4 clip = to_clip * glm::dvec4(glm::dvec3(point), 1);
  return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(image.width, image.height);
}

bool differs(const Image& with, const Image& without, int x, int y) {
  double change = 0;
  for (int c = 0; c < 3; ++c) change += std::abs(double(with.at(x, y, c) - without.at(x, y, c)));
  return change > 0.02;
}

/// Whether a place lies in a triangle or within a pixel of its sides' lines.
bool within_a_pixel(const glm::dvec2& place, const std::array<glm::dvec2, 3>& corners) {
  const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
  const double turn = cross(corners[1] - corners[0], corners[2] - corners[0]) < 0 ? -1 : 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = corners[(k + 1) % 3] - corners[k];
    if (turn * cross(side, place - corners[k]) < -glm::length(side)) return false;
  }
  return true;
}

struct Drawn {
  int on = 0, off = 0;  ///< pixels that differ from the picture without fins, on the mesh and beside it
};

Drawn pixels_of_fins(const Image& with, const Image& without, const glm::dmat4& to_clip, const strands::Mesh& fins) {
  Drawn drawn;
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x) {
      if (!differs(with, without, x, y)) continue;
      const bool on = std::ranges::any_of(fins.triangles, [&](const auto& t) {
        return within_a_pixel({x + 0.5, y + 0.5}, {pixel_of(to_clip, fins.positions[t[0]], with),
                                                   pixel_of(to_clip, fins.positions[t[1]], with),
                                                   pixel_of(to_clip, fins.positions[t[2]], with)});
      });
      ++(on ? drawn.on : drawn.off);
    }
  return drawn;
}

TEST(FinScene, FinsOfEachFrame_AreDrawnWhereTheyAre) {
  scene::Scene scene = small_mermaid(), bare = scene;
  scene.camera.camera.resolution = bare.camera.camera.resolution = {192, 192};
  bare.fins.reset();
  const auto runner = runner_of(scene), without = runner_of(bare);
  for (int frame : {0, 20}) {
    const auto drawn = runner->run(frame), plain = without->run(frame);
    ASSERT_TRUE(drawn && plain);
    const auto ran = std::ranges::find(drawn->cost.passes, "fins", &gpu::PassCost::name);
    ASSERT_NE(ran, drawn->cost.passes.end());
    EXPECT_EQ(ran->draws, find_pass(runner->plan(), "fins")->draws);
    const Camera camera = runner->camera(frame);
    const glm::dmat4 to_clip = projection_matrix(camera) * view_matrix(camera);
    const Drawn pixels = pixels_of_fins(drawn->color, plain->color, to_clip, *runner->fins());
    std::printf("frame %d: %d pixels of fins, %d off their mesh\n", frame, pixels.on, pixels.off);
    EXPECT_GT(pixels.on, 2000) << frame;
    EXPECT_EQ(pixels.off, 0) << frame;
  }
  EXPECT_EQ(find_pass(without->plan(), "fins"), nullptr);
  EXPECT_EQ(find_pass(without->plan(), "cloth"), nullptr);
}

TEST(FinScene, EffectsOfStrandsAlone_LeaveTheFinsTheirMotion) {
  for (const char* of_strands : {"clumping", "sleep", "strand_interaction"}) {
    scene::Scene scene = small_mermaid();
    scene.simulation.solver =
        scene::Block{"exact", registry::default_values((*sim::find_effect("exact"))->entry.parameters)};
    scene.simulation.effects[of_strands] = registry::default_values((*sim::find_effect(of_strands))->entry.parameters);
    const auto done = runner_of(scene)->run(1, {.render = false});
    EXPECT_TRUE(done) << of_strands << ": " << (done ? "" : done.error().message);
  }
}

TEST(FinScene, WithoutSimulation_FinsAreCarriedRigidly) {
  scene::Scene scene = small_mermaid();
  scene.simulation = {};
  const auto set = build_strand_set(scene);
  const auto path = HeadPath::create(scene, set->pivot);
  const auto runner = runner_of(scene);
  EXPECT_EQ(find_pass(runner->plan(), "cloth"), nullptr);
  ASSERT_TRUE(runner->run(20, {.render = false}));
  const strands::Mesh rigid = strands::transformed(set->fins, path->at(20));
  for (std::size_t i = 0; i < rigid.positions.size(); ++i)
    EXPECT_LT(glm::distance(runner->fins()->positions[i], rigid.positions[i]), 1e-6f) << i;
}

}  // namespace
}  // namespace cuticle::plan::fin_scene_test
