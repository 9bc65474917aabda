// Cases in which strand solvers are known to break: lengths hold, nothing is lost, at any time step, in float and
// double.
#include <tbb/global_control.h>

#include <cuticle/sim/classic/test_strands.h>

#include <cuticle/sim/exact/guard.h>

namespace cuticle::sim {
namespace {

using namespace testing;

const std::vector<double> k_durations = {1e-3, 1.0 / 60, 0.1, 1, 100};

/// One substep a frame, whatever its duration.
std::string settings(const std::string& more) { return "inner_step=100,max_substeps=1," + more; }

/// Largest |ratio - 1| over its bound max(1e-5, 4 2^-24 L / l), and length of segments without rest length over 1e-7 L.
double worst_over_bound(const strands::Groom& rest, const State& state) {
  double worst = 0;
  for (std::size_t s = 0; s < rest.strand_count(); ++s) {
    double total = 0;
    const auto length = [&](std::span<const glm::vec3> places, std::size_t i) {
      return glm::distance(glm::dvec3(places[i - 1]), glm::dvec3(places[i]));
    };
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i) total += length(rest.positions, i);
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i) {
      const double own = length(rest.positions, i), now = length(state.positions, i);
      if (own > 1e-7 * total)
        worst = std::max(worst, std::abs(now / own - 1) / std::max(1e-5, 4 * std::pow(2.0, -24) * total / own));
      else if (total > 0)
        worst = std::max(worst, now / (1e-7 * total));
    }
  }
  return worst;
}

double fastest(const State& state) {
  double most = 0;
  for (const glm::vec3& velocity : state.velocities) most = std::max(most, double(glm::length(velocity)));
  return most;
}

strands::Groom one(const std::vector<double>& segments, const glm::dvec3& direction = {0.6, -0.8, 0}) {
  strands::Groom groom;
  add_straight(groom, {0, 0, 0}, direction, segments);
  return groom;
}
/// Segments that run to and fro along `direction`.
strands::Groom folded(const glm::dvec3& direction) {
  strands::Groom groom;
  for (int i = 0; i < 32; ++i) groom.positions.emplace_back(i % 2 ? direction * 0.01 : glm::dvec3(0));
  groom.radii.assign(32, strands::k_default_radius);
  groom.offsets = {0, 32};
  return groom;
}
std::vector<double> every_fourth_zero() {
  std::vector<double> segments = uniform_segments(31, 0.3);
  for (std::size_t i = 3; i < segments.size(); i += 4) segments[i] = 0;
  return segments;
}
std::vector<double> alternating(double ratio) {
  std::vector<double> segments;
  for (int i = 0; i < 31; ++i) segments.push_back(i % 2 ? 0.02 : 0.02 / ratio);
  return segments;
}

std::map<std::string, strands::Groom> shapes() {
  return {{"uniform", one(uniform_segments(31, 0.3))},
          {"growing 1:1000", one(growing_segments(31, 0.3, 1000))},
          {"shrinking 1000:1", one(growing_segments(31, 0.3, 1e-3))},
          {"alternating 1:1000", one(alternating(1000))},
          {"every fourth zero", one(every_fourth_zero())},
          {"folded, across", folded({1, 0, 0})},
          {"folded, along gravity", folded({0, -1, 0})},
          {"coincident", one(std::vector<double>(8, 0.0))},
          {"one vertex", one({})},
          {"one link", one({0.05})}};
}

/// How the head moves between frames: it stands, is thrown at 50 m/s to and fro in random directions, or jumps by up to
/// 100 m and back, told as a teleport or not.
enum class Disturbance { none, kicks, jumps, teleports };

