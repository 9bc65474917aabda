#include "study/plan/accuracy_gpu.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "lut/format.h"
#include "lut/table_set.h"
#include "plan/frame_runner_gpu.h"
#include "plan/strand_set.h"
#include "shadows/light_frame.h"
#include "sim/solver.h"
#include "study/render/picture_error.h"
#include "study/shadows/comparison.h"

namespace cuticle::study {
namespace {

using plan::AccuracyRow;

struct Setting {
  std::string_view method, settings;
};
constexpr Setting k_shadows[] = {{"opacity_map", "slices=16,resolution=256"},
                                 {"opacity_map", "slices=32,resolution=256"},
                                 {"opacity_map", "slices=32,resolution=512"},
                                 {"opacity_map", "slices=64,resolution=512"},
                                 {"deep_opacity", "layers=4,resolution=256"},
                                 {"deep_opacity", "layers=8,resolution=256"},
                                 {"deep_opacity", "layers=16,resolution=256"},
                                 {"deep_opacity", "layers=8,resolution=512"},
                                 {"deep_opacity", "layers=16,resolution=512"},
                                 {"deep_opacity", "layers=16,resolution=1024"},
                                 {"deep_opacity", "layers=16,resolution=2048"},
                                 {"deep_shadow", "resolution=256"},
                                 {"deep_shadow", "resolution=512"},
                                 {"deep_shadow", "resolution=1024"},
                                 {"deep_shadow", "resolution=2048"},
                                 {"moments", ""},
                                 {"fourier", "harmonics=3"}};
constexpr std::string_view k_draws[] = {"lines", "quads", "tiles"};
constexpr int k_table_sizes[] = {16, 32, 64, 128};
constexpr int k_steps_a_second[] = {120, 240, 480, 960};
constexpr int k_steps_of_truth = 32 * 240;

Result<Image> hair_alone(const std::shared_ptr<gpu::Device>& device, scene::Scene scene, std::string_view method,
                         Progress& progress) {
  scene.render_method = method;
  scene.head.present = false;
  for (const char* pass : {"surface_shadow", "resolve", "motion_blur", "dual_scattering"}) scene.passes.erase(pass);
  scene.shadow.reset();
  scene.simulation.solver.reset();
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, progress));
  CUTICLE_ASSIGN(plan::FrameResult frame, runner->run(0));
  return std::move(frame.color);
}

Result<std::vector<Candidate>> shadow_candidates() {
  std::vector<Candidate> candidates;
  for (const Setting& setting : k_shadows) {
    CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(setting.method));
    CUTICLE_ASSIGN(auto values, registry::parse_assignments(method->entry.parameters, setting.settings));
    candidates.push_back({method, std::move(values)});
  }
  return candidates;
}

/// Shadows are judged by the light of cells of a picture, this many across: whether single fibres of a pixel are lit is
/// below what maps resolve, and below what is seen.
constexpr int k_cells = 24;

glm::dvec3 to_camera_of(const scene::Scene& scene) {
  return glm::normalize(scene.camera.camera.position - scene.camera.camera.target);
}

/// At what the scene's camera sees of the strands as drawn, to the scene's first light.
Result<Comparison> compare_shadows(const scene::Scene& scene, const strands::Groom& drawn,
                                   std::vector<Candidate> candidates, Progress& progress) {
  ComparisonRequest request;
  request.groom = &drawn;
  const glm::dvec3 alpha = scene.fibre_alpha.value_or(glm::dvec3(1));
  request.alpha = (alpha.x + alpha.y + alpha.z) / 3;
  if (!scene.lights.empty()) request.to_light = scene.lights.front().to_light;
  request.to_camera = to_camera_of(scene);
  request.receivers = 100000;  // each is lit or not: what that leaves of noise is taken off (cell_error)
  request.rays = 32;
  request.candidates = std::move(candidates);
  return compare_with_truth(request, progress);
}

/// T less true T of a cell's receivers.
struct CellLight {
  double sum = 0, sum_of_squares = 0;
  int receivers = 0;

  void add(double difference) {
    sum += difference;
    sum_of_squares += difference * difference;
    ++receivers;
  }
  /// The square of their mean, less what chance adds to it: the mean's variance, by how they differ from each other.
  double square_of_mean() const {
    const double mean = sum / receivers;
    return mean * mean - (sum_of_squares / receivers - mean * mean) / (receivers - 1);
  }
};

