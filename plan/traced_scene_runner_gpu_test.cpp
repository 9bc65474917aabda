// The CPU's drawn strands and motion against those of a device.
#include "plan/traced_scene_runner.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "gpu/tests/test_device.h"
#include "plan/frame_runner_gpu.h"

namespace cuticle::plan::traced_scene_runner_gpu_test {
namespace {

scene::Scene scene_of(const std::string& changes) {
  const std::string text = R"({"schema_version": 1, "strand_count": 40, "strand_vertices": 12, "lights": [],
    "camera": {"resolution_px": [16, 16]}, "motion": {"bvh": "motion/head_turn.bvh", "joint": "Head"})" +
                           changes + "}";
  return scene::parse_scene(text, CUTICLE_SOURCE_DIR "/scenes", "test", catalogue()).value();
}

/// The largest distance of a drawn vertex in frame 3, metres.
float largest_distance(const scene::Scene& scene) {
  const auto on_device = FrameRunner::create(tests::device(), scene, silent_progress()).value();
  EXPECT_TRUE(on_device->run(3).ok());
  const strands::Groom expected = on_device->drawn_strands().value();
  const auto on_cpu = TracedSceneRunner::create(scene, silent_progress()).value();
  EXPECT_TRUE(on_cpu->advance_to(3, silent_progress()).ok());
  const strands::Groom drawn = on_cpu->drawn_strands().value();
  EXPECT_EQ(drawn.offsets, expected.offsets);
  float largest = 0;
  for (std::size_t v = 0; v < expected.vertex_count() && drawn.offsets == expected.offsets; ++v) {
    largest = std::max(largest, glm::distance(drawn.positions[v], expected.positions[v]));
    EXPECT_NEAR(drawn.radii[v], expected.radii[v], 1e-6f) << v;
  }
  return largest;
}

TEST(TracedSceneRunner, Strands_BetweenCarriedHairs_AreTheDevices) { EXPECT_LT(largest_distance(scene_of("")), 1e-5f); }

TEST(TracedSceneRunner, Strands_FollowHairsOnATurnedHead_AreTheDevices) {
  EXPECT_LT(
      largest_distance(scene_of(
          R"(, "groom": {"specification": "looks/locks.json", "follow_hairs": {"per_guide": 2, "reach_m": 0.004}})")),
      1e-5f);
}

TEST(TracedSceneRunner, Strands_SimulatedHair_AreTheDevices) {
  EXPECT_LT(
      largest_distance(scene_of(
          R"(, "simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}, "colliders": {}}}, "colliders": {"head": true})")),
      1e-4f);
}

TEST(TracedSceneRunner, Create_ACharacter_IsRefusedByWhatItNeeds) {
  scene::Scene scene = scene_of("");
  scene.character.emplace();
  const auto runner = TracedSceneRunner::create(scene, silent_progress());
  ASSERT_FALSE(runner.ok());
  EXPECT_NE(runner.error().message.find("Vulkan"), std::string::npos);
}

}  // namespace
}  // namespace cuticle::plan::traced_scene_runner_gpu_test
