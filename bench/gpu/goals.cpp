// The goals for a GPU (README.md beside this file): bench_gpu [share] [folder]. Prints for each goal the least time by
// the device's timestamps and by the clock, beside what was asked for, and every pass of a frame; then frames whose
// tiles are drawn by other numbers of invocations than suit the device, and how far their pictures are apart. A share
// below 1 makes all sizes smaller, to try the program on software Vulkan. Into a folder it writes the two pictures.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <span>

#include <fmt/core.h>

#include "core/image/image.h"
#include "lut/bake_gpu.h"
#include "plan/frame_runner_gpu.h"
#include "plan/plan.h"
#include "render/passes/tile_lists/tile_lists_gpu.h"
#include "sim/solver_gpu.h"
#include "strands/spline/smooth_gpu.h"

namespace {

using namespace cuticle;

constexpr int k_frames = 30;

struct Times {
  double device_ms = 1e30, wall_ms = 1e30;
  std::vector<gpu::PassCost> passes;  ///< of the quickest by the device's clock
};

double device_ms(std::span<const gpu::PassCost> passes) {
  return std::accumulate(passes.begin(), passes.end(), 0.0,
                         [](double sum, const auto& pass) { return sum + pass.gpu_ms; });
}

void keep_least(const gpu::SubmitCost& cost, Times& least) {
  least.wall_ms = std::min(least.wall_ms, cost.wall_ms);
  const double now = device_ms(cost.passes);
  if (now >= least.device_ms) return;
  least.device_ms = now;
  least.passes = cost.passes;
}

void print(const std::string& goal, double asked_ms, const Times& times) {
  fmt::print("{:<60} asked {:>4} ms: {:8.3f} ms on the device, {:8.3f} by the clock, {}\n", goal, asked_ms,
             times.device_ms, times.wall_ms, times.device_ms <= asked_ms ? "met" : "missed");
  if (times.passes.size() > 1)
    for (const gpu::PassCost& pass : times.passes) fmt::print("    {:<22} {:8.3f} ms\n", pass.name, pass.gpu_ms);
  std::fflush(stdout);
}

/// A frame of the procedural head by `tiles`, or by `method`, with one light and a deep opacity map. `lanes`: of a
/// tile.
struct FrameGoal {
  std::string name, method;
  int strands, vertices;
  glm::ivec2 size;
  double asked_ms;
  int lanes = 0;
};

Result<scene::Scene> scene_of(const FrameGoal& goal, double share) {
  const std::string text = fmt::format(
      R"({{"schema_version": 1, "strand_count": {}, "strand_vertices": {}, "fibre_count": {},
          "material": {{"model": {{"marschner": {{"sigma_a": [0.5447, 0.9061, 1.781]}}}}, "lut_size": 128}},
          "lights": [{{"to_light": [0.6, 0.9, 0.8], "irradiance": [15, 14.2, 13]}}],
          "shadow": {{"method": {{"deep_opacity": {{"layers": 8, "resolution": 512}}}}, "fibre_alpha": 0.4}},
          "render": {{"method": "{}"}}, "passes": {{"tile_lists": {{"lanes": {}}}}},
          "camera": {{"position_m": [0.42, 0.2, 1.0], "target_m": [0, 0.06, 0], "fov_deg": 27, "near_m": 0.2, "far_m": 5,
                     "resolution_px": [{}, {}]}}}})",
      std::max(100, int(goal.strands * share)), goal.vertices, std::max(100, int(goal.strands * share)), goal.method,
      goal.lanes, goal.size.x, goal.size.y);
  return scene::parse_scene(text, ".", "bench_gpu", plan::catalogue());
}

std::string name_of(const gpu::Device& device, const FrameGoal& goal, const scene::Scene& scene) {
  if (goal.method != "tiles") return goal.name;
  return fmt::format("{}, {} a tile", goal.name, render::tile_lists::lanes_of(device.info(), scene.passes));
}

double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k) sum += std::abs(double(a.pixels[k]) - double(b.pixels[k]));
  return sum / double(a.pixels.size());
}

