// Rods that bend under their own weight: the cantilever, arcs at the weight where they leave their plane, the drape.
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "study/mechanics/experiment.h"
#include "study/mechanics/reference/curves.h"
#include "study/mechanics/strands.h"

namespace cuticle::study::mechanics {
namespace {

Curve curve_of(const std::string& name, const std::vector<ReferencePoint>& points) {
  Curve curve{name, {}, {}};
  for (const ReferencePoint& point : points) {
    curve.x.push_back(point.at);
    curve.y.push_back(point.value);
  }
  return curve;
}
std::vector<double> places_of(const std::vector<ReferencePoint>& points) { return curve_of("", points).x; }

const ReferencePoint& point_at(const std::vector<ReferencePoint>& points, double at) {
  for (const ReferencePoint& point : points)
    if (std::abs(point.at - at) <= 1e-9 * std::abs(at)) return point;
  return points.back();
}

double speed_over_fall(const sim::State& state, double length) { return fastest(state) / std::sqrt(k_g * length); }

Result<Outcome> cantilever_run(int links, double gamma) {
  const double length = length_of(gamma);
  CUTICLE_ASSIGN(const auto solver, solver_of("rod", straight(links, length, {1, 0, 0}),
                                              std::string(k_one_step) + "sag_free=false,damping=5"));
  CUTICLE_ASSIGN(const sim::State state, run_still(*solver, 20, 0.1));
  const glm::dvec3 tip = state.positions.back();
  return Outcome{point_at(cantilever_curve(), gamma).value, -tip.y / tip.x, speed_over_fall(state, length)};
}

Result<Outcome> cantilever_at_rest(int links, double gamma) {
  const double length = length_of(gamma);
  CUTICLE_ASSIGN(const AtRest rest, rest_of(straight(links, length, {1, 0, 0}), "sag_free=false"));
  const glm::dvec3 tip = rest.positions.back();
  return Outcome{point_at(cantilever_curve(), gamma).value, -tip.y / tip.x, rest.residual};
}

/// A planar arc of natural curvature K / L, its first link half a link on from the clamp, in the plane z = 0. `clamp`:
/// angle of its tangent from the downward vertical.
strands::Groom arc(int links, double length, double natural, double clamp) {
  std::vector<glm::dvec3> places = {glm::dvec3(0)};
  for (int i = 0; i < links; ++i) {
    const double angle = clamp + natural * (i + 0.5) / links;
    places.push_back(places.back() + glm::dvec3(std::sin(angle), -std::cos(angle), 0) * (length / links));
  }
  return groom_of(places);
}

struct Lean {
  double sideways = 0, residual = 0;  ///< the tip's, over the length
};
/// Where a millionth of its weight across its plane takes the arc's tip. The clamp of a rod is the direction of its
/// first link at rest: half a hinge, which the arc's natural shape has there, is left to the first hinge.
Result<Lean> leant(int links, double natural, double clamp, double gamma) {
  const double length = length_of(gamma);
  CUTICLE_ASSIGN(const auto solver, solver_of("rod", arc(links, length, natural, clamp),
                                              std::string(k_one_step) +
                                                  "sag_free=false,damping=4,shear_modulus=1.3e9,double_precision=true",
                                              {.gravity = fmt::format("acceleration=0/-{}/{}", k_g, k_g * 1e-6)}));
  CUTICLE_ASSIGN(const sim::State state, run_still(*solver, 60, 1.0 / 30));
  return Lean{double(state.positions.back().z) / length, speed_over_fall(state, length)};
}

/// The weight at which the arc gives way without end, from three beside it (`side`: -1 lighter, 1 heavier): 1 / lean is
/// nearly linear there.
Result<Outcome> buckling_run(int links, double natural, double clamp, double truth, double side) {
  std::array<double, 3> at{}, stiff{};
  double residual = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = 1 + side * (0.03 + 0.03 * double(k));
    CUTICLE_ASSIGN(const Lean lean, leant(links, natural, clamp, at[k] * truth));
    stiff[k] = at[k] / lean.sideways;
    residual = std::max(residual, lean.residual);
  }
  double zero = 0;  // the parabola through the three, as weight by stiffness, at stiffness 0
  for (std::size_t i = 0; i < 3; ++i) {
    double share = at[i];
    for (std::size_t j = 0; j < 3; ++j)
      if (j != i) share *= stiff[j] / (stiff[j] - stiff[i]);
    zero += share;
  }
  return Outcome{truth, zero * truth, residual};
}

Contestant buckling(int links, const std::vector<ReferencePoint>& curve, double clamp, double side, bool quick) {
  return {.solver = "rod",
          .knobs = {{"links", std::to_string(links)}},
          .at = some_of(places_of(curve), quick),
          .run = [=, &curve](double natural) {
            return buckling_run(links, natural, clamp, point_at(curve, natural).value, side);
          }};
}

constexpr double k_cylinder = 0.1;  ///< its radius over the length: as make_curves.py

/// A tress of 8 strands side by side, clamped on top of the cylinder; the tip is their mean.
strands::Groom tress(int links, double length) {
  strands::Groom groom;
  for (int s = 0; s < 8; ++s) {
    for (int i = 0; i <= links; ++i) groom.positions.emplace_back(length * i / links, 0, 1e-3 * s);
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  return groom;
}

RoundedBox cylinder_of(double length) {
  const double radius = k_cylinder * length;
  return make_capsule({0, -radius, -0.1}, {0, -radius, 0.1}, radius);
}
Result<sim::State> draped(const std::string& name, const std::string& settings, int links, double length) {
  CUTICLE_ASSIGN(const auto solver, solver_of(name, tress(links, length), "damping=5," + settings,
                                              {.colliders = "pearl_radius=0,friction=0"}));
  const RoundedBox cylinder = cylinder_of(length);
  return run_still(*solver, 6, 1.0 / 60, {.boxes = {&cylinder, 1}});
}
/// Drop of the tips over the length.
double drop_of(std::span<const glm::vec3> positions, double length) {
  double sum = 0;
  const std::size_t each = positions.size() / 8;
  for (std::size_t s = 1; s <= 8; ++s) sum -= double(positions[s * each - 1].y);
  return sum / 8 / length;
}
Result<Outcome> drape_run(int links, double gamma) {
  const double length = length_of(gamma);
  CUTICLE_ASSIGN(const sim::State state, draped("rod", "sag_free=false", links, length));
  return Outcome{point_at(drape_curve(), gamma).value, drop_of(state.positions, length),
                 speed_over_fall(state, length)};
}
Result<Outcome> drape_at_rest(int links, double gamma) {
  const double length = length_of(gamma);
  const RoundedBox cylinder = cylinder_of(length);
  CUTICLE_ASSIGN(const AtRest rest, rest_of(tress(links, length), "sag_free=false", {&cylinder, 1}));
  return Outcome{point_at(drape_curve(), gamma).value, drop_of(rest.positions, length), rest.residual};
}
/// Without stiffness it follows the cylinder for a quarter turn and hangs.
Result<Outcome> limp_drape_run(const std::string& name, const std::string& settings) {
  const double length = 0.3, truth = 1 - k_cylinder * (std::numbers::pi / 2 - 1);
  CUTICLE_ASSIGN(const sim::State state, draped(name, settings, 64, length));
  return Outcome{truth, drop_of(state.positions, length), speed_over_fall(state, length)};
}

}  // namespace

Experiment cantilever(bool quick) {
  Experiment e{.name = "cantilever",
               .title = "Cantilever: from linear to fully bent",
               .truth = "the heavy elastica (reference/make_curves.py)",
               .x_label = "weight over stiffness, rho g A L^3 / EI",
               .y_label = "drop over width of the tip",
               .logarithmic = true,
               .curves = {curve_of("elastica", cantilever_curve())}};
  const std::vector<double> at = some_of(some_of(places_of(cantilever_curve()), true), quick);
  for (const int links : {32, 64})
    e.contestants.push_back(
        {"rod", {{"links", std::to_string(links)}}, at, [=](double gamma) { return cantilever_run(links, gamma); }});
  e.contestants.push_back(
      {"rod", {{"links", "64"}, {"steps", "no"}}, at, [](double gamma) { return cantilever_at_rest(64, gamma); }});
  return e;
}

Experiment hanging_arc(bool quick) {
  Experiment e{.name = "bend_twist",
               .title = "Bend and twist: a hanging curl leaves its plane",
               .truth = "second variation of the plane shape (reference/make_curves.py)",
               .x_label = "natural curvature, K L",
               .y_label = "weight over stiffness above which it stays plane",
               .curves = {curve_of("second variation", hanging_arc_curve())}};
  e.contestants = {buckling(32, hanging_arc_curve(), 0, 1, quick), buckling(64, hanging_arc_curve(), 0, 1, quick)};
  return e;
}

Experiment standing_arc(bool quick) {
  Experiment e{.name = "lateral_buckling",
               .title = "Lateral buckling: an arc that curves upwards falls to the side",
               .truth = "second variation of the plane shape (reference/make_curves.py)",
               .x_label = "natural curvature, K L",
               .y_label = "weight over stiffness at which it falls",
               .curves = {curve_of("second variation", standing_arc_curve())}};
  const double level = std::numbers::pi / 2;
  e.contestants = {buckling(32, standing_arc_curve(), level, -1, quick),
                   buckling(64, standing_arc_curve(), level, -1, quick)};
  return e;
}

Experiment drape(bool quick) {
  Experiment e{
      .name = "drape",
      .title = "A tress draped over a cylinder",
      .truth = "the heavy elastica that leaves a cylinder (reference/make_curves.py); without stiffness a quarter turn",
      .x_label = "weight over stiffness, rho g A L^3 / EI",
      .y_label = "drop of the tip over the length",
      .logarithmic_x = true,
      .curves = {curve_of("elastica", drape_curve())}};
  e.contestants.push_back({"rod", {{"links", "64"}}, some_of(places_of(drape_curve()), quick), [](double gamma) {
                             return drape_run(64, gamma);
                           }});
  e.contestants.push_back(
      {"rod", {{"links", "64"}, {"steps", "no"}}, some_of(places_of(drape_curve()), quick), [](double gamma) {
         return drape_at_rest(64, gamma);
       }});
  const std::string free(k_free);
  e.contestants.push_back(
      {"exact", {{"links", "64"}}, {1e6}, [=](double) { return limp_drape_run("exact", free); }, false});
  e.contestants.push_back({"rod",
                           {{"links", "64"}, {"stiffness", "0"}},
                           {1e6},
                           [=](double) { return limp_drape_run("rod", std::string(k_limp)); },
                           false});
  return e;
}

}  // namespace cuticle::study::mechanics
