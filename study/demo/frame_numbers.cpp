#include "study/demo/frame_numbers.h"

#include <algorithm>

#include <fmt/core.h>

#include "plan/frame_runner_gpu.h"
#include "study/render/picture_error.h"
#include "study/shadows/comparison.h"

namespace cuticle::study {

namespace {

using Row = std::vector<std::string>;

/// Of the channel that is worst off.
Row scattering_row(const scene::Scene& scene, const lut::TableSet& tables) {
  const char* what = "S of the material, rms over the rms of S";
  if (scene.material.evaluate == "direct") return {what, "0", "0.01", "the model's own formula at every shading point"};
  double worst = 0;
  for (const lut::ChannelError& error : tables.scattering)
    worst = std::max(worst, lut::relative_error(error.rms, error.signal_rms));
  return {what, fmt::format("{:.4f}", worst), "0.01",
          fmt::format("tables of {} x {} texels against the model in double", tables.size, tables.size)};
}

Result<Image> hair_alone(std::shared_ptr<gpu::Device> device, scene::Scene scene, const std::string& method,
                         Progress& progress) {
  scene.render_method = method;
  scene.head.present = false;
  scene.material.evaluate = "tables";
  scene.passes.erase("surface_shadow");
  scene.passes.erase("resolve");  // a background would leave no alpha
  scene.passes.erase("motion_blur");
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, progress));
  CUTICLE_ASSIGN(plan::FrameResult frame, runner->run(0));
  return std::move(frame.color);
}

Result<double> coverage_error(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, Progress& progress) {
  CUTICLE_ASSIGN(const Image picture, hair_alone(device, scene, scene.render_method, progress));
  CUTICLE_ASSIGN(const Image truth, hair_alone(device, scene, "supersampled", progress));
  return mean_error(compare(picture, truth).coverage);
}

Row coverage_row(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, Progress& progress) {
  const char* what = "coverage of a pixel, mean error";
  const auto error = coverage_error(std::move(device), scene, progress);
  if (!error) return {what, "not measured", "0.02", error.error().message};
  return {what, fmt::format("{:.4f}", *error), "0.02",
          fmt::format("{} against brute force, frame 0", scene.render_method)};
}

Result<ComparisonRow> shadow_error(const scene::Scene& scene, const Light& light, const strands::Groom& drawn,
                                   Progress& progress) {
  CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(scene.shadow->name));
  ComparisonRequest request;
  request.groom = &drawn;
  const glm::dvec3 alpha = scene.fibre_alpha.value_or(glm::dvec3(1));
  request.alpha = (alpha.x + alpha.y + alpha.z) / 3;
  request.to_light = light.to_light;
  request.receivers = 400;
  request.rays = 256;
  request.candidates = {{method, scene.shadow->values}};
  CUTICLE_ASSIGN(Comparison comparison, compare_with_truth(request, progress));
  return std::move(comparison.rows.front());
}

std::vector<Row> shadow_rows(const scene::Scene& scene, const strands::Groom& drawn, Progress& progress) {
  std::vector<Row> rows;
  for (const Light& light : scene.lights) {
    if (light.point_light || !scene.shadow) continue;
    const std::string what = fmt::format("transmittance to the light '{}', mean error", light.name);
    const auto error = shadow_error(scene, light, drawn, progress);
    if (!error)
      rows.push_back({what, "not measured", "0.03", error.error().message});
    else
      rows.push_back({what, fmt::format("{:.4f}", error->error.mean), "0.03",
                      fmt::format("{} {}; bias {:+.4f}", error->method, error->settings, error->error.bias)});
  }
  return rows;
}

}  // namespace

DemoSection frame_numbers(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, const lut::TableSet& tables,
                          const strands::Groom& drawn, Progress& progress) {
  DemoSection section{"How exact these frames are",
                      "Errors of the settings that the frames were drawn with, each part against its own truth.",
                      {},
                      {{"what", "error", "limit", "how"}, {}}};
  section.table.rows = {scattering_row(scene, tables), coverage_row(std::move(device), scene, progress)};
  for (Row& row : shadow_rows(scene, drawn, progress)) section.table.rows.push_back(std::move(row));
  return section;
}

}  // namespace cuticle::study
