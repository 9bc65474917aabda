// Fins against mechanics, their skin and their weights.
#include "sim/cloth/cloth.h"
#include "sim/classic/test_strands.h"

namespace cuticle::sim::cloth_test {
namespace {

using namespace testing;

/// A strip along x of `columns` x 3 quads of 20 mm; weight 0 at x = 0 to 1 at its end.
struct Fin {
  strands::Mesh mesh;
  std::vector<float> weights;
};
Fin strip(std::uint32_t columns, bool rigid_root = true) {
  Fin fin;
  for (std::uint32_t x = 0; x <= columns; ++x)
    for (std::uint32_t z = 0; z <= 3; ++z) {
      fin.mesh.positions.emplace_back(0.02f * float(x), 0, 0.02f * float(z));
      fin.weights.push_back(rigid_root ? float(x) / float(columns) : 1.f);
    }
  for (std::uint32_t i = 0; i < columns * 4; ++i) {
    if (i % 4 == 3) continue;
    fin.mesh.triangles.push_back({i, i + 4, i + 1});
    fin.mesh.triangles.push_back({i + 1, i + 4, i + 5});
  }
  return fin;
}
std::unique_ptr<Solver> cloth(const Fin& fin, const std::string& settings, const EffectBlocks& effects = gravity()) {
  return make_cloth(fin.mesh, fin.weights, registry::from_values<cloth::Cloth>(settings_of("cloth", settings)), effects)
      .value();
}
double worst_edge(const Fin& fin, const State& state) {
  double worst = 0;
  for (const auto& t : fin.mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[std::size_t(k)], b = t[std::size_t((k + 1) % 3)];
      const float rest = glm::distance(fin.mesh.positions[a], fin.mesh.positions[b]);
      worst = std::max(worst, std::abs(double(glm::distance(state.positions[a], state.positions[b]) / rest) - 1));
    }
  return worst;
}

TEST(Cloth, FreeSheet_FallsAsVerletDoes) {
  const Fin fin = strip(6, false);
  auto solver = cloth(fin, "damping=0,shape_stiffness=0");
  const State state = run_still(*solver, 30, 1.0 / 60);
  for (std::size_t i = 0; i < fin.weights.size(); ++i)
    EXPECT_LT(glm::distance(state.positions[i], fin.mesh.positions[i] - glm::vec3(0, 0.5 * 9.80665 * 0.25, 0)), 2e-5f);
}

TEST(Cloth, StripHeldAtItsRoot_HangsWithItsEdgesAtTheirLengths) {
  Fin fin = strip(8);
  for (float& weight : fin.weights) weight = weight > 0 ? 1.f : 0.f;
  auto solver = cloth(fin, "damping=4,shape_stiffness=0,iterations=16");
  const State state = run_still(*solver, 180, 1.0 / 30);
  const double worst = worst_edge(fin, state);
  std::printf("hanging strip: worst edge %.2e, tip at %.4f m\n", worst, double(state.positions.back().y));
  EXPECT_LT(worst, 5e-3);
  EXPECT_NEAR(double(state.positions.back().y), -0.16, 2e-3);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(state.positions[i], fin.mesh.positions[i]);
}

TEST(Cloth, PaintedWeight_IsTheShareOfTheSimulatedPlace) {
  Fin soft = strip(8), half = soft;
  for (std::size_t i = 0; i < soft.weights.size(); ++i) {
    soft.weights[i] = soft.weights[i] > 0 ? 1.f : 0.f;
    half.weights[i] = soft.weights[i] / 2;
  }
  auto whole = cloth(soft, "shape_stiffness=0"), blended = cloth(half, "shape_stiffness=0");
  const State a = run_frames(*whole, 6), b = run_frames(*blended, 6);
  const glm::dmat4 head = frame_of(5).head_end;
  for (std::size_t i = 0; i < soft.weights.size(); ++i) {
    const glm::vec3 skinned(head * glm::dvec4(soft.mesh.positions[i], 1));
    const glm::vec3 expected = soft.weights[i] > 0 ? (a.positions[i] + skinned) / 2.f : skinned;
    EXPECT_LT(glm::distance(b.positions[i], expected), 2e-6f) << i;
  }
  EXPECT_GT(glm::distance(a.positions.back(), b.positions.back()), 0.01f);
}

TEST(Cloth, SkinThatDeforms_TakesItsRootAlongExactly) {
  const Fin fin = strip(8);
  auto solver = cloth(fin, "");
  std::vector<glm::vec3> skin = fin.mesh.positions;
  for (int k = 0; k < 20; ++k) {
    for (glm::vec3& place : skin) place.y += 0.002f * (1 + place.z / 0.06f);
    FrameInput input;
    input.authored = skin;
    ASSERT_TRUE(solver->advance(input).ok());
  }
  const State state = solver->state().value();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(glm::distance(state.positions[i], skin[i]), 1e-6f) << i;
  EXPECT_LT(worst_edge(fin, state), 0.3);
}

TEST(Cloth, SkinThatMovedAndTurned_HasTheSheetAtRestOnIt) {
  const Fin fin = strip(8);
  auto solver = cloth(fin, "damping=4", {});
  const auto head_at = [](int k) {
    const double share = std::clamp(k / 30.0, 0.0, 1.0);
    return glm::rotate(glm::translate(glm::dmat4(1), share * glm::dvec3(0.1, 0.2, -0.3)), 0.7 * share,
                       glm::dvec3(0, 0.6, 0.8));
  };
  std::vector<glm::vec3> skin;
  for (int k = 1; k <= 900; ++k) {
    skin.clear();
    for (const glm::vec3& place : fin.mesh.positions)
      skin.emplace_back(head_at(k) * glm::dvec4(glm::dvec3(place) + glm::dvec3(0, 0.03, 0), 1));
    ASSERT_TRUE(solver->advance({.head_begin = head_at(k - 1), .head_end = head_at(k), .authored = skin}).ok());
  }
  const State state = solver->state().value();
  const double away = worst_distance(state.positions, skin);
  std::printf("sheet on a skin that moved and turned: %.1e m away\n", away);
  EXPECT_LT(away, 3e-5);
}

TEST(Cloth, SheetThatFallsOnABall_StaysOutside) {
  const Fin fin = strip(8, false);
  const Sphere ball{{0.08, -0.08, 0.03}, 0.05};
  auto solver = cloth(fin, "shape_stiffness=0", gravity_and_colliders("pearl_radius=0,fit_pearls=false"));
  double deepest = -1, highest = -1;
  for (int frame = 0; frame < 30; ++frame)
    for (const glm::vec3& place : run_still(*solver, 1, 1.0 / 60, {&ball, 1}).positions) {
      deepest = std::max(deepest, ball.radius - glm::distance(glm::dvec3(place), ball.center));
      if (frame == 12) highest = std::max(highest, double(place.y));
    }
  std::printf("deepest vertex in the ball: %.1e m\n", deepest);
  EXPECT_LT(deepest, 1e-6);
  EXPECT_GT(highest, -0.05);  // what falls freely is at -0.2
}

TEST(Cloth, MeshThatDoesNotFit_IsRefusedByName) {
  Fin fin = strip(2);
  const auto refused = [&] { return make_cloth(fin.mesh, fin.weights, cloth::Cloth{}, gravity()).error().message; };
  fin.mesh.positions[5].z = NAN;
  EXPECT_THAT(refused(), ::testing::HasSubstr("positions[5]: component 2"));
  fin.mesh.positions[5].z = 0;
  fin.weights[3] = 1.5f;
  EXPECT_THAT(refused(), ::testing::HasSubstr("weights[3]: 1.5"));
  fin.weights[3] = 0;
  fin.mesh.triangles[1][2] = 99;
  EXPECT_THAT(refused(), ::testing::HasSubstr("triangles[1]: vertex 99 of 12"));
  fin.weights.pop_back();
  EXPECT_THAT(refused(), ::testing::HasSubstr("weights: 11 for 12 vertices"));
}

}  // namespace
}  // namespace cuticle::sim::cloth_test