/// `picture`: the first frame's; where there is one already, how far apart they are is printed.
Result<void> time_frame(const std::shared_ptr<gpu::Device>& device, const FrameGoal& goal, double share,
                        const char* folder, Image& picture) {
  CUTICLE_ASSIGN(const scene::Scene scene, scene_of(goal, share));
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, silent_progress()));
  Times times;
  for (int k = 0; k < (share < 1 ? 2 : k_frames); ++k) {
    CUTICLE_ASSIGN(const plan::FrameResult frame, runner->run(0, {.everything = true}));
    keep_least(frame.cost, times);
    if (k > 0) continue;
    for (const std::string& note : frame.notes) fmt::print("    {}\n", note);
    if (!picture.pixels.empty())
      fmt::print("    mean difference from the picture of before: {:.3g}\n", mean_difference(frame.color, picture));
    picture = frame.color;
    if (folder && goal.lanes == 0)
      CUTICLE_TRY(write_exr(fmt::format("{}/{}_{}.exr", folder, goal.method, goal.size.y), frame.color, ExrType::half));
  }
  print(name_of(*device, goal, scene), goal.asked_ms, times);
  return {};
}

/// Frames for a second before anything is measured: on an H200 the first frame of a run took 10.0 ms, the same one
/// later 7.1.
Result<void> warm_up(const std::shared_ptr<gpu::Device>& device, const FrameGoal& goal) {
  CUTICLE_ASSIGN(const scene::Scene scene, scene_of(goal, 1));
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, silent_progress()));
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < std::chrono::seconds(1)) {
    CUTICLE_TRY(runner->run(0, {.everything = true}));
  }
  return {};
}

