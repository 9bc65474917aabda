// Distance fields of meshes against closed forms, and strands of the solvers of rigid links beside them.
#include <numbers>
#include <random>

#include "sim/chains/contact/field_contact.glslh"
#include "sim/chains/test_stability.h"
#include "sim/colliders/distance_field.h"
#include "sim/colliders/test_meshes.h"

namespace cuticle::sim::fields_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

DistanceField baked(const strands::Mesh& mesh, double spacing) {
  auto field = bake_distance_field(mesh, spacing, "mesh");
  EXPECT_TRUE(field) << (field ? "" : field.error().message);
  return std::move(field).value();
}
FieldPointer shared(const strands::Mesh& mesh, double spacing) {
  return std::make_shared<const DistanceField>(baked(mesh, spacing));
}

/// Distance and gradient as the solvers take them.
Surface<double> at(const DistanceField& field, const glm::dvec3& place) {
  const glm::dvec3 half = glm::dvec3(field.cells) * (field.spacing / 2);
  const LinkField<double> link{{field.centre, 0, {1, 0, 0}, half.x, {0, 1, 0}, half.y, {0, 0, 1}, half.z},
                               glm::dvec3(field.cells),
                               1 / field.spacing};
  return inside_field(link, field.values.data(), place);
}

double box_distance(const glm::dvec3& place, const glm::dvec3& half) {
  const glm::dvec3 off = glm::abs(place) - half;
  return glm::length(glm::max(off, 0.0)) + std::min(0.0, std::max({off.x, off.y, off.z}));
}

/// Largest error of distance and gradient (against central differences of the truth) where the truth is below `band`.
template <class Distance>
glm::dvec2 worst_near(const DistanceField& field, double size, double band, const Distance& distance,
                      int samples = 50000) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-size, size);
  glm::dvec2 worst(0);
  for (int k = 0; k < samples; ++k) {
    const glm::dvec3 place(unit(random), unit(random), unit(random));
    const double truth = distance(place);
    if (std::abs(truth) > band) continue;
    const Surface<double> here = at(field, place);
    glm::dvec3 slope(0);
    for (int c = 0; c < 3; ++c) {
      glm::dvec3 beside(0);
      beside[c] = 1e-6;
      slope[c] = (distance(place + beside) - distance(place - beside)) / 2e-6;
    }
    worst = glm::max(worst, {std::abs(-here.depth - truth), glm::distance(here.normal, slope)});
  }
  return worst;
}

TEST(DistanceFields, OfABall_ErrorFallsWithTheSquareOfTheSpacing) {
  const strands::Mesh ball = ball_mesh(0.1, 64);
  const auto distance = [](const glm::dvec3& place) { return glm::length(place) - 0.1; };
  const double bounds[] = {1.8e-3, 4.5e-4};
  for (int k = 0; k < 2; ++k) {
    const double spacing = 0.02 / (1 + k);
    const DistanceField field = baked(ball, spacing);
    const glm::dvec2 worst = worst_near(field, 0.13, spacing, distance);
    std::printf("ball of 0.1 m, spacing %.4f m: distance off by %.1e m (stated %.1e), gradient by %.3f\n", spacing,
                worst.x, field.error, worst.y);
    EXPECT_LT(worst.x, bounds[k]);
    EXPECT_LT(worst.y, 0.2 / (1 + k));
    EXPECT_LT(field.error, worst.x * 1.05);
    EXPECT_GT(field.error, worst.x / 2);
  }
}

TEST(DistanceFields, OfABox_IsRightBesideFacesAndRoundsEdgesByAShareOfACell) {
  const glm::dvec3 half(0.1, 0.06, 0.04);
  const DistanceField field = baked(box_mesh(half), 0.01);
  const auto distance = [&](const glm::dvec3& place) { return box_distance(place, half); };
  const double everywhere = worst_near(field, 0.12, 0.01, distance, 200000).x;
  double faces = 0;
  for (double x : {-0.07, 0.013, 0.06})
    for (double y : {-0.07, -0.064, -0.055, 0.057, 0.0613})
      faces = std::max(faces, std::abs(-at(field, {x, y, 0.01}).depth - distance({x, y, 0.01})));
  std::printf("box, spacing 0.01 m: off by %.1e m, beside faces %.1e m (stated %.1e)\n", everywhere, faces,
              field.error);
  EXPECT_LT(faces, 1e-8);
  EXPECT_LT(everywhere, 5e-3);
  EXPECT_LT(field.error, everywhere);
}

