// Strands on supports: the capstan's law, a catenary that a weight pulls over a pulley, a tip that sticks and slips.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "study/mechanics/experiment.h"
#include "study/mechanics/reference/curves.h"
#include "study/mechanics/rope.h"
#include "study/mechanics/strands.h"

namespace cuticle::study::mechanics {
namespace {

constexpr double k_frame = 1.0 / 60;

std::string limp(const std::string& solver) {
  return solver == "rod" ? "young_modulus=1e6,sag_free=false," : std::string(k_free);
}

struct Sunk {
  double depth = 0, speed = 0;  ///< of the free end in a second, m; at its end, m/s
};
Result<Sunk> sunk(const std::string& solver, const Support& support, const Rope& rope, double friction) {
  const strands::Groom groom = rope.groom(support);
  CUTICLE_ASSIGN(const auto made, solver_of(solver, groom, limp(solver) + "damping=3",
                                            {.colliders = fmt::format("pearl_radius=0,friction={:.9g}", friction)}));
  const RoundedBox shape = support.shape();
  CUTICLE_ASSIGN(const sim::State state, run_still(*made, 1, k_frame, {.boxes = {&shape, 1}}));
  return Sunk{double(groom.positions.back().y) - double(state.positions.back().y), fastest(state)};
}

/// The least friction that holds the rope, found to a hundredth of the law's.
Result<Outcome> capstan_run(const std::string& solver, const Support& support, double ratio) {
  Rope rope;
  rope.hang = int(std::lround(ratio * rope.loop + 0.5));
  const double law = law_friction(support, rope.loop_tension(support), rope.free_tension(support));
  double low = 0, high = 2 * law, speed = 0;
  while (high - low > 0.02 * law) {
    const double middle = (low + high) / 2;
    CUTICLE_ASSIGN(const Sunk now, sunk(solver, support, rope, middle));
    const bool slips = std::abs(now.depth) > 5e-3;
    (slips ? low : high) = middle;
    if (!slips) speed = now.speed;
  }
  return Outcome{law, (low + high) / 2, speed / std::sqrt(k_g * support.radius)};
}

Experiment capstan(const std::string& name, const std::string& title, const Support& support, bool quick) {
  Experiment e{.name = name,
               .title = title,
               .truth = "the capstan's law with the rope's own weight",
               .x_label = "tension of the free end over the loop's",
               .y_label = "least friction that holds it",
               .residual = "speed of the fastest vertex where it holds, over sqrt(g R)",
               .curves = {{"capstan's law", {}, {}}}};
  const double loop = Rope{}.loop_tension(support);
  for (double ratio = 1.6; ratio <= 5.01; ratio += 0.1) {
    e.curves[0].x.push_back(ratio);
    e.curves[0].y.push_back(law_friction(support, loop, ratio * loop));
  }
  const std::vector<double> at = ends_of({2, 2.75, 3.5, 4.25, 5}, quick);
  for (const std::string solver : {"exact", "rod"})
    e.contestants.push_back({solver, {}, at, [=](double ratio) { return capstan_run(solver, support, ratio); }});
  return e;
}

// A chain from the origin over a frictionless pulley at the same height, with a free end. Without friction the tension
// over the weight per length is the height above the free end: the catenary's directrix is there.
constexpr double k_span = 0.2, k_pulley = 0.03;  ///< m: to the pulley's middle; its radius

struct Catenary {
  double a = 0, lowest = 0, end = 0, middle = 0, length = 0;  ///< m
};
/// That which touches the pulley `angle` before its top; a by bisection, so that the root lies on it.
Catenary touching(double angle) {
  const double x = k_span - k_pulley * std::sin(angle), y = k_pulley * std::cos(angle),
               rise = std::asinh(std::tan(angle));
  double low = 1e-4, high = 10;
  const auto off = [&](double a) { return a * std::cosh(x / a - rise) - a / std::cos(angle) + y; };
  for (int k = 0; k < 200; ++k) {
    const double a = (low + high) / 2;
    (off(a) > 0 ? low : high) = a;
  }
  Catenary c{.a = low};
  c.middle = x - c.a * rise;
  c.end = y - c.a / std::cos(angle);
  c.lowest = c.end + c.a;
  c.length = c.a * (std::tan(angle) + std::sinh(c.middle / c.a)) + k_pulley * (angle + std::numbers::pi / 2) - c.end;
  return c;
}
/// The stable one of this length: the tauter of two.
Catenary catenary_of(double length) {
  double low = 0.06, high = 0.78;  // the length falls with the angle to about there
  while (high - low > 1e-13) {
    const double middle = (low + high) / 2;
    (touching(middle).length > length ? low : high) = middle;
  }
  return touching(low);
}

/// Straight to the pulley, and hanging.
strands::Groom pulled(int links, double length) {
  const double angle = std::asin(k_pulley / k_span), taut = std::sqrt(k_span * k_span - k_pulley * k_pulley),
               l = length / links;
  std::vector<glm::dvec3> places;
  for (int i = 0; i <= links; ++i) {
    const double at = i * l, round = k_pulley * (angle + std::numbers::pi / 2);
    if (at <= taut) {
      places.emplace_back(at * std::cos(angle), at * std::sin(angle), 0);
    } else if (at <= taut + round) {
      const double turn = (at - taut) / k_pulley - angle;
      places.emplace_back(k_span + k_pulley * std::sin(turn), k_pulley * std::cos(turn), 0);
    } else {
      places.emplace_back(k_span + k_pulley, taut + round - at, 0);
    }
  }
  return groom_of(places);
}

Result<Outcome> catenary_run(const std::string& solver, int links, double ratio) {
  const double length = ratio * k_span;
  const std::string settings = solver == "rod"       ? std::string(k_limp)
                               : solver == "classic" ? std::string(k_free) + "iterations=30,"
                                                     : std::string(k_free);
  CUTICLE_ASSIGN(const auto made, solver_of(solver, pulled(links, length), settings + "damping=3",
                                            {.colliders = "pearl_radius=0,friction=0"}));
  const RoundedBox pulley = make_capsule({k_span, 0, -0.2}, {k_span, 0, 0.2}, k_pulley);
  const Sphere ball{{k_span, 0, 0}, k_pulley};
  sim::FrameInput beside;
  if (solver == "classic")
    beside.colliders = {&ball, 1};
  else
    beside.boxes = {&pulley, 1};
  CUTICLE_ASSIGN(const sim::State state, run_still(*made, 8, k_frame, beside));
  double lowest = 0;
  for (const glm::vec3& place : state.positions)
    if (double(place.x) < k_span - k_pulley) lowest = std::min(lowest, double(place.y));
  return Outcome{-catenary_of(length).lowest / k_span, -lowest / k_span, fastest(state) / std::sqrt(k_g * k_span)};
}

// A weightless rod points down at a floor that its clamp goes towards.
constexpr double k_rod = 0.05, k_lowering = 0.02;  ///< m; m/s
constexpr double k_fast = 2.5e-3;  ///< m/s of the tip that count as slipping: five times what rod's friction lets creep
constexpr double k_lowest = 0.6;   ///< share of the length

/// On the curve, linear between its points.
double lowered_by_theory(double friction) {
  const std::vector<ReferencePoint>& curve = stick_slip_curve();
  std::size_t k = 1;
  while (k + 1 < curve.size() && curve[k].value < friction) ++k;
  const ReferencePoint &low = curve[k - 1], &high = curve[k];
  return low.at + (high.at - low.at) * (friction - low.value) / (high.value - low.value);
}

Result<Outcome> stick_slip_run(int links, double friction) {
  CUTICLE_ASSIGN(
      const auto solver,
      solver_of("rod", straight(links, k_rod, glm::normalize(glm::dvec3(2e-3, -1, 0))), "sag_free=false,damping=20",
                {.colliders = fmt::format("pearl_radius=0,friction={:.9g}", friction), .is_weightless = true}));
  const sim::MovingCollider floor{.shape = RoundedBox{.center = {0, -k_rod - 0.05, 0}, .half_size = {0.2, 0.05, 0.2}},
                                  .motion = {}};
  const auto head = [](double time) { return glm::translate(glm::dmat4(1), glm::dvec3(0, -k_lowering * time, 0)); };
  double before = 0;
  for (int k = 0; k < int(k_lowest * k_rod / k_lowering / k_frame); ++k) {
    CUTICLE_TRY(solver->advance({.duration = k_frame,
                                 .head_begin = head(k * k_frame),
                                 .head_end = head((k + 1) * k_frame),
                                 .moving = {&floor, 1}}));
    CUTICLE_ASSIGN(const sim::State state, solver->state());
    const double slid = std::abs(double(state.positions.back().x));
    const double lowered = k_lowering * (k + 0.5) * k_frame / k_rod;
    if (slid - before > k_fast * k_frame) return Outcome{lowered_by_theory(friction), lowered, before / k_rod};
    before = slid;
  }
  return Outcome{lowered_by_theory(friction), k_lowest, before / k_rod};
}

}  // namespace

Experiment capstan_over_a_cylinder(bool quick) {
  return capstan("capstan", "Capstan: a rope over a cylinder", {}, quick);
}
Experiment capstan_over_edges(bool quick) {
  return capstan("capstan_edges", "Capstan: a rope over two sharp edges", {.has_edges = true}, quick);
}

Experiment catenary(bool quick) {
  Experiment e{.name = "catenary",
               .title = "Catenary: a chain that its free end pulls over a pulley",
               .truth = "the catenary whose directrix is at the free end",
               .x_label = "length over span",
               .y_label = "sag over span",
               .logarithmic_y = true,
               .error = "error of the sag over the span",
               .is_relative = false,
               .curves = {{"catenary", {}, {}}}};
  for (double ratio = 2.15; ratio <= 4.01; ratio += 0.05) {
    e.curves[0].x.push_back(ratio);
    e.curves[0].y.push_back(-catenary_of(ratio * k_span).lowest / k_span);
  }
  const std::vector<double> at = ends_of({2.2, 2.6, 3, 3.4, 3.8}, quick);
  for (const std::string solver : {"classic", "exact", "rod"})
    e.contestants.push_back(
        {solver, {{"links", "128"}}, at, [=](double ratio) { return catenary_run(solver, 128, ratio); }});
  e.contestants.push_back(
      {"exact", {{"links", "256"}}, at, [=](double ratio) { return catenary_run("exact", 256, ratio); }});
  return e;
}

Experiment stick_slip(bool quick) {
  Experiment e{.name = "stick_slip",
               .title = "Stick and slip: a rod pressed down on a floor",
               .truth = "weightless elastica whose tip is held (reference/make_curves.py)",
               .x_label = "friction",
               .y_label = "share of the length lowered when the tip slips",
               .residual = "creep of the tip before it slips, over the length",
               .curves = {{"elastica", {}, {}}}};
  for (const ReferencePoint& point : stick_slip_curve()) {
    e.curves[0].x.push_back(point.value);
    e.curves[0].y.push_back(point.at);
  }
  const std::vector<double> at = some_of({0.1, 0.2, 0.3, 0.4, 0.5}, quick);
  for (const int links : {16, 32})
    e.contestants.push_back({"rod", {{"links", std::to_string(links)}}, at, [=](double friction) {
                               return stick_slip_run(links, friction);
                             }});
  return e;
}

}  // namespace cuticle::study::mechanics
