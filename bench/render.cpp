// What a picture of hair costs (CUTICLE_DEVICE chooses the device): bench_render [GROOM] [bench/reference.json] [tiles]
// [parts=N]. GROOM: the ponytail of TressFX (a .tfxproj), drawn with four followers a guide at 1280 x 720, Marschner by
// tables, deep opacity shadows and the scene's depth, by each method, with light at N places along each segment
// (groom.segment_parts): best of some frames by wall clock and by processor time, each pass's best by timestamps, device
// memory. Then growth: wall time of 'tiles' from 1,000 to 1,000,000 strands of the procedural head at 640 x 640, of 16
// vertices. With the word tiles only the first of these.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <span>
#include <string_view>

#include <fmt/core.h>

#include "plan/frame_runner_gpu.h"

#include "bench/calibration.h"

namespace {

using namespace cuticle;

constexpr int k_frames = 10;  ///< of 'tiles'; the others take seconds on software Vulkan
constexpr int k_frames_of_others = 2;

/// The least that one of some frames took, for the whole and for each pass.
struct Best {
  gpu::SubmitCost cost{1e30, {}, {}};
  double processor_ms = 1e30;  ///< of all threads, with reading the picture back: the fairer number on a busy machine
  double resident_mib = 0, peak_mib = 0;
  std::vector<std::string> notes;
};

void keep_least(const gpu::SubmitCost& cost, gpu::SubmitCost& least) {
  if (least.passes.empty()) least.passes = cost.passes;
  least.wall_ms = std::min(least.wall_ms, cost.wall_ms);
  for (std::size_t k = 0; k < least.passes.size(); ++k)
    least.passes[k].gpu_ms = std::min(least.passes[k].gpu_ms, cost.passes[k].gpu_ms);
}

Result<Best> best_frame(const scene::Scene& scene, int frames) {
  CUTICLE_ASSIGN(const auto device, gpu::Device::open());
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, silent_progress()));
  Best best;
  for (int k = 0; k < frames; ++k) {
    const std::clock_t start = std::clock();
    CUTICLE_ASSIGN(plan::FrameResult frame, runner->run(0, {.everything = true}));
    best.processor_ms = std::min(best.processor_ms, 1e3 * double(std::clock() - start) / CLOCKS_PER_SEC);
    keep_least(frame.cost, best.cost);
    best.notes = std::move(frame.notes);
  }
  best.resident_mib = double(device->allocated_bytes()) / (1 << 20);
  best.peak_mib = double(device->peak_allocated_bytes()) / (1 << 20);
  return best;
}

/// `parts` as the scene is to read it, which refuses what is no number of parts.
Result<scene::Scene> ponytail(const std::string& groom, std::string_view parts) {
  const std::string text = fmt::format(
      R"({{"schema_version": 1, "groom": {{"file": "{}", "metres_per_unit": 0.01, "segment_parts": {}}}, "strand_count": 24665,
          "strand_vertices": 16, "fibre_count": 352000,
          "material": {{"model": {{"marschner": {{"sigma_a": [0.5447, 0.9061, 1.781]}}}}, "lut_size": 128}},
          "lights": [{{"to_light": [1, 2, 1], "irradiance": [12, 12, 12]}}],
          "shadow": {{"method": {{"deep_opacity": {{"layers": 8, "resolution": 512}}}}, "fibre_alpha": 0.4}},
          "camera": {{"position_m": [0.02, 0.8, 2.26], "target_m": [0.02, 0.8, 0], "fov_deg": 25, "near_m": 0.2,
                      "far_m": 10, "resolution_px": [1280, 720]}}, "passes": {{"tiles": {{"opacity": 0.4}}}}}})",
      groom, parts);
  return scene::parse_scene(text, ".", "bench_render", plan::catalogue());
}

void print(std::string_view method, int frames, const Best& best, double scale) {
  fmt::print("{:<6} {:8.1f} ms, best of {}, scaled {:8.1f}; {:8.1f} ms of all threads; {:.0f} MiB, at most {:.0f}\n",
             method, best.cost.wall_ms, frames, best.cost.wall_ms / scale, best.processor_ms, best.resident_mib,
             best.peak_mib);
  for (const gpu::PassCost& pass : best.cost.passes) fmt::print("    {:<20} {:8.2f} ms\n", pass.name, pass.gpu_ms);
  for (const std::string& note : best.notes) fmt::print("    {}\n", note);
  std::fflush(stdout);
}

Result<void> time_ponytail(const std::string& groom, std::string_view parts, double scale,
                           std::span<const std::string_view> methods) {
  CUTICLE_ASSIGN(scene::Scene scene, ponytail(groom, parts));
  fmt::print("{}: {} strands x {}, 1280 x 720\n", groom, scene.strand_count, scene.strand_vertices);
  for (std::string_view method : methods) {
    scene.render_method = method;
    const int frames = method == "tiles" ? k_frames : k_frames_of_others;
    CUTICLE_ASSIGN(const Best best, best_frame(scene, frames));
    print(method, frames, best, scale);
  }
  return {};
}

Result<void> time_growth(double scale) {
  constexpr std::string_view k_text =
      R"({"schema_version": 1, "strand_vertices": 16, "material": {"lut_size": 64}, "render": {"method": "tiles"},
          "lights": [{"to_light": [0.6, 0.9, 0.8], "irradiance": [15, 14.2, 13]}],
          "camera": {"position_m": [0.42, 0.2, 1.0], "target_m": [0, 0.06, 0], "fov_deg": 27, "near_m": 0.2, "far_m": 5,
                     "resolution_px": [640, 640]}})";
  CUTICLE_ASSIGN(scene::Scene scene, scene::parse_scene(k_text, ".", "bench_render", plan::catalogue()));
  fmt::print("tiles, 640 x 640, strands of 16 vertices:\n{:>10} {:>10} {:>10} {:>15} {:>8}\n", "strands", "ms", "scaled",
             "all threads, ms", "MiB");
  for (int strands : {1000, 10000, 100000, 1000000}) {
    scene.strand_count = strands;
    CUTICLE_ASSIGN(const Best best, best_frame(scene, 3));
    fmt::print("{:>10} {:>10.1f} {:>10.1f} {:>15.1f} {:>8.0f}\n", strands, best.cost.wall_ms, best.cost.wall_ms / scale,
               best.processor_ms, best.peak_mib);
    for (const std::string& note : best.notes) fmt::print("    {}\n", note);
    std::fflush(stdout);
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::string_view k_methods[] = {"tiles", "quads", "lines"};
  std::string groom, reference;
  bool all = true;
  std::string_view parts = "0";  // as many as the program finds fit
  for (const std::string_view argument : std::span(argv, std::size_t(argc)).subspan(1)) {
    if (argument == k_methods[0])
      all = false;
    else if (argument.starts_with("parts="))
      parts = argument.substr(6);
    else
      (argument.ends_with(".json") ? reference : groom) = argument;
  }
  const double scale = reference.empty() ? 1 : bench::machine_scale(reference);
  fmt::print("this machine takes {:.2f} times as long as the reference\n", scale);
  Result<void> done;
  if (!groom.empty()) done = time_ponytail(groom, parts, scale, std::span(k_methods).first(all ? 3 : 1));
  if (done && all) done = time_growth(scale);
  if (!done) fmt::print("{}\n", done.error().message);
  return done ? 0 : 1;
}