TEST(DistanceFields, BeyondTheGrid_GrowsWithTheDistance) {
  const DistanceField field = baked(ball_mesh(0.1, 32), 0.01);
  for (const glm::dvec3& place : {glm::dvec3(0.5, 0, 0), glm::dvec3(-0.3, 0.4, 1), glm::dvec3(0, 0, -20)}) {
    EXPECT_NEAR(-at(field, place).depth, glm::length(place) - 0.1, 0.01 + 0.1 * glm::length(place));
    EXPECT_GT(glm::dot(at(field, place).normal, glm::normalize(place)), 0.9);
  }
}

TEST(DistanceFields, OverlappingAndInsideOutShells_AreTheirUnion) {
  strands::Mesh two = box_mesh(glm::dvec3(0.05));
  strands::Mesh other =
      strands::transformed(box_mesh(glm::dvec3(0.05)), glm::translate(glm::dmat4(1), glm::dvec3(0.06, 0.013, -0.021)));
  for (auto& triangle : other.triangles) std::swap(triangle[0], triangle[1]);
  append(two, strands::transformed(box_mesh(glm::dvec3(0.05)),
                                   glm::translate(glm::dmat4(1), glm::dvec3(0.03, 0.031, 0.017))));
  append(two, strands::transformed(other, glm::translate(glm::dmat4(1), glm::dvec3(0.3, 0, 0))));
  const DistanceField field = baked(two, 0.0101);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-0.1, 0.5);
  const auto inside = [](const glm::dvec3& place, const glm::dvec3& centre) {
    return box_distance(place - centre, glm::dvec3(0.05));
  };
  for (int k = 0; k < 20000; ++k) {
    const glm::dvec3 place(unit(random), unit(random) / 2, unit(random) / 2);
    const double truth =
        std::min({inside(place, {0, 0, 0}), inside(place, {0.03, 0.031, 0.017}), inside(place, {0.36, 0.013, -0.021})});
    if (std::abs(truth) > 0.012) {
      ASSERT_EQ(at(field, place).depth > 0, truth < 0) << place.x << " " << place.y << " " << place.z;
    }
  }
}

TEST(DistanceFields, NodesOnFacesEdgesAndCorners_AreCountedOnce) {
  // Every line through nodes runs along faces, edges or corners of such a cube, or through its diagonals.
  const DistanceField field = baked(box_mesh(glm::dvec3(0.25)), 0.125);
  const glm::dvec3 half(0.25);
  for (int z = 0; z <= field.cells.z; ++z)
    for (int y = 0; y <= field.cells.y; ++y)
      for (int x = 0; x <= field.cells.x; ++x) {
        const glm::dvec3 node = field.centre + field.spacing * (glm::dvec3(x, y, z) - glm::dvec3(field.cells) / 2.0);
        EXPECT_NEAR(-at(field, node).depth, box_distance(node, half), 1e-7);
      }
}

TEST(DistanceFields, LinesInByAnEdgeAndOutByAFace_LeaveNoInsideBehind) {
  // Every line through nodes along a pyramid's diagonals comes in at an edge; half of them leave within a triangle.
  strands::Mesh pyramid;
  pyramid.positions = {
      {-0.25f, 0, 0}, {0.25f, -0.25f, -0.25f}, {0.25f, 0.25f, -0.25f}, {0.25f, -0.25f, 0.25f}, {0.25f, 0.25f, 0.25f}};
  pyramid.triangles = {{0, 2, 1}, {0, 4, 2}, {0, 3, 4}, {0, 1, 3}, {1, 2, 4}, {1, 4, 3}};
  strands::compute_normals(pyramid);
  const DistanceField field = baked(pyramid, 0.125);
  int inside = 0;
  for (std::size_t k = 0; k < field.values.size(); ++k) {
    const glm::ivec3 nodes = field.cells + 1,
                     node(int(k) % nodes.x, int(k) / nodes.x % nodes.y, int(k) / nodes.x / nodes.y);
    const glm::dvec3 place = field.centre + field.spacing * (glm::dvec3(node) - glm::dvec3(field.cells) / 2.0);
    const double room = std::min(0.25 - place.x, (place.x + 0.25) / 2 - std::max(std::abs(place.y), std::abs(place.z)));
    inside += room > 1e-6;
    if (std::abs(room) > 1e-6) {
      EXPECT_EQ(field.values[k]<0, room> 0) << place.x << " " << place.y << " " << place.z;
    }
  }
  EXPECT_EQ(inside, 11);
}