strands::Groom straight_strands(int count, int vertices) {
  strands::Groom groom;
  for (int s = 0; s < count; ++s) {
    const float angle = 0.001f * float(s);
    for (int i = 0; i < vertices; ++i)
      groom.positions.push_back(glm::vec3(std::cos(angle), 0, std::sin(angle)) *
                                (0.3f * float(i) / float(vertices - 1)));
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  return groom;
}

registry::ParameterValues values_of(const std::string& effect, const std::string& settings) {
  return registry::parse_assignments((*sim::find_effect(effect))->entry.parameters, settings).value();
}

/// A frame of 1/60 s of 100,000 strands of 32 vertices under gravity.
Result<void> time_solver(const std::shared_ptr<gpu::Device>& device, const std::string& name,
                         const std::string& settings, double asked_ms, double share) {
  const strands::Groom groom = straight_strands(std::max(100, int(100'000 * share)), 32);
  CUTICLE_ASSIGN(const auto solver, (*sim::find_gpu_effect(name))
                                        ->create(device, groom, values_of(name, settings),
                                                 sim::EffectBlocks{{"gravity", values_of("gravity", "")}}));
  Times times;
  for (int k = 0; k < (share < 1 ? 2 : k_frames); ++k) {
    gpu::Commands commands = device->record();
    commands.begin_pass(name);
    CUTICLE_TRY(solver->record(commands, {}));
    commands.end_pass();
    CUTICLE_ASSIGN(const gpu::SubmitCost cost, device->submit(std::move(commands)));
    keep_least(cost, times);
  }
  print(fmt::format("{}, {} x 32, a frame of 1/60 s ({})", name, groom.strand_count(), settings), asked_ms, times);
  return {};
}

Result<void> time_tables(gpu::Device& device) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  Times times;
  CUTICLE_ASSIGN(const lut::Layout* const layout, lut::find_layout("nalu"));
  CUTICLE_ASSIGN(const auto brown, bsdf::parse_settings(model, "", "sigma_a=0.5"));
  CUTICLE_ASSIGN(const auto black, bsdf::parse_settings(model, "", "sigma_a=2"));
  lut::DeviceBaker baker(device, model, *layout, 128);
  for (int k = 0; k < k_frames; ++k) {
    CUTICLE_TRY(baker.bake(k % 2 ? brown : black));
    keep_least(baker.last_cost(), times);
  }
  print("tables of marschner, 128 x 128, layout nalu", 0.2, times);
  return {};
}

/// Strands of 36 vertices from 10,000 guides of 7: smoothed, then interpolated.
Result<void> time_generation(const std::shared_ptr<gpu::Device>& device, double share) {
  const strands::Groom guides = straight_strands(10'000, 7);
  const std::size_t count = std::max<std::size_t>(100, std::size_t(200'000 * share));
  std::vector<std::array<std::uint32_t, 3>> hairs(count);
  const std::vector<glm::vec3> weights(count, glm::vec3(0.5f, 0.3f, 0.2f));
  for (std::uint32_t s = 0; s < count; ++s) hairs[s] = {s % 9998, s % 9998 + 1, s % 9998 + 2};
  CUTICLE_ASSIGN(const auto strands,
                 strands::StrandGenerator::create(
                     device, {.control = &guides, .vertices_per_strand = 36, .hairs = hairs, .weights = weights}));
  std::vector<glm::vec4> places;
  for (const glm::vec3& place : guides.positions) places.emplace_back(place, 0);
  CUTICLE_ASSIGN(const gpu::Buffer buffer, gpu::make_buffer_from<glm::vec4>(*device, places));
  Times times;
  for (int k = 0; k < k_frames; ++k) {
    gpu::Commands commands = device->record();
    commands.begin_pass("generate");
    CUTICLE_TRY(strands->record_smooth(commands, buffer));
    CUTICLE_TRY(strands->record_interpolate(commands));
    commands.end_pass();
    CUTICLE_ASSIGN(const gpu::SubmitCost cost, device->submit(std::move(commands)));
    keep_least(cost, times);
  }
  print(fmt::format("{} strands x 36 generated", count), 1, times);
  return {};
}

Result<void> time_all(double share, const char* folder) {
  CUTICLE_ASSIGN(const auto device, gpu::Device::open());
  const gpu::DeviceInfo& info = device->info();
  fmt::print("{}, {}, Vulkan {}, subgroups of {}\n", info.name, info.driver, info.api_version, info.subgroup_size);
  const FrameGoal frames[] = {{"tiles, 136,000 strands x 16, 1280 x 720", "tiles", 136'000, 16, {1280, 720}, 2},
                              {"lines, 136,000 strands x 16, 1280 x 720", "lines", 136'000, 16, {1280, 720}, 2},
                              {"tiles, 200,000 strands x 36, 3840 x 2160", "tiles", 200'000, 36, {3840, 2160}, 6},
                              {"lines, 200,000 strands x 36, 3840 x 2160", "lines", 200'000, 36, {3840, 2160}, 6}};
  if (share >= 1) CUTICLE_TRY(warm_up(device, frames[0]));
  Result<void> done = time_tables(*device);
  const auto then = [&](Result<void> next) {
    if (!next) fmt::print("{}\n", next.error().message);
    if (done) done = std::move(next);
  };
  then(time_generation(device, share));
  then(time_solver(device, "exact", "damping=0,shape_stiffness=0,clamped_vertices=1,inner_step=0.00417,max_substeps=4",
                   0.5, share));
  then(time_solver(device, "rod", "damping=0,inner_step=0.00209,max_substeps=8", 2, share));
  for (const FrameGoal& goal : frames) {
    Image picture;
    then(time_frame(device, goal, share, folder, picture));
  }
  for (const FrameGoal& goal : {frames[0], frames[2]}) {
    Image picture;
    for (int lanes : {64, 32, 8}) {
      FrameGoal by_lanes = goal;
      by_lanes.lanes = lanes;
      then(time_frame(device, by_lanes, share, folder, picture));
    }
  }
  return done;
}

}  // namespace

int main(int argc, char** argv) {
  const Result<void> done = time_all(argc > 1 ? std::atof(argv[1]) : 1, argc > 2 ? argv[2] : nullptr);
  if (!done) fmt::print("{}\n", done.error().message);
  return done ? 0 : 1;
}
