#include "study/motion/motion_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "study/motion/effect_values.h"

namespace cuticle::study {
namespace {

constexpr int k_strands = 16, k_early = 12, k_frames = 30;
constexpr double k_frame = 1.0 / 60, k_length = 0.3;

struct MotionCase {
  std::string name, reference;                 ///< reference: a solver
  std::map<std::string, std::string> solvers;  ///< name, settings
  strands::Groom groom;                        ///< equal strands
  bool turns = false;
  std::vector<Sphere> spheres;
  double length = k_length;
};

strands::Groom repeated(const std::vector<glm::vec3>& strand) {
  strands::Groom groom;
  for (int s = 0; s < k_strands; ++s) {
    groom.positions.insert(groom.positions.end(), strand.begin(), strand.end());
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  return groom;
}
strands::Groom straight(const glm::dvec3& root, const glm::dvec3& direction) {
  std::vector<glm::vec3> strand;
  for (int i = 0; i <= 31; ++i) strand.emplace_back(root + direction * (k_length * i / 31));
  return repeated(strand);
}
strands::Groom curl() {
  std::vector<glm::vec3> strand;
  for (int i = 0; i <= 48; ++i) {
    const double angle = 2 * std::numbers::pi * i / 16;
    strand.emplace_back(0.1 + 0.008 * std::cos(angle), -0.0015 * i, 0.008 * std::sin(angle));
  }
  return repeated(strand);
}

std::vector<MotionCase> motion_cases() {
  const std::string free = "damping=0,shape_stiffness=0,clamped_vertices=1";
  const std::string limp = "damping=0,young_modulus=0,shear_modulus=0,sag_free=false";
  const std::map<std::string, std::string> flexible{{"classic", free}, {"exact", free}, {"rod", limp}};
  const std::string held = "damping=2,clamped_vertices=1";
  const double curl_length = 48 * std::hypot(0.0015, 2 * 0.008 * std::sin(std::numbers::pi / 16));
  return {
      {"swing", "exact", flexible, straight({0, 0, 0}, {1, 0, 0}), false, {}, k_length},
      {"head turn", "exact", flexible, straight({0.1, 0, 0}, {0, -1, 0}), true, {}, k_length},
      {"contact", "exact", flexible, straight({0, 0, 0}, {1, 0, 0}), false, {{{0.03, -0.12, 0.01}, 0.06}}, k_length},
      {"curl", "rod", {{"classic", held}, {"exact", held}, {"rod", "damping=2"}}, curl(), true, {}, curl_length}};
}

/// A quarter turn within 0.25 s, eased in and out.
glm::dmat4 head_at(const MotionCase& scene, int frame) {
  if (!scene.turns) return glm::dmat4(1);
  const double share = std::min(1.0, frame / 15.0), eased = share * share * (3 - 2 * share);
  return glm::rotate(glm::dmat4(1), eased * std::numbers::pi / 2, glm::dvec3(0, 1, 0));
}

struct Run {
  std::vector<glm::vec3> early, late;
  double largest_stretch = 1;
};

Result<std::unique_ptr<sim::Solver>> solver_of(const MotionCase& scene, const std::string& name,
                                               const std::string& settings) {
  CUTICLE_ASSIGN(const sim::Effect* effect, sim::find_effect(name));
  CUTICLE_ASSIGN(const registry::ParameterValues values, effect_values(name, settings));
  sim::EffectBlocks effects;
  CUTICLE_ASSIGN(effects["gravity"], effect_values("gravity", ""));
  if (!scene.spheres.empty()) {
    CUTICLE_ASSIGN(effects["colliders"], effect_values("colliders", "pearl_radius=0"));
  }
  return effect->create(scene.groom, values, effects);
}

Result<Run> run_once(const MotionCase& scene, const std::string& name, const std::string& settings) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  CUTICLE_ASSIGN(const std::unique_ptr<sim::Solver> solver, solver_of(scene, name, settings));
  Run run;
  for (int frame = 0; frame < k_frames; ++frame) {
    CUTICLE_TRY(solver->advance({.duration = k_frame,
                                 .head_begin = head_at(scene, frame),
                                 .head_end = head_at(scene, frame + 1),
                                 .colliders = scene.spheres}));
    if (frame + 1 != k_early && frame + 1 != k_frames) continue;
    CUTICLE_ASSIGN(const sim::State state, solver->state());
    (frame + 1 == k_early ? run.early : run.late) = state.positions;
    const std::vector<float> stretch = sim::stretch(scene.groom, state.positions);
    run.largest_stretch = double(*std::max_element(stretch.begin(), stretch.end()));
  }
  return run;
}

double distance(const MotionCase& scene, const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::dvec3 away = glm::dvec3(a[i]) - glm::dvec3(b[i]);
    sum += glm::dot(away, away);
  }
  return std::sqrt(sum / double(a.size())) / scene.length;
}

std::string stepped(const std::string& settings, int substeps) {
  return fmt::format("{},inner_step={:.17g},max_substeps={}", settings, k_frame / substeps, substeps);
}

using SharedCase = std::shared_ptr<const MotionCase>;

/// A solver with its substeps against the reference.
Point point_of(const SharedCase& scene, const std::shared_ptr<const Run>& truth, std::vector<Knob> knobs,
               const std::string& solver, const std::string& settings) {
  const auto measure = [=]() -> Result<Measured> {
    CUTICLE_ASSIGN(const Run run, run_once(*scene, solver, settings));
    return Measured{{{distance(*scene, run.late, truth->late)}, {distance(*scene, run.early, truth->early)}, {run.largest_stretch - 1}}};
  };
  const auto work = [=]() -> Result<void> {
    CUTICLE_ASSIGN(const Run run, run_once(*scene, solver, settings));
    return {};
  };
  return {solver, std::move(knobs), measure, {{}, work, double(k_frames * k_strands)}};
}

Result<Group> group_of(const SharedCase& scene, const MotionRequest& request) {
  const std::string exact = scene->solvers.at(scene->reference) + ",double_precision=true";
  CUTICLE_ASSIGN(Run reference, run_once(*scene, scene->reference, stepped(exact, request.reference_substeps)));
  CUTICLE_ASSIGN(const Run half, run_once(*scene, scene->reference, stepped(exact, request.reference_substeps / 2)));
  const auto truth = std::make_shared<const Run>(std::move(reference));
  Group group{.name = scene->name,
              .title = fmt::format("{}: solvers by their substeps", scene->name),
              .truth = fmt::format("{} in double with {} substeps in 1/60 s", scene->reference, request.reference_substeps),
              .metrics = {{"late", "rms distance over the length, after 0.5 s"},
                          {"early", "rms distance over the length, after 0.2 s"},
                          {"stretch", "largest stretch less 1, after 0.5 s"}},
              .item = "run",
              .floor = distance(*scene, half.late, truth->late)};
  for (const auto& [solver, settings] : scene->solvers)
    for (int substeps : request.substeps)
      for (int iterations : solver == "classic" ? request.iterations : std::vector<int>{1}) {
        std::vector<Knob> knobs = {{"substeps", std::to_string(substeps)}};
        if (solver == "classic") knobs.push_back({"iterations", std::to_string(iterations)});
        const std::string sweeps = solver == "classic" ? fmt::format(",iterations={}", iterations) : std::string();
        group.points.push_back(point_of(scene, truth, std::move(knobs), solver, stepped(settings + sweeps, substeps)));
      }
  return group;
}

/// Errors against closed forms by the step, a curve for each truth and solver.
Plot truths_plot(const std::vector<TruthRow>& rows) {
  Plot plot{"truths", "Closed forms of mechanics", "time step, s", "error", false, true, {}};
  for (const TruthRow& row : rows) {
    const std::string name = fmt::format("{} ({})", row.truth, row.solver);
    if (plot.curves.empty() || plot.curves.back().name != name) plot.curves.push_back({name, {}, {}});
    plot.curves.back().x.push_back(row.step);
    plot.curves.back().y.push_back(row.error);
  }
  return plot;
}

}  // namespace

MotionRequest quick_motion_request() {
  return {.substeps = {2, 8}, .iterations = {4}, .reference_substeps = 32, .truth_steps = {1.0 / 480, 1.0 / 120}};
}

Result<Study> motion_study(const MotionRequest& request, Progress& progress) {
  Study study{.name = "motion",
              .title = "Strand solvers: error against time",
              .question = "Which solver and how many substeps hold an error, and what do they cost?",
              .cost_label = "a frame (1/60 s) and strand"};
  std::vector<MotionCase> cases = motion_cases();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    progress.update("scenes", i, cases.size());
    CUTICLE_ASSIGN(Group group, group_of(std::make_shared<const MotionCase>(std::move(cases[i])), request));
    study.groups.push_back(std::move(group));
  }
  progress.update("scenes", cases.size(), cases.size());
  CUTICLE_ASSIGN(const std::vector<TruthRow> truths, run_motion_truths(request.truth_steps));
  study.plots.push_back(truths_plot(truths));
  return study;
}

}  // namespace cuticle::study