void expect_refused(const strands::Mesh& mesh, double spacing, std::string_view why) {
  const auto field = bake_distance_field(mesh, spacing, "m.obj");
  ASSERT_FALSE(field) << why;
  EXPECT_THAT(field.error().message, HasSubstr("m.obj: " + std::string(why)));
}
TEST(DistanceFields, WhatHasNoInside_IsRefused) {
  const strands::Mesh box = box_mesh(glm::dvec3(0.1));
  strands::Mesh open = box, bad = box, far = box, empty = box;
  open.triangles.pop_back();
  bad.positions[3].y = std::nanf("");
  far.triangles[2][1] = 99;
  empty.triangles.clear();
  expect_refused(open, 0.01, "3 open edges, allowed 0: the first from (");
  expect_refused(bad, 0.01, "vertex 3: component 1 is not finite");
  expect_refused(far, 0.01, "triangle 2: vertex 99, allowed 0 .. 7");
  expect_refused(empty, 0.01, "no triangle with area");
  expect_refused(box, 0, "spacing 0 m, allowed above 0 .. 1000");
  expect_refused(box, std::nan(""), "spacing nan m");
  expect_refused(box, 1, "spacing 1 m: no node of the grid lies inside");
  strands::Mesh sheet = box;
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  expect_refused(sheet, 0.01, "spacing 0.01 m: no node of the grid lies inside");
  expect_refused(box, 1e-4, "spacing 0.0001 m makes 2006 x 2006 x 2006 nodes, allowed 16777216");
}

const std::string k_limp = "damping=5,clamped_vertices=1";
std::string limp(std::string_view solver) {
  return k_limp + (solver == "rod" ? ",sag_free=false" : ",shape_stiffness=0");
}

State run_beside(Solver& solver, int frames, double duration, const FieldPointer& field) {
  for (int k = 0; k < frames; ++k)
    EXPECT_TRUE(solver.advance({.duration = duration, .colliders = {}, .fields = {&field, 1}}).ok());
  return solver.state().value();
}

/// A ball with bumps, hollow between them.
strands::Mesh bumpy_mesh() {
  return shaped_mesh(40, [](double polar, double around) {
    return 0.09 + 0.015 * std::sin(3 * around) * std::sin(polar) * std::cos(2 * polar);
  });
}

TEST(FieldContact, StrandsAcrossThem_KeepLengthAndStayOutside) {
  const auto shape = [](const strands::Mesh& mesh, const glm::dvec3& centre) {
    return shared(strands::transformed(mesh, glm::translate(glm::dmat4(1), centre)), 0.006);
  };
  const struct {
    const char* name;
    FieldPointer field;
  } cases[] = {{"ball", shape(ball_mesh(0.09, 40), {0.03, -0.11, 0.01})},
               {"box", shape(box_mesh({0.08, 0.04, 0.1}), {0.05, -0.07, 0})},
               {"bumpy ball", shape(bumpy_mesh(), {0.02, -0.12, 0.01})}};
  for (const char* solver : {"exact", "rod"})
    for (const auto& c : cases) {
      const auto depth_at = [&](const glm::dvec3& place) { return at(*c.field, place).depth; };
      const strands::Groom groom = one(uniform_segments(31, 0.3), {1, 0, 0});
      auto made = make_solver(solver, groom, limp(solver), gravity_and_colliders("pearl_radius=0"));
      double stretch = 0, segments = -1, vertices = -1, squares = 0;
      for (int k = 0; k < 240; ++k) {
        const State state = run_beside(*made, 1, 1.0 / 60, c.field);
        stretch = std::max(stretch, worst_over_bound(groom, state));
        segments = std::max(segments, deepest_segment(groom, state, depth_at));
        for (std::size_t i = 1; i < groom.vertex_count(); ++i)
          vertices = std::max(vertices, depth_at(glm::dvec3(state.positions[i])));
        if (k >= 180) squares += std::pow(double(glm::length(state.velocities.back())), 2) / 60;
      }
      std::printf("%-5s %-11s stretch over bound %.2f, deepest vertex %.1e m, segment %.1e m, tip after 3 s %.1e m/s\n",
                  solver, c.name, stretch, vertices, segments, std::sqrt(squares));
      EXPECT_LE(stretch, 1) << c.name;
      EXPECT_LT(vertices, 6e-7) << solver << c.name;
      EXPECT_LT(segments, 1.5e-5) << solver << c.name;
      EXPECT_LT(std::sqrt(squares), solver == std::string("rod") ? 0.1 : 3e-3) << c.name;
    }
}

