// Colliders beside hair on a skin, which stand in the world: beside those that a head's hair meets, how deep hair goes
// in, and what they leave of its lengths.
#include "sim/chains/test_stability.h"
#include "sim/colliders/distance_field.h"
#include "sim/colliders/test_meshes.h"

namespace cuticle::sim::skin_contact_test {
namespace {

using namespace testing;

constexpr double k_duration = 1.0 / 30;

/// One of each kind, all in reach of ring(12).
struct Colliders {
  Sphere ball{{0.25, -0.02, 0.01}, 0.06};
  RoundedBox slab{
      {-0.25, 0, 0}, glm::dmat3(glm::rotate(glm::dmat4(1), 0.4, glm::dvec3(0, 1, 0))), {0.05, 0.02, 0.1}, 0.01};
  FieldPointer mesh = std::make_shared<const DistanceField>(*bake_distance_field(
      strands::transformed(ball_mesh(0.05, 16), glm::translate(glm::dmat4(1), glm::dvec3(0.01, -0.02, 0.25))), 0.01,
      "ball"));
  MovingCollider moving{Sphere{{0, 0, 0}, 0.05},
                        {{{0, {.position = {0.02, 0, -0.3}}}, {2, {.position = {0.02, 0, -0.2}}}}}};

  FrameInput beside(int frame, std::span<const glm::vec3> skinned) const {
    return {.duration = frame > 0 ? k_duration : 0,
            .colliders = {&ball, 1},
            .boxes = {&slab, 1},
            .fields = {&mesh, 1},
            .moving = {&moving, 1},
            .clock_begin = std::max(0, frame - 1) * k_duration,
            .clock_end = frame * k_duration,
            .skinned = skinned};
  }
  /// In the world, whatever a head does.
  std::vector<MovingCollider> in_the_world() const {
    return {{ball, {}, false}, {slab, {}, false}, {mesh, {}, false}, moving};
  }
  /// Under the deepest of the surfaces, at the time of a frame's end.
  double depth_at(const glm::dvec3& place, int frame) const {
    const glm::dvec3 moved(0.02, 0, -0.3 + 0.05 * std::min(2.0, frame * k_duration));
    const glm::dvec3 local = glm::abs(glm::transpose(slab.axes) * (place - slab.center)) - slab.half_size;
    const double outside = glm::length(glm::max(local, glm::dvec3(0))), most = std::max({local.x, local.y, local.z});
    return std::max({ball.radius - glm::distance(place, ball.center), slab.radius - (most > 0 ? outside : most),
                     0.05 - glm::distance(place, moved)});
  }
};

std::string settings_for(const std::string& solver) {
  return "damping=5" + std::string(solver == "rod" ? ",sag_free=false,fibre_radius=3e-4" : ",shape_stiffness=0");
}

class SkinContact : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, SkinContact, ::testing::Values("exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(SkinContact, SkinThatMovesAsAHead_MeetsWhatTheHeadsHairMeets) {
  const strands::Groom groom = ring(12);
  const Colliders colliders;
  const std::string precise = settings_for(GetParam()) + ",double_precision=true";
  const std::vector<MovingCollider> in_the_world = colliders.in_the_world();
  auto on_head = make_solver(GetParam(), groom, precise, gravity_and_colliders("friction=0.3")),
       on_skin = make_solver(GetParam(), groom, precise, gravity_and_colliders("friction=0.3")),
       free = make_solver(GetParam(), groom, precise, gravity());
  const auto shift = [](int frame) { return glm::dvec3(0.002 * frame, 0.004 * std::sin(0.3 * frame), -0.001 * frame); };
  for (int frame = 0; frame <= 5; ++frame) {  // rounding grows in what follows
    std::vector<glm::vec3> skinned = groom.positions;
    for (glm::vec3& place : skinned) place += glm::vec3(shift(frame));
    ASSERT_TRUE(on_skin->advance(colliders.beside(frame, skinned)).ok());
    FrameInput input{.duration = frame > 0 ? k_duration : 0, .skinned = skinned};
    ASSERT_TRUE(free->advance(input).ok());
    input = colliders.beside(frame, {});
    input.colliders = {}, input.boxes = {}, input.fields = {}, input.moving = in_the_world;
    input.head_begin = glm::translate(glm::dmat4(1), shift(std::max(0, frame - 1)));
    input.head_end = glm::translate(glm::dmat4(1), shift(frame));
    ASSERT_TRUE(on_head->advance(input).ok());
  }
  const State a = on_head->state().value(), b = on_skin->state().value();
  const double apart = worst_distance(a.positions, b.positions),
               moved = worst_distance(free->state()->positions, b.positions);
  std::printf("%s: beside colliders on a skin and on a head %.1e m apart, %.3f m from where it hangs without them\n",
              GetParam(), apart, moved);
  EXPECT_GT(moved, 0.01);
  EXPECT_LT(apart, 2e-7);
}

TEST_P(SkinContact, SkinThatDeforms_LeavesHairOutOfThemAtItsLength) {
  const strands::Groom groom = ring(12);
  const Colliders colliders;
  auto solver = make_solver(GetParam(), groom, settings_for(GetParam()), gravity_and_colliders("pearl_radius=0"));
  double deep = 0, stretched = 0;
  for (int frame = 0; frame < 90; ++frame) {
    const std::vector<glm::vec3> skinned = on_turning_roots(groom, 0.2 * frame / 30.0);
    ASSERT_TRUE(solver->advance(colliders.beside(frame, skinned)).ok());
    const State state = solver->state().value();
    EXPECT_EQ(state.guards_fired, 0u);
    stretched = std::max(stretched, worst_stretch(groom, state));
    if (frame < 30) continue;  // begun inside
    deep = std::max(
        deep, deepest_segment(groom, state, [&](const glm::dvec3& place) { return colliders.depth_at(place, frame); }));
  }
  std::printf("%s beside colliders on a skin that deforms: deepest segment %.1e m, stretch %.1e\n", GetParam(), deep,
              stretched);
  EXPECT_LT(deep, 1e-6);
  EXPECT_LT(stretched, 1e-5);
}

TEST_P(SkinContact, CollidersOverTheRootsAndFasterThanAStrand_KeepLengths) {
  const strands::Groom groom = ring(6);
  const Sphere over{{0, 0, 0}, 5};
  const RoundedBox box{{0, 0, 0}, glm::dmat3(1), {0.3, 0.3, 0.3}, 0};
  const MovingCollider fast{Sphere{{0, -0.1, 0}, 0.05},
                            {{{0, {.position = {-50, 0, 0}}}, {2, {.position = {50, 0, 0}}}}}};
  const FrameInput inputs[] = {{.colliders = {&over, 1}}, {.boxes = {&box, 1}}, {.moving = {&fast, 1}}};
  for (const FrameInput& kind : inputs) {
    auto solver = make_solver(GetParam(), groom, settings_for(GetParam()), gravity_and_colliders());
    double stretched = 0;
    for (int frame = 0; frame < 60; ++frame) {
      const std::vector<glm::vec3> skinned = on_turning_roots(groom, frame / 30.0);
      FrameInput input = kind;
      input.duration = k_duration;
      input.skinned = skinned;
      input.clock_begin = frame * k_duration;
      input.clock_end = (frame + 1) * k_duration;
      ASSERT_TRUE(solver->advance(input).ok());
      stretched = std::max(stretched, worst_stretch(groom, solver->state().value()));
    }
    EXPECT_TRUE(all_finite(solver->state().value()));
    EXPECT_EQ(solver->state()->guards_fired, 0u);
    EXPECT_LT(stretched, 1e-5) << &kind - inputs;
  }
}

}  // namespace
}  // namespace cuticle::sim::skin_contact_test