/// Largest of worst_over_bound over the frames that end at the origin. Adds a message where anything is not finite.
double run(const strands::Groom& groom, const std::string& parameters, double duration, Disturbance disturbance,
           int frames) {
  auto solver = make_exact(groom, settings(parameters), gravity());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const double size = disturbance == Disturbance::kicks ? 50 * std::min(duration, 2.0) : 100;
  double worst = 0;
  glm::dvec3 place(0);
  for (int k = 0; k < frames; ++k) {
    const bool away = disturbance != Disturbance::none && k < frames * 2 / 3 && k % 2 == 0;
    const glm::dvec3 next = away ? glm::dvec3(unit(random), unit(random), unit(random)) * size : glm::dvec3(0);
    FrameInput input{.duration = duration,
                     .head_begin = glm::translate(glm::dmat4(1), place),
                     .head_end = glm::translate(glm::dmat4(1), next),
                     .colliders = {},
                     .teleport = disturbance == Disturbance::teleports};
    EXPECT_TRUE(solver->advance(input).ok());
    place = next;
    const State state = solver->state().value();
    EXPECT_TRUE(all_finite(state));
    EXPECT_EQ(state.guards_fired, 0u);
    if (next == glm::dvec3(0)) worst = std::max(worst, worst_over_bound(groom, state));
    if (::testing::Test::HasFailure()) break;
  }
  return worst;
}

constexpr const char* k_names[] = {"still", "50 m/s kicks", "100 m jumps", "teleports"};

class ExactStability : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Precisions, ExactStability, ::testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Double" : "Float"; });

TEST_P(ExactStability, EveryShapeStepAndDisturbance_KeepsItsLengths) {
  const std::string precision = GetParam() ? ",double_precision=true" : "";
  for (const auto& [name, groom] : shapes())
    for (int disturbance = 0; disturbance < 4; ++disturbance) {
      double worst = 0;
      for (double duration : k_durations)
        for (const std::string& pull : {k_free, std::string("clamped_vertices=1")}) {
          worst = std::max(worst, run(groom, pull + precision, duration, Disturbance(disturbance), 60));
          ASSERT_FALSE(HasFailure()) << name << ", " << k_names[disturbance] << ", step " << duration << ", " << pull;
        }
      std::printf("%-22s %-13s stretch over its bound, steps of 1e-3 .. 100 s: %.2f\n", name.c_str(),
                  k_names[disturbance], worst);
      EXPECT_LE(worst, 1) << name << k_names[disturbance];
    }
}

TEST_P(ExactStability, AfterTheDisturbance_EnergyFallsAgain) {
  const strands::Groom groom = one(uniform_segments(31, 0.3));
  for (double duration : {1.0 / 480, 1.0 / 60, 0.1}) {
    auto solver = make_exact(groom, settings(k_free + (GetParam() ? ",double_precision=true" : "")), gravity());
    FrameInput input{
        .duration = duration, .head_end = glm::translate(glm::dmat4(1), glm::dvec3(100, 0, 0)), .colliders = {}};
    ASSERT_TRUE(solver->advance(input).ok());
    input.head_begin = input.head_end;
    for (int k = 0; k < 30; ++k) ASSERT_TRUE(solver->advance(input).ok());
    const double early = fastest(*solver->state());
    for (int k = 0; k < 2000; ++k) ASSERT_TRUE(solver->advance(input).ok());
    const double late = fastest(*solver->state());
    std::printf("after a jump of 100 m, steps of %.4f s: fastest vertex %.3g m/s after 30 steps, %.3g m/s after 2030\n",
                duration, early, late);
    EXPECT_LT(late, early);
    EXPECT_LT(late, 20);
  }
}

TEST(ExactHard, FoldAlongGravity_Opens) {
  for (const glm::dvec3& direction : {glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)}) {
    auto solver = make_exact(folded(direction), "damping=2,shape_stiffness=0,clamped_vertices=1", gravity());
    const State state = run_still(*solver, 300, 1.0 / 60);
    EXPECT_LT(state.positions.back().y, -0.3f) << direction.x << direction.z;  // 31 links of 10 mm hang down
  }
}

