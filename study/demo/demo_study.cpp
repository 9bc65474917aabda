#include "study/demo/demo_study.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/file.h"
#include "study/shadows/slices_study.h"

namespace cuticle::study {

namespace {

std::vector<std::string> cells(std::string name, const ErrorStatistics& error, std::string milliseconds) {
  return {std::move(name), fmt::format("{:.4f}", error.mean), fmt::format("{:.4f}", error.percentile_95),
          fmt::format("{:+.4f}", error.bias), std::move(milliseconds)};
}

DemoTable table_of(const Comparison& comparison) {
  DemoTable table{{"method", "mean error", "95th percentile", "bias", "build + lookup, ms"}, {}};
  table.rows.push_back(cells("none (T = 1)", comparison.none, "0"));
  table.rows.push_back(
      cells(fmt::format("best constant ({:.2f})", comparison.best_constant_value), comparison.best_constant, "0"));
  for (const ComparisonRow& row : comparison.rows)
    table.rows.push_back(cells(row.method + " " + row.settings, row.error,
                               fmt::format("{:.1f}", row.cost.build_ms + row.cost.lookup_ms)));
  return table;
}

DemoSection section_of(const Comparison& comparison) {
  return {"Opacity maps and deep opacity maps against ray-traced truth",
          fmt::format("Transmittance error over {} of {} strand vertices with 0.05 < T < 0.95; truth: {} rays over a "
                      "disc of radius {:.2f} mm, noise {:.4f}. "
                      "The study's own page is study/index.html.",
                      comparison.counted, comparison.receivers, comparison.rays, 1e3 * comparison.footprint_radius,
                      comparison.truth_standard_error),
          {},
          table_of(comparison)};
}

}  // namespace

Result<DemoSection> run_demo_study(const strands::Groom& drawn, const scene::Scene& scene, const std::string& folder,
                                   Progress& progress) {
  DemoSection skipped{"Opacity maps and deep opacity maps against ray-traced truth", "", {}, {}};
  const auto light = std::ranges::find_if(scene.lights, [](const Light& each) { return !each.point_light; });
  if (light == scene.lights.end()) {
    skipped.text = "Not run: the scene has no distant light.";
    return skipped;
  }
  SlicesStudy study = quick_slices_study();
  study.request.groom = &drawn;
  study.request.groom_name = scene.groom.file.empty() ? "grown hair" : scene.groom.file;
  const glm::dvec3 alpha = scene.fibre_alpha.value_or(glm::dvec3(1));
  study.request.alpha = (alpha.x + alpha.y + alpha.z) / 3;
  study.request.to_light = light->to_light;
  const auto comparison = run_slices_study(study, progress);
  if (!comparison) {
    skipped.text = "Not run: " + comparison.error().message;
    return skipped;
  }
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_TRY(write_comparison(*comparison, folder));
  return section_of(*comparison);
}

}  // namespace cuticle::study
