// Whether hair that lies on a collider comes to rest there.
#include "sim/chains/test_stability.h"
#include "sim/colliders/distance_field.h"
#include "sim/colliders/test_meshes.h"

namespace cuticle::sim::rest_test {
namespace {

using namespace testing;

struct Collider {
  const char* name;
  std::vector<Sphere> spheres;
  std::vector<RoundedBox> boxes;
  std::vector<FieldPointer> fields;
  double exact = 1e-3, rod = 1e-3;  ///< m/s that the tip of either is below
};

FieldPointer ball_field(const glm::dvec3& centre, double radius) {
  const strands::Mesh mesh = strands::transformed(ball_mesh(radius, 40), glm::translate(glm::dmat4(1), centre));
  return std::make_shared<const DistanceField>(bake_distance_field(mesh, 0.008, "ball").value());
}

RoundedBox capsule_at(double x, double y, double radius) { return make_capsule({x, y, -0.2}, {x, y, 0.2}, radius); }

std::vector<Collider> colliders() {
  const glm::dmat3 edge(glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(0, 0, 1)));
  const glm::dmat3 aslant(
      glm::rotate(glm::rotate(glm::dmat4(1), 0.785, glm::dvec3(0, 0, 1)), 0.3, glm::dvec3(1, 0, 0)));
  return {{"ball under the root, centred", {{{0, -0.15, 0}, 0.1}}, {}, {}},
          {"ball under the root, off-centre", {{{0.02, -0.15, 0.01}, 0.1}}, {}, {}},
          {"ball at the side", {{{0.05, -0.2, 0}, 0.08}}, {}, {}},
          {"capsule of 5 cm", {}, {capsule_at(0.02, -0.06, 0.05)}, {}},
          {"capsule of 1 cm", {}, {capsule_at(0.02, -0.06, 0.01)}, {}},
          {"capsule of 2 mm", {}, {capsule_at(0.008, -0.03, 0.002)}, {}},
          {"box", {}, {{{0.04, -0.06, 0}, glm::dmat3(1), {0.06, 0.03, 0.1}, 0}}, {}, 6e-3},
          {"edge of a box", {}, {{{0.02, -0.08, 0}, edge, {0.04, 0.04, 0.2}, 0}}, {}, 2e-2},
          {"edge aslant", {}, {{{0.03, -0.08, 0}, aslant, {0.04, 0.04, 0.2}, 0}}, {}, 0.1, 0.3},
          {"ball as a mesh", {}, {}, {ball_field({0.03, -0.11, 0.01}, 0.09)}}};
}

/// Of the tip, m/s, rms from the fifth to the sixth second.
double tremble(std::string_view solver, const Collider& c, int links, const std::string& friction) {
  const strands::Groom groom = one(uniform_segments(links, 0.3), {1, 0, 0});
  const std::string limp =
      std::string("damping=5,clamped_vertices=1,") + (solver == "rod" ? "sag_free=false" : "shape_stiffness=0");
  auto made = make_solver(solver, groom, limp, gravity_and_colliders("pearl_radius=0,friction=" + friction));
  double squares = 0;
  for (int k = 0; k < 360; ++k) {
    EXPECT_TRUE(
        made->advance({.duration = 1.0 / 60, .colliders = c.spheres, .boxes = c.boxes, .fields = c.fields}).ok());
    if (k >= 300) squares += std::pow(double(glm::length(made->state()->velocities.back())), 2) / 60;
  }
  return std::sqrt(squares);
}

void expect_rest(const char* solver, double Collider::*resting) {
  std::printf("tip, m/s; 16 links, friction 0, 0.3, 1; 32 links, the same\n");
  for (const Collider& c : colliders()) {
    std::printf("%-5s %-32s", solver, c.name);
    for (int links : {16, 32})
      for (const char* friction : {"0", "0.3", "1"}) {
        const double speed = tremble(solver, c, links, friction);
        std::printf("  %.1e", speed);
        EXPECT_LT(speed, c.*resting) << c.name << ", " << links << " links, friction " << friction;
      }
    std::printf("\n");
  }
}

TEST(RestingContact, OfExact_BringsTheTipToRest) { expect_rest("exact", &Collider::exact); }
TEST(RestingContact, OfRod_BringsTheTipToRest) { expect_rest("rod", &Collider::rod); }

}  // namespace
}  // namespace cuticle::sim::rest_test