TEST(ExactHard, LaneThatIsNotANumber_IsResetAndTouchesNoOther) {
  const exact::Settings parameters = exact::make_settings(settings_of("exact"), gravity());
  exact::Chains<float> good = exact::make_chains<float>(ring(16), parameters), broken = good;
  broken.state_at(0, 2, exact::state_row::velocity)[3] = NAN;
  Substep part;
  part.duration = 1.f / 480;
  exact::ChainClock clock;
  const auto steps = clock.steps<float>(parameters, {&part, 1});
  std::vector<float> scratch(std::size_t(good.longest + 2) * exact::scratch_row::count * exact::k_lanes, 0.f),
      other = scratch;
  const exact::ChainFrame<float> frame{steps.data(), 1, nullptr, 0, nullptr};
  exact::best_kernels().advance[1][0](good.block(0, scratch.data()), frame);
  exact::best_kernels().advance[1][0](broken.block(0, other.data()), frame);
  exact::Placing placing;
  placing.advance({&part, 1});
  exact::reset_broken_lanes(broken, 0, placing);
  for (std::size_t lane = 0; lane < std::size_t(exact::k_lanes); ++lane) {
    EXPECT_EQ(broken.strand_at(0, exact::strand_row::guarded)[lane] == float(exact::k_was_reset), lane == 3);
    for (std::size_t k = lane; k < broken.state.size(); k += exact::k_lanes) {
      EXPECT_TRUE(std::isfinite(broken.state[k]));
      if (lane != 3) {
        EXPECT_EQ(broken.state[k], good.state[k]);
      }
    }
  }
}

TEST(ExactHard, StrandWhoseSquaresOverflow_KeepsItsLengthsAndTouchesNoOther) {
  const strands::Groom good = ring(20);
  strands::Groom mixed;
  add_straight(mixed, {0, 0, 0}, {1, 0, 0}, std::vector<double>(16, 1e25));
  for (std::size_t s = 0; s < good.strand_count(); ++s) {
    mixed.positions.insert(mixed.positions.end(), good.strand(s).begin(), good.strand(s).end());
    mixed.offsets.push_back(static_cast<std::uint32_t>(mixed.positions.size()));
  }
  mixed.radii.assign(mixed.vertex_count(), strands::k_default_radius);
  const Sphere head{{0, 0, 0}, 0.095};
  auto alone = make_exact(good, "", gravity_and_colliders()), beside = make_exact(mixed, "", gravity_and_colliders());
  const State expected = run_frames(*alone, 20, {&head, 1}), state = run_frames(*beside, 20, {&head, 1});
  EXPECT_TRUE(all_finite(state));
  EXPECT_NEAR(glm::distance(glm::dvec3(state.positions[5]), glm::dvec3(state.positions[4])), 1e25, 1e20);
  for (std::size_t i = 0; i < good.vertex_count(); ++i) {
    ASSERT_EQ(state.positions[i + 17], expected.positions[i]);
    ASSERT_EQ(state.velocities[i + 17], expected.velocities[i]);
  }
}

TEST(ExactHard, TwoRunsAtOneAndManyThreads_AreBitIdentical) {
  const strands::Groom groom = ring(200);
  auto many = make_exact(groom, "", gravity()), single = make_exact(groom, "", gravity());
  const State a = run_frames(*many, 10);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const State b = run_frames(*single, 10);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.velocities, b.velocities);
}

TEST(ExactHard, ManyDifferentStrands_AreWhatEachIsAlone) {
  strands::Groom all;
  for (int s = 0; s < 40; ++s) add_straight(all, {0.01 * s, 0, 0}, {0, 0, 1}, uniform_segments(s % 7, 0.05 * (s % 5)));
  auto together = make_exact(all, "", gravity());
  const State state = run_frames(*together, 10);
  for (std::size_t s = 0; s < all.strand_count(); s += 6) {
    strands::Groom alone;
    alone.positions.assign(all.strand(s).begin(), all.strand(s).end());
    alone.radii.assign(alone.positions.size(), strands::k_default_radius);
    alone.offsets = {0, std::uint32_t(alone.positions.size())};
    auto solver = make_exact(alone, "", gravity());
    const State own = run_frames(*solver, 10);
    for (std::size_t i = 0; i < own.positions.size(); ++i)
      EXPECT_EQ(own.positions[i], state.positions[all.offsets[s] + i]) << s;
  }
}

