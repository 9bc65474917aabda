// scenes/fox.json and fox_fur.json with Fox.glb of CUTICLE_TEST_DATA: over the Run clip the fur, carried or simulated,
// begins on the skin, and the passes are those of the plan.
#include "plan/frame_runner_gpu.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "gpu/tests/test_device.h"
#include "plan/strand_set.h"
#include "strands/binding/binding.h"
#include "strands/binding/nearest_triangle.h"
#include "strands/statistics.h"

namespace cuticle::plan::fox_scene_test {
namespace {

scene::Scene small_fox(bool dual_quaternions) {
  auto scene = scene::load_scene(CUTICLE_SOURCE_DIR "/scenes/fox.json", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  scene->groom.specification->strands.share = 0.01;
  scene->material.lut_size = 16;
  scene->camera.camera.resolution = {64, 48};
  scene->character->dual_quaternions = dual_quaternions;
  return std::move(*scene);
}

/// The skin of a frame, by the CPU.
strands::Mesh skin_at(const strands::Character& character, const scene::Scene& scene, int frame) {
  const int clip = strands::find_clip(character, scene.character->clip).value();
  const double time = strands::looped(character.clips[std::size_t(clip)], frame / scene.frames_per_second);
  strands::Mesh moved = character.mesh;
  strands::skin(
      character.mesh, character.influences, strands::joint_motions(strands::joint_matrices(character, clip, time)),
      scene.character->dual_quaternions ? strands::Skinning::dual_quaternion : strands::Skinning::linear_blend, moved);
  return moved;
}

/// How often a closed mesh goes round a point: 1 inside, 0 outside (van Oosterom and Strackee 1983).
double winding(const strands::Mesh& mesh, const glm::dvec3& point) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 a = glm::dvec3(mesh.positions[t[0]]) - point, b = glm::dvec3(mesh.positions[t[1]]) - point,
                     c = glm::dvec3(mesh.positions[t[2]]) - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

TEST(FoxFur, AtRest_LiesOverTheSkin) {
  const auto set = build_strand_set(small_fox(false));
  ASSERT_TRUE(set) << set.error().message;
  int inside = 0;
  for (std::size_t s = 0; s < set->control.strand_count(); ++s)
    inside += winding(set->character->mesh, glm::dvec3(set->control.strand(s).back())) > 0.5;
  EXPECT_GT(set->control.strand_count(), 1400u);
  EXPECT_EQ(inside, 0);
}

class FoxScene : public testing::TestWithParam<bool> {};

TEST_P(FoxScene, RootsOfDrawnFur_NeverLeaveTheSkin) {
  const scene::Scene scene = small_fox(GetParam());
  auto runner = FrameRunner::create(tests::device(), scene, silent_progress());
  ASSERT_TRUE(runner) << runner.error().message;
  const auto set = build_strand_set(scene);
  ASSERT_TRUE(set);
  double largest = 0;
  for (int frame = 0; frame < 35; frame += 5) {  // carried fur has no past: each frame stands by itself
    const auto drawn = (*runner)->run(frame);
    ASSERT_TRUE(drawn) << drawn.error().message;
    const auto fur = (*runner)->drawn_strands();
    ASSERT_TRUE(fur);
    const strands::Mesh skin = skin_at(*set->character, scene, frame);
    const strands::NearestTriangle nearest(skin);
    strands::Groom points;
    points.positions = skin.positions;
    const strands::Bounds bounds = strands::bounds(points);
    const double diagonal = double(glm::distance(bounds.lower, bounds.upper));
    for (std::size_t s = 0; s < fur->strand_count(); ++s)
      largest = std::max(largest, nearest.at(glm::dvec3(fur->strand(s)[0])).distance / diagonal);
  }
  EXPECT_LT(largest, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Methods, FoxScene, testing::Bool());

TEST(FoxScene, PassesOfAFrame_AreThoseOfThePlan) {
  auto runner = FrameRunner::create(tests::device(), small_fox(true), silent_progress());
  ASSERT_TRUE(runner) << runner.error().message;
  const auto drawn = (*runner)->run(7);
  ASSERT_TRUE(drawn) << drawn.error().message;
  for (const char* name : {"skin", "carry", "smooth_strands", "interpolate_strands", "head", "lines"}) {
    const PlannedPass* planned = find_pass((*runner)->plan(), name);
    const auto ran = std::ranges::find(drawn->cost.passes, name, &gpu::PassCost::name);
    ASSERT_TRUE(planned && ran != drawn->cost.passes.end()) << name;
    EXPECT_EQ(ran->dispatches + ran->draws, planned->dispatches + planned->draws) << name;
  }
  EXPECT_EQ(find_pass((*runner)->plan(), "classic"), nullptr);
}

scene::Scene small_simulated_fox() {
  auto scene = scene::load_scene(CUTICLE_SOURCE_DIR "/scenes/fox_fur.json", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  scene->strand_count = 500;
  scene->material.lut_size = 16;
  scene->camera.camera.resolution = {64, 48};
  return std::move(*scene);
}

/// The same by a solver of rigid links.
scene::Scene small_fox_by(const char* solver) {
  scene::Scene scene = small_simulated_fox();
  if (solver == scene.simulation.solver->name) return scene;
  scene.simulation.solver->name = solver;
  scene.simulation.solver->values =
      registry::parse_assignments((*sim::find_effect(solver))->entry.parameters,
                                  solver == std::string("exact") ? "damping=4,shape_stiffness=60,shape_tip=0.25" : "")
          .value();
  return scene;
}

void add_effect(const char* name, scene::Scene& scene) {
  scene.simulation.effects[name] = registry::default_values((*sim::find_effect(name))->entry.parameters);
}

class SimulatedFur : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, SimulatedFur, testing::Values("classic", "exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(SimulatedFur, InTheRun_StaysRootedOnTheSkinAtItsLength) {
  const scene::Scene scene = small_fox_by(GetParam());
  auto runner = FrameRunner::create(tests::device(), scene, silent_progress());
  ASSERT_TRUE(runner) << runner.error().message;
  const auto set = build_strand_set(scene);
  ASSERT_TRUE(set);
  const strands::Groom& rest = (*runner)->control_groom();
  const strands::RestOnMesh on_mesh = strands::rest_on_mesh(rest, set->character->mesh, set->control_roots);
  double off_skin = 0, lag = 0, stretched = 0;
  std::vector<glm::vec3> carried(rest.vertex_count());
  for (int frame = 0; frame < 10; ++frame) {
    const auto run = (*runner)->run(frame, {.render = false, .read_state = true});
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_EQ(run->state.guards_fired, 0u);
    strands::carry(on_mesh, skin_at(*set->character, scene, frame), carried);
    for (std::size_t s = 0; s < rest.strand_count(); ++s) {
      const std::size_t root = rest.offsets[s], tip = rest.offsets[s + 1] - 1;
      off_skin = std::max(off_skin, double(glm::distance(run->state.positions[root], carried[root])));
      lag = std::max(lag, double(glm::distance(run->state.positions[tip], carried[tip])));
    }
    for (float ratio : sim::stretch(rest, run->state.positions))
      stretched = std::max(stretched, std::abs(double(ratio) - 1));
  }
  std::printf("%s fur in the run: roots %.1e m off the skin, stretch %.1e, tips up to %.1e m behind\n", GetParam(),
              off_skin, stretched, lag);
  EXPECT_LT(off_skin, 2e-6);
  EXPECT_LT(stretched, GetParam() == std::string("classic") ? 0.02 : 1e-4);
  EXPECT_GT(lag, 5e-3);
  EXPECT_LT(lag, 0.13);  // of hair up to 0.09 m long, on the feet
}

/// Hair of a fox that stands, after ten frames.
sim::State settled(const scene::Scene& scene) {
  auto runner = FrameRunner::create(tests::device(), scene, silent_progress());
  EXPECT_TRUE(runner) << runner.error().message;
  for (int frame = 0; frame < 9; ++frame) EXPECT_TRUE((*runner)->run(frame, {.render = false}));
  return (*runner)->run(9, {.render = false, .read_state = true})->state;
}

TEST_P(SimulatedFur, BesideABall_StaysOutOfIt) {
  scene::Scene scene = small_fox_by(GetParam());
  scene.character->clip.clear();
  scene.simulation.effects["colliders"] =
      registry::parse_assignments((*sim::find_effect("colliders"))->entry.parameters, "pearl_radius=0").value();
  const sim::State free = settled(scene);
  const strands::Groom rest = build_strand_set(scene)->control;
  const auto tip = std::size_t(std::ranges::max_element(free.positions, {}, &glm::vec3::y) - free.positions.begin());
  scene.colliders = {{glm::dvec3(free.positions[tip]), 0.02}};
  const sim::State beside = settled(scene);
  double deepest = 0, moved = 0;
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s] + 2; i < rest.offsets[s + 1]; ++i) {
      const double depth = 0.02 - glm::distance(glm::dvec3(beside.positions[i]), scene.colliders[0].center);
      deepest = std::max(deepest, depth);
      moved = std::max(moved, double(glm::distance(beside.positions[i], free.positions[i])));
    }
  std::printf("%s fur beside a ball: deepest vertex %.1e m, moved by %.3f m\n", GetParam(), deepest, moved);
  EXPECT_GT(moved, 0.01);
  EXPECT_LT(deepest, 1e-5);
}

TEST(FoxFur, Simulated_RunsSkinThenSimulationAsPlanned) {
  auto runner = FrameRunner::create(tests::device(), small_simulated_fox(), silent_progress());
  ASSERT_TRUE(runner) << runner.error().message;
  const auto drawn = (*runner)->run(0);
  ASSERT_TRUE(drawn) << drawn.error().message;
  const Plan& plan = (*runner)->plan();
  for (const char* name : {"skin", "carry", "classic", "smooth_strands", "head"}) {
    const PlannedPass* planned = find_pass(plan, name);
    const auto ran = std::ranges::find(drawn->cost.passes, name, &gpu::PassCost::name);
    ASSERT_TRUE(planned && ran != drawn->cost.passes.end()) << name;
    EXPECT_EQ(ran->dispatches + ran->draws, planned->dispatches + planned->draws) << name;
  }
  EXPECT_LT(find_pass(plan, "carry"), find_pass(plan, "classic"));
}

TEST(FoxFur, EffectThatHairOnASkinCannotHave_IsRefused) {
  scene::Scene scene = small_fox_by("exact");
  add_effect("control", scene);
  const auto made = FrameRunner::create(tests::device(), scene, silent_progress());
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("'control'"), std::string::npos) << made.error().message;
}

TEST(FoxFur, ClumpedInTheRun_StaysAtItsLengthAndDiffers) {
  std::vector<glm::vec3> places[2];
  for (const bool clumped : {false, true}) {
    scene::Scene scene = small_fox_by("exact");
    if (clumped)
      for (const char* effect : {"clumping", "strand_interaction"}) add_effect(effect, scene);
    auto runner = FrameRunner::create(tests::device(), scene, silent_progress());
    ASSERT_TRUE(runner) << runner.error().message;
    for (int frame = 0; frame < 6; ++frame) {
      const auto run = (*runner)->run(frame, {.render = frame == 5, .read_state = true});
      ASSERT_TRUE(run) << run.error().message;
      EXPECT_EQ(run->state.guards_fired + run->state.left_out, 0u);
      for (const float ratio : sim::stretch((*runner)->control_groom(), run->state.positions))
        ASSERT_NEAR(double(ratio), 1, 1e-3);
      places[clumped] = run->state.positions;
    }
  }
  double most = 0;
  for (std::size_t i = 0; i < places[0].size(); ++i)
    most = std::max(most, double(glm::distance(places[0][i], places[1][i])));
  std::printf("fur of the fox in a run, with clumps and strand against strand: up to %.4f m elsewhere\n", most);
  EXPECT_GT(most, 1e-3);
}

}  // namespace
}  // namespace cuticle::plan::fox_scene_test