/// Root mean square over the picture of the differences of mean T and mean true T of a cell, without the noise of a
/// truth of points that are lit or not.
double cell_error(const scene::Scene& scene, const Comparison& compared, const std::vector<float>& transmittance) {
  const shadows::LightAxes axes = shadows::light_axes(to_camera_of(scene));
  const shadows::LightBox box = shadows::light_box(axes, compared.points);
  const glm::vec3 size = box.upper - box.lower;
  const float cells_a_metre = float(k_cells) / std::max({size.x, size.y, 1e-9f});
  std::map<std::pair<int, int>, CellLight> cells;
  for (std::size_t i = 0; i < compared.points.size(); ++i) {
    const glm::vec3 at = (shadows::view_point(axes, compared.points[i]) - box.lower) * cells_a_metre;
    cells[{int(at.x), int(at.y)}].add(double(transmittance[i]) - double(compared.truth[i]));
  }
  double sum = 0, receivers = 0;
  for (const auto& [place, cell] : cells) {
    if (cell.receivers < 2) continue;
    sum += cell.receivers * cell.square_of_mean();
    receivers += cell.receivers;
  }
  return receivers > 0 ? std::sqrt(std::max(0.0, sum / receivers)) : 0;
}

/// The first frame's strands, at rest.
Result<strands::Groom> drawn_strands(const std::shared_ptr<gpu::Device>& device, scene::Scene scene,
                                     Progress& progress) {
  scene.simulation.solver.reset();
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, progress));
  CUTICLE_TRY(runner->run(0));
  return runner->drawn_strands();
}

Result<double> coverage_error(const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene,
                              std::string_view method, const Image& truth, Progress& progress) {
  CUTICLE_ASSIGN(const Image picture, hair_alone(device, scene, method, progress));
  return mean_error(compare(picture, truth).coverage);
}

/// Scattering from tables of a size, rms over the rms of S of the worst channel.
Result<double> table_error(const scene::Scene& scene, int size, Progress& progress) {
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(scene.material.model.name));
  const auto& values = scene.material.model.values;
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout(scene.material.layout, *model, values));
  CUTICLE_ASSIGN(lut::TableSet set, lut::bake(*model, values, *layout, size, progress));
  CUTICLE_TRY(lut::certify(set, lut::half_exr(), progress));
  double worst = 0;
  for (const lut::ChannelError& error : set.scattering)
    worst = std::max(worst, lut::relative_error(error.rms, error.signal_rms));
  return worst;
}

/// Where the control hairs are after half a second in which the head turns by 40 degrees, by steps of a second. The
/// truth is computed in double: in float, steps below 1/2,000 s are lost in the rounding of places
/// (sim/exact/README.md).
Result<std::vector<glm::vec3>> turned_hair(const strands::Groom& rest, std::string_view solver, int steps) {
  CUTICLE_ASSIGN(const sim::Effect* effect, sim::find_effect(solver));
  CUTICLE_ASSIGN(const auto values,
                 registry::parse_assignments(effect->entry.parameters,
                                             fmt::format("inner_step={},max_substeps=1024,double_precision={}",
                                                         1.0 / steps, steps >= k_steps_of_truth)));
  CUTICLE_ASSIGN(const sim::Effect* gravity, sim::find_effect("gravity"));
  CUTICLE_ASSIGN(const auto made,
                 effect->create(rest, values, {{"gravity", registry::default_values(gravity->entry.parameters)}}));
  const auto head = [](int frame) {
    return glm::rotate(glm::dmat4(1), 0.7 * std::min(frame / 15.0, 1.0), glm::dvec3(0, 1, 0));
  };
  for (int frame = 0; frame < 15; ++frame)
    CUTICLE_TRY(made->advance({.duration = 1.0 / 30, .head_begin = head(frame), .head_end = head(frame + 1)}));
  CUTICLE_ASSIGN(sim::State state, made->state());
  return std::move(state.positions);
}

/// Mean distance from the hair of the truth's steps, over the mean length of the hair.
double motion_error(const strands::Groom& rest, std::span<const glm::vec3> places, std::span<const glm::vec3> truth) {
  double sum = 0, length = 0;
  for (std::size_t i = 0; i < places.size(); ++i) sum += double(glm::distance(places[i], truth[i]));
  for (std::size_t s = 0; s < rest.strand_count(); ++s)
    for (std::size_t i = rest.offsets[s] + 1; i < rest.offsets[s + 1]; ++i)
      length += double(glm::distance(rest.positions[i], rest.positions[i - 1]));
  return sum / double(places.size()) / (length / double(rest.strand_count()));
}

/// Errors by part, method and settings, one for each groom.
class Errors {
 public:
  void add(std::string_view part, std::string_view method, std::string_view settings, double error) {
    auto& row = rows_[fmt::format("{}\n{}\n{}", part, method, settings)];
    row.first = {std::string(part), std::string(method), std::string(settings)};
    row.second.push_back(error);
  }
  std::vector<AccuracyRow> rows() const {
    std::vector<AccuracyRow> rows;
    for (const auto& [key, row] : rows_) {
      AccuracyRow made = row.first;
      for (double error : row.second) made.error += error / double(row.second.size());
      made.at_most = plan::upper_bound(row.second);
      made.grooms = int(row.second.size());
      rows.push_back(std::move(made));
    }
    return rows;
  }

 private:
  std::map<std::string, std::pair<AccuracyRow, std::vector<double>>> rows_;
};