TEST(ExactHard, HundredMetresFromOrigin_MovesAsAtTheOrigin) {
  const strands::Groom groom = ring(4);
  auto here = make_exact(groom, "", gravity()), far = make_exact(groom, "", gravity());
  const glm::dvec3 origin(100, -50, 70);
  State a = run_frames(*here, 30), b = run_frames(*far, 30, {}, origin);
  for (glm::vec3& place : b.positions) place -= glm::vec3(origin);
  EXPECT_LT(worst_distance(a.positions, b.positions), 4e-5);  // the world position itself rounds to 4e-6
}

TEST(ExactHard, FrameWithoutDuration_CarriesTheStateRigidly) {
  const strands::Groom groom = ring(8);
  auto solver = make_exact(groom, "", gravity());
  const State before = run_frames(*solver, 5);
  const glm::dmat4 head = frame_of(4).head_end, move = glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3));
  ASSERT_TRUE(solver->advance({.duration = 0, .head_begin = head, .head_end = move * head, .colliders = {}}).ok());
  const State after = solver->state().value();
  for (std::size_t i = 0; i < groom.vertex_count(); ++i)
    EXPECT_LT(glm::distance(after.positions[i], before.positions[i] + glm::vec3(1, 2, 3)), 2e-6f);
  EXPECT_EQ(after.velocities, before.velocities);
}

TEST(ExactHard, InputOutOfRange_IsRefusedAndTheStateKept) {
  const strands::Groom groom = ring(4);
  auto solver = make_exact(groom, "", gravity());
  const State before = run_frames(*solver, 3);
  FrameInput input;
  input.duration = 101;
  EXPECT_FALSE(solver->advance(input).ok());
  EXPECT_EQ(solver->state()->positions, before.positions);
}

TEST(ExactHard, EmptyGroom_HasAnEmptyState) {
  auto solver = make_exact(strands::Groom{}, "", gravity());
  EXPECT_TRUE(run_still(*solver, 2, 1.0 / 30).positions.empty());
}

TEST(Wind, ClassicSolver_RefusesItByName) {
  const auto made = (*find_effect("classic"))->create(ring(1), settings_of("classic"), {{"wind", settings_of("wind")}});
  ASSERT_FALSE(made.ok());
  EXPECT_THAT(made.error().message, ::testing::HasSubstr("wind"));
}

// Spheres.

