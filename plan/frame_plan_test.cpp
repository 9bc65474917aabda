// What a frame leaves out of the plan: pure rules, the reach of colliders, and what a camera may see.
#include "plan/frame_plan.h"

#include <array>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>

#include "plan/collider_reach.h"
#include "plan/hair_in_view.h"

namespace cuticle::plan::frame_plan_test {
namespace {

constexpr std::string_view k_scene = R"({"schema_version": 1,
  "simulation": {"solver": {"classic": {}}, "effects": {"gravity": {}}}, "colliders": {"head": true},
  "lights": [{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}], "shadow": {"method": {"opacity_map": {}}}})";

Plan full_plan() {
  const auto scene = scene::parse_scene(k_scene, "/", "test", catalogue());
  registry::FrameShape shape;
  shape.lights = 1;
  shape.substeps = 8;
  return make_plan(*scene, shape);
}

FrameMeasures all_holds() {
  const registry::Fact yes{true, "yes"};
  return {yes, yes, yes, yes, yes, yes};
}

std::vector<std::string> running(const FramePlan& frame) {
  std::vector<std::string> names;
  for (const FramePass& pass : frame.passes)
    if (pass.runs) names.emplace_back(pass.pass->entry->name);
  return names;
}

TEST(FramePlan, AllFactsHold_RunsThePlan) {
  const Plan plan = full_plan();
  const FramePlan frame = plan_frame(plan, 3, all_holds());
  EXPECT_EQ(running(frame).size(), plan.passes.size());
  EXPECT_TRUE(frame.paints());
}

TEST(FramePlan, NothingChanged_PaintsNothing) {
  const Plan plan = full_plan();
  FrameMeasures measures = all_holds();
  measures.hair_changed = measures.surfaces_changed = measures.view_changed = {false, "as it was"};
  const FramePlan frame = plan_frame(plan, 3, measures);
  EXPECT_THAT(running(frame), testing::ElementsAre("classic", "colliders", "gravity"));
  EXPECT_FALSE(frame.paints());
}

TEST(FramePlan, CameraAloneMoves_KeepsStrands) {
  const Plan plan = full_plan();
  FrameMeasures measures = all_holds();
  measures.hair_changed = measures.surfaces_changed = {false, "as it was"};
  EXPECT_THAT(running(plan_frame(plan, 3, measures)),
              testing::ElementsAre("bake_tables", "classic", "colliders", "gravity", "strands_in_sight", "opacity_map",
                                   "surface_shadow", "head", "cull_strands", "lines", "resolve"));
}

TEST(FramePlan, HairOutOfView_DrawsSurfacesAlone) {
  const Plan plan = full_plan();
  FrameMeasures measures = all_holds();
  measures.hair_seen = {false, "behind"};
  const FramePlan frame = plan_frame(plan, 3, measures);
  EXPECT_THAT(running(frame),
              testing::ElementsAre("bake_tables", "classic", "colliders", "gravity", "head", "resolve"));
  for (const FramePass& pass : frame.passes) EXPECT_EQ(pass.reason == "behind", !pass.runs) << pass.pass->entry->name;
}

TEST(FramePlan, NoColliderInReach_LeavesCollisionsOut) {
  const Plan plan = full_plan();
  FrameMeasures measures = all_holds();
  measures.colliders_in_reach = {false, "far"};
  EXPECT_FALSE(plan_frame(plan, 3, measures).runs("colliders"));
  EXPECT_TRUE(plan_frame(plan, 3, measures).runs("classic"));
}

TEST(FramePlan, HairAsleep_SimulatesNothing) {
  const Plan plan = full_plan();
  FrameMeasures measures = all_holds();
  measures.hair_awake = {false, "asleep"};
  const FramePlan frame = plan_frame(plan, 3, measures);
  for (const char* pass : {"classic", "gravity", "colliders"}) EXPECT_FALSE(frame.runs(pass)) << pass;
}

/// Straight hairs of 0.1 m along +y, one a centimetre further along x than the one before.
strands::Groom row_of_hairs(int count) {
  strands::Groom groom;
  for (int s = 0; s < count; ++s) {
    for (int v = 0; v < 3; ++v) groom.positions.emplace_back(0.01f * float(s), 0.05f * float(v), 0);
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  return groom;
}

/// First and last of the hairs that a sphere reaches, and how many they are; {-1, -1, 0}: none.
std::array<int, 3> reached_by(const Sphere& sphere, const glm::dmat4& head_end) {
  const strands::Groom groom = row_of_hairs(130);
  const std::vector<ReachBall> balls = reach_balls(groom, 0.001);
  const sim::MovingCollider moving{.shape = sphere, .motion = {}, .on_head = false};
  const auto reached = hairs_in_reach(balls, {.head_end = head_end, .moving = {&moving, 1}}, 4);
  std::array<int, 3> found{-1, -1, 0};
  for (int s = 0; s < 130; ++s) {
    if (!reached[std::size_t(s)]) continue;
    if (found[0] < 0) found[0] = s;
    found[1] = s;
    ++found[2];
  }
  return found;
}

// A hair reaches 15 cm and a pearl of a millimetre from its root; the sphere has a centimetre.
TEST(ColliderReach, SphereBesideSomeHairs_ReachesTheseAlone) {
  EXPECT_EQ(reached_by({{0, 0.05, 0}, 0.01}, glm::dmat4(1)), (std::array{0, 15, 16}));
  EXPECT_EQ(reached_by({{0.5, 0, 0}, 0.01}, glm::dmat4(1)), (std::array{34, 66, 33}));
  EXPECT_EQ(reached_by({{0, 9, 0}, 0.01}, glm::dmat4(1)), (std::array{-1, -1, 0}));
}

TEST(ColliderReach, HeadThatMovesToTheSphere_ReachesIt) {
  EXPECT_EQ(reached_by({{-1, 0.05, 0}, 0.01}, glm::dmat4(1))[2], 0);
  EXPECT_EQ(reached_by({{-1, 0.05, 0}, 0.01}, glm::translate(glm::dmat4(1), {-1, 0, 0}))[0], 0);
}

TEST(ColliderReach, StrandOutsideItsBall_IsSeen) {
  const strands::Groom groom = row_of_hairs(70);
  const std::vector<ReachBall> balls = reach_balls(groom, 0);
  std::vector<glm::vec4> places;
  for (const glm::vec3& position : groom.positions) places.emplace_back(position, 1);
  EXPECT_TRUE(within_reach(balls, groom, places, glm::dmat4(1)));
  places.back().y += 1;
  EXPECT_FALSE(within_reach(balls, groom, places, glm::dmat4(1)));
}

TEST(HairInView, BoxBesideBehindAndAroundTheCamera) {
  const strands::Bounds box{glm::vec3(-0.1f), glm::vec3(0.1f)};
  const auto from = [&](const glm::dvec3& position, const glm::dvec3& target) {
    return may_be_seen(box, glm::dmat4(1), {.position = position, .target = target});
  };
  EXPECT_TRUE(from({0, 0, 1}, {0, 0, 0}));
  EXPECT_TRUE(from({0, 0, 0.05}, {0, 0, 1}));  // inside
  EXPECT_TRUE(from({0, 0, 1}, {0.3, 0, 0}));   // at the border
  EXPECT_FALSE(from({0, 0, 1}, {0, 0, 2}));    // behind
  EXPECT_FALSE(from({0, 0, 1}, {1, 0, 0}));    // beside
}

}  // namespace
}  // namespace cuticle::plan::frame_plan_test