/// One scene, as far as its parts are asked for.
class SceneErrors {
 public:
  SceneErrors(const std::shared_ptr<gpu::Device>& device, scene::Scene scene, Errors& errors, Progress& progress)
      : device_(device), scene_(std::move(scene)), errors_(errors), progress_(progress) {
    scene_.simulation.solver.reset();
    scene_.camera.camera.resolution = {256, 256};
  }

  Result<void> add_shadow() {
    CUTICLE_ASSIGN(const auto runner, first_frame());
    CUTICLE_ASSIGN(const strands::Groom drawn, runner->drawn_strands());
    CUTICLE_ASSIGN(auto candidates, shadow_candidates());
    CUTICLE_ASSIGN(const Comparison compared, compare_shadows(scene_, drawn, std::move(candidates), progress_));
    for (std::size_t k = 0; k < compared.rows.size(); ++k)
      errors_.add("shadow", k_shadows[k].method, k_shadows[k].settings,
                  cell_error(scene_, compared, compared.rows[k].transmittance));
    return {};
  }

  Result<void> add_coverage() {
    CUTICLE_ASSIGN(const Image truth, hair_alone(device_, scene_, "supersampled", progress_));
    for (std::string_view draw : k_draws) {
      CUTICLE_ASSIGN(const double error, coverage_error(device_, scene_, draw, truth, progress_));
      errors_.add("coverage", draw, "", error);
    }
    return {};
  }

  Result<void> add_shading() {
    for (int size : k_table_sizes) {
      CUTICLE_ASSIGN(const double error, table_error(scene_, size, progress_));
      errors_.add("shading", "tables", fmt::format("lut_size={}", size), error);
    }
    return {};
  }

  Result<void> add_motion() {
    CUTICLE_ASSIGN(const plan::StrandSet set, plan::build_strand_set(scene_));
    CUTICLE_ASSIGN(const auto truth, turned_hair(set.control, "exact", k_steps_of_truth));
    for (int steps : k_steps_a_second) {
      CUTICLE_ASSIGN(const auto places, turned_hair(set.control, "exact", steps));
      errors_.add("motion", "exact", fmt::format("inner_step={:.6g}", 1.0 / steps),
                  motion_error(set.control, places, truth));
    }
    return {};
  }

 private:
  Result<std::unique_ptr<plan::FrameRunner>> first_frame() {
    CUTICLE_ASSIGN(auto runner, plan::FrameRunner::create(device_, scene_, progress_));
    CUTICLE_TRY(runner->run(0));
    return runner;
  }

  const std::shared_ptr<gpu::Device>& device_;
  scene::Scene scene_;
  Errors& errors_;
  Progress& progress_;
};

}  // namespace

Result<plan::AccuracyTable> measure_accuracy(const std::shared_ptr<gpu::Device>& device,
                                             const std::vector<std::string>& scenes,
                                             const std::vector<std::string>& parts, Progress& progress) {
  const auto wants = [&](std::string_view part) { return std::ranges::find(parts, part) != parts.end(); };
  Errors errors;
  std::vector<scene::MaterialSource> materials;
  std::size_t done = 0;
  for (const std::string& file : scenes) {
    progress.update("scenes", done++, scenes.size());
    CUTICLE_ASSIGN(const scene::Scene scene, scene::load_scene(file, plan::catalogue()));
    const bool is_new = std::ranges::find(materials, scene.material) == materials.end();
    if (is_new) materials.push_back(scene.material);
    SceneErrors of_scene(device, scene, errors, progress);
    if (wants("shadow")) CUTICLE_TRY(of_scene.add_shadow());
    if (wants("coverage")) CUTICLE_TRY(of_scene.add_coverage());
    if (wants("shading") && is_new) CUTICLE_TRY(of_scene.add_shading());
    if (wants("motion")) CUTICLE_TRY(of_scene.add_motion());
  }
  return plan::AccuracyTable{fmt::format("cuticle study plan --accuracy: {} scenes", scenes.size()), errors.rows()};
}

Result<std::vector<AccuracyRow>> measure_scene(const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene,
                                               Progress& progress) {
  std::vector<AccuracyRow> rows;
  const auto add = [&](const char* part, std::string_view method, double error) {
    rows.push_back({part, std::string(method), "", error, error, 1});
  };
  if (scene.shadow && !scene.lights.empty()) {
    CUTICLE_ASSIGN(const strands::Groom drawn, drawn_strands(device, scene, progress));
    CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(scene.shadow->name));
    CUTICLE_ASSIGN(const Comparison compared,
                   compare_shadows(scene, drawn, {{method, scene.shadow->values}}, progress));
    add("shadow", method->entry.name, cell_error(scene, compared, compared.rows.front().transmittance));
  }
  if (std::ranges::find(k_draws, scene.render_method) != std::end(k_draws)) {
    CUTICLE_ASSIGN(const Image truth, hair_alone(device, scene, "supersampled", progress));
    CUTICLE_ASSIGN(const double error, coverage_error(device, scene, scene.render_method, truth, progress));
    add("coverage", scene.render_method, error);
  }
  return rows;
}

}  // namespace cuticle::study