double distance_to_segment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along),
               t = length2 > 0 ? glm::clamp(glm::dot(point - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(point, a + t * along);
}

struct BallCase {
  const char* name;
  glm::dvec3 centre;
  double radius;
  glm::dvec3 direction;
  double resting = 1e-3;  ///< m/s
};
const BallCase k_balls[] = {{"rooted on the head", {-0.05, -0.0866, 0}, 0.0999, {0.866, -0.5, 0}},
                            {"rooted on the head, aslant", {-0.05, -0.0866, 0}, 0.0999, {0.5, 0.33, 0.8}},
                            {"ball under the root", {0.02, -0.15, 0.01}, 0.1, {1, 0, 0}, 2e-3},
                            {"smaller ball under the root", {0.05, -0.2, 0}, 0.08, {1, 0, 0}},
                            {"ball under the root, centred", {0, -0.15, 0}, 0.1, {0, 1, 0}},
                            {"rope over a small ball", {0.1, -0.02, 0}, 0.02, {1, 0, 0}},
                            {"ball smaller than a link", {0.1, -0.02, 0}, 0.003, {1, 0, 0}},
                            {"starts inside", {0.15, 0, 0.01}, 0.05, {1, 0, 0}}};

struct Rest {
  double stretch = 0, depth = 0,
         tip_speed = 0;  ///< over the bound; deepest segment over the radius late; m/s rms of the sixth second
};
Rest rest_on(const BallCase& ball) {
  const strands::Groom groom = one(uniform_segments(31, 0.3), glm::normalize(ball.direction));
  auto solver =
      make_exact(groom, "damping=5,shape_stiffness=0,clamped_vertices=1", gravity_and_colliders("pearl_radius=0"));
  const Sphere sphere{ball.centre, ball.radius};
  Rest rest;
  double squares = 0;
  for (int k = 0; k < 360; ++k) {
    const State state = run_still(*solver, 1, 1.0 / 60, {&sphere, 1});
    rest.stretch = std::max(rest.stretch, worst_over_bound(groom, state));
    if (k < 300) continue;
    squares += std::pow(double(glm::length(state.velocities.back())), 2) / 60;
    for (std::size_t i = 2; i < state.positions.size(); ++i)
      rest.depth = std::max(
          rest.depth, 1 - distance_to_segment(ball.centre, state.positions[i - 1], state.positions[i]) / ball.radius);
  }
  rest.tip_speed = std::sqrt(squares);
  return rest;
}

TEST(ExactContact, StrandsOnBalls_KeepLengthStayOutsideAndComeToRest) {
  for (const BallCase& ball : k_balls) {
    const Rest rest = rest_on(ball);
    std::printf("%-30s stretch over bound %.2f, deepest segment %.1e r, tip after 5 s %.1e m/s\n", ball.name,
                rest.stretch, rest.depth, rest.tip_speed);
    EXPECT_LE(rest.stretch, 1) << ball.name;
    EXPECT_LT(rest.depth, 5e-7) << ball.name;
    EXPECT_LT(rest.tip_speed, ball.resting) << ball.name;
  }
}

TEST(ExactContact, SphereThatEngulfsTheRoot_LengthWins) {
  for (double radius : {0.15, 0.3, 5.0}) {
    const strands::Groom groom = ring(8);
    const Sphere ball{{0, 0, 0}, radius};
    auto solver = make_exact(groom, "", gravity_and_colliders());
    const State state = run_still(*solver, 60, 1.0 / 30, {&ball, 1});
    EXPECT_TRUE(all_finite(state)) << radius;
    EXPECT_LT(worst_stretch(groom, state), 1e-4) << radius;  // 0.1 m from the origin the state itself rounds to 4e-9 m
  }
}

TEST(ExactContact, Incline_SticksBelowAndSlidesAboveTheAngleOfFriction) {
  // A strand lies across a ball so large that it is a plane, falling off at 20 degrees; tan 20 deg = 0.364.
  const double slope = 20 * 3.14159265358979 / 180, radius = 100;
  const glm::dvec3 normal(std::sin(slope), std::cos(slope), 0);
  const Sphere plane{-radius * normal, radius};
  for (double friction : {0.25, 0.5}) {
    strands::Groom groom;
    add_straight(groom, 1e-5 * normal, {0, 0, 1}, uniform_segments(20, 0.2));
    auto solver = make_exact(groom, "damping=0,shape_stiffness=0,clamped_vertices=1",
                             gravity_and_colliders("pearl_radius=0,friction=" + std::to_string(friction)));
    const State state = run_still(*solver, 60, 1.0 / 60, {&plane, 1});
    const double moved = worst_distance(state.positions, groom.positions);
    std::printf("incline of 20 deg, friction %.2f: moved %.4f m in 1 s\n", friction, moved);
    if (friction > 0.364)
      EXPECT_LT(moved, 1e-3);
    else
      EXPECT_GT(moved, 0.05);
  }
}

}  // namespace
}  // namespace cuticle::sim
