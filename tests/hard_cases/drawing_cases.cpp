// Pictures: {"groom", "scene": parts of a scene file, "methods": ways of drawing on the device, "measure"}. On the CPU
// the scene is path traced. Every pixel must be finite; measures, of each method one after the other: "coverage", the
// mean of alpha; "alpha", its least and its largest; "color", the mean of red, green and blue.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/image/image.h"
#include "core/json/json.h"
#include "core/output_file.h"
#include "plan/plan.h"
#include "plan/traced_scene_runner.h"
#include "scene/scene.h"
#include "strands/formats/formats.h"
#include "tests/hard_cases/subject.h"
#ifdef CUTICLE_HAS_GPU
#include "plan/frame_runner_gpu.h"
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {
namespace {

/// A small picture without simulation; a case's "scene" replaces whole keys.
constexpr const char* k_usual_scene = R"({"schema_version": 1,
  "material": {"model": {"marschner": {"sigma_a": [0.2, 0.3, 0.5]}}, "layout": "nalu", "lut_size": 16},
  "lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [3, 3, 3]}],
  "camera": {"position_m": [0, 0.05, 0.6], "target_m": [0, 0, 0], "fov_deg": 30, "resolution_px": [32, 32]},
  "passes": {"reference": {"samples": 16, "bounces": 1}, "lines": {"ambient": 0}}})";

Result<scene::Scene> scene_from(const Json& inputs, const std::string& folder, const std::string& method) {
  CUTICLE_ASSIGN(Json text, Json::parse(k_usual_scene));
  text.update(inputs.value("scene", Json::object()));
  text["render"] = Json{{"method", method}};
  if (inputs.contains("groom")) {
    CUTICLE_TRY(strands::write_groom(folder + "/strands.npz", groom_from(inputs.at("groom"))));
    text["groom"] = Json{{"file", "strands.npz"}, {"metres_per_unit", 1}};
  }
  return scene::parse_scene(text.dump(), folder, "hard case", plan::catalogue());
}

double mean_of(const Image& image, int channel) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += double(image.at(x, y, channel));
  return sum / (double(image.width) * image.height);
}

Values extremes(const Image& image, int channel) {
  double least = std::numeric_limits<double>::max(), largest = -least;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      least = std::min(least, double(image.at(x, y, channel)));
      largest = std::max(largest, double(image.at(x, y, channel)));
    }
  return {least, largest};
}

constexpr int k_alpha = 3;

/// Where a pixel is not finite, its value alone: the case then fails and says so.
Values measured(const Image& color, const std::string& measure) {
  const auto broken = std::ranges::find_if(color.pixels, [](float value) { return !std::isfinite(value); });
  if (broken != color.pixels.end()) return {double(*broken)};
  if (measure == "coverage") return {mean_of(color, k_alpha)};
  if (measure == "alpha") return extremes(color, k_alpha);
  return {mean_of(color, 0), mean_of(color, 1), mean_of(color, 2)};
}

Result<Temporary> empty_folder() {
  CUTICLE_ASSIGN(const std::string parent, temporary_folder());
  return Temporary::folder(parent);
}

}  // namespace

Result<Values> run_drawing_f32(const Json& inputs, GpuSession*) {
  CUTICLE_ASSIGN(const Temporary folder, empty_folder());
  CUTICLE_ASSIGN(const scene::Scene scene, scene_from(inputs, folder.path(), "reference"));
  CUTICLE_ASSIGN(const auto runner, plan::TracedSceneRunner::create(scene, silent_progress()));
  CUTICLE_ASSIGN(const plan::TracedFrame frame, runner->run(0, silent_progress()));
  return measured(frame.color, inputs.at("measure").text());
}

#ifdef CUTICLE_HAS_GPU
Result<Values> run_drawing_gpu(const Json& inputs, GpuSession* session) {
  CUTICLE_ASSIGN(const Temporary folder, empty_folder());
  Values values;
  for (const Json& method : inputs.value("methods", Json::list({"tiles"}))) {
    CUTICLE_ASSIGN(const scene::Scene scene, scene_from(inputs, folder.path(), method.text()));
    CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(session->device, scene, silent_progress()));
    CUTICLE_ASSIGN(const plan::FrameResult frame, runner->run(0));
    const Values more = measured(frame.color, inputs.at("measure").text());
    values.insert(values.end(), more.begin(), more.end());
  }
  return values;
}
#endif

}  // namespace cuticle::hard_cases