TEST(FieldContact, BallAsAMesh_HoldsAStrandAsTheSphereDoes) {
  const strands::Groom groom = one(uniform_segments(31, 0.3), {1, 0, 0});
  const Sphere sphere{{0.05, -0.2, 0}, 0.08};
  const FieldPointer ball =
      shared(strands::transformed(ball_mesh(0.08, 64), glm::translate(glm::dmat4(1), sphere.center)), 0.008);
  const std::string rough = "friction=0.3";  // without, what lies across a ball's top slides off sooner or later
  auto by_sphere = make_exact(groom, limp("exact"), gravity_and_colliders(rough));
  auto by_field = make_exact(groom, limp("exact"), gravity_and_colliders(rough));
  const State a = run_still(*by_sphere, 300, 1.0 / 60, {&sphere, 1}), b = run_beside(*by_field, 300, 1.0 / 60, ball);
  std::printf("ball as sphere and as mesh: %.1e m apart at rest\n", worst_distance(a.positions, b.positions));
  EXPECT_LT(worst_distance(a.positions, b.positions), 2e-3);
}

TEST(FieldContact, MeshThatEngulfsTheRoot_LengthWins) {
  for (const char* solver : {"exact", "rod"})
    for (double half : {0.15, 0.3, 5.0}) {
      const strands::Groom groom = ring(8);
      auto made = make_solver(solver, groom, "", gravity_and_colliders());
      const State state = run_beside(*made, 60, 1.0 / 30, shared(box_mesh(glm::dvec3(half)), half / 8));
      EXPECT_TRUE(all_finite(state)) << solver << half;
      EXPECT_EQ(state.guards_fired, 0u);
      EXPECT_LT(worst_stretch(groom, state), 1e-4) << solver << half;
    }
}

TEST(FieldContact, TurningHead_TakesThemAlong) {
  const FieldPointer head = shared(ball_mesh(0.098, 32), 0.01);
  for (const char* solver : {"exact", "rod"}) {
    const strands::Groom groom = ring(16);
    auto made = make_solver(solver, groom, limp(solver), gravity_and_colliders("pearl_radius=0"));
    double depth = -1;
    for (int k = 0; k < 60; ++k) {
      FrameInput input = frame_of(k);
      input.fields = {&head, 1};
      ASSERT_TRUE(made->advance(input).ok());
      const glm::dmat4 to_rest = glm::inverse(input.head_end);
      depth = std::max(depth, deepest_segment(groom, *made->state(), [&](const glm::dvec3& place) {
                         return at(*head, glm::dvec3(to_rest * glm::dvec4(place, 1))).depth;
                       }));
    }
    std::printf("%s, turning head as a mesh: deepest segment %.1e m\n", solver, depth);
    EXPECT_LT(depth, 3e-6) << solver;
  }
}

TEST(FieldContact, Incline_SticksBelowAndSlidesAboveTheAngleOfFriction) {
  // A strand lies across a slab that falls off at 20 degrees; tan 20 deg = 0.364.
  const double slope = 20 * std::numbers::pi / 180;
  const glm::dvec3 normal(std::sin(slope), std::cos(slope), 0);
  const glm::dmat4 place = glm::rotate(glm::translate(glm::dmat4(1), -0.25 * normal), -slope, glm::dvec3(0, 0, 1));
  const FieldPointer slab = shared(strands::transformed(box_mesh({1, 0.25, 0.5}), place), 0.04);
  for (double friction : {0.25, 0.5}) {
    strands::Groom groom;
    add_straight(groom, 1e-4 * normal, {0, 0, 1}, uniform_segments(20, 0.2));
    auto solver =
        make_exact(groom, k_free, gravity_and_colliders("pearl_radius=0,friction=" + std::to_string(friction)));
    const double slid = worst_distance(run_beside(*solver, 60, 1.0 / 60, slab).positions, groom.positions);
    std::printf("incline of 20 deg, friction %.2f: moved %.4f m in 1 s\n", friction, slid);
    EXPECT_EQ(slid<1e-3, friction> 0.364) << slid;
    EXPECT_EQ(slid > 0.05, friction < 0.364) << slid;
  }
}

TEST(FieldContact, MeshOutOfReach_ChangesNoBit) {
  const strands::Groom groom = ring(4);
  const FieldPointer far =
      shared(strands::transformed(box_mesh(glm::dvec3(0.5)), glm::translate(glm::dmat4(1), {3, 0, 0})), 0.2);
  auto with = make_exact(groom, "", gravity_and_colliders()), without = make_exact(groom, "", gravity_and_colliders());
  EXPECT_EQ(run_beside(*with, 10, 1.0 / 30, far).positions, run_still(*without, 10, 1.0 / 30).positions);
}

TEST(FieldContact, Classic_RefusesThem) {
  const FieldPointer box = shared(box_mesh(glm::dvec3(0.1)), 0.05);
  const auto result =
      make_classic(ring(1), "", gravity_and_colliders())->advance({.colliders = {}, .fields = {&box, 1}});
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, HasSubstr("fields (mesh colliders): the solver meets spheres only"));
}

}  // namespace
}  // namespace cuticle::sim::fields_test
