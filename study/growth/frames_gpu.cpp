#include <fmt/core.h>

#include "plan/frame_runner_gpu.h"
#include "shadows/groom_gpu.h"
#include "study/growth/measured.h"

namespace cuticle::study {
namespace {

constexpr int k_drawn_vertices = 16;  ///< of a strand

Result<scene::Scene> demo_head(const GrowthRequest& request, int strands) {
  const std::string text = fmt::format(
      R"({{"schema_version": 1, "strand_count": {}, "strand_vertices": {}, "material": {{"lut_size": 64}},
          "render": {{"method": "tiles"}}, "shadow": {{"method": {{"deep_opacity": {{}}}}}},
          "lights": [{{"to_light": [0.6, 0.9, 0.8], "irradiance": [15, 14.2, 13]}},
                     {{"to_light": [-0.8, 0.5, -0.4], "irradiance": [4, 4.5, 5]}}],
          "camera": {{"position_m": [0.42, 0.2, 1.0], "target_m": [0, 0.06, 0], "fov_deg": 27, "near_m": 0.2,
                      "far_m": 5, "resolution_px": [{}, {}]}}}})",
      strands, k_drawn_vertices, request.width, request.height);
  return scene::parse_scene(text, request.share + "/scenes", "study growth", plan::catalogue());
}

/// The quickest frame after one that is not counted, and the least processor time of one.
struct Quickest {
  plan::FrameResult frame;
  double processor = 1e30;
};
Result<Quickest> quickest_frame(const std::shared_ptr<gpu::Device>& device, const GrowthRequest& request, int strands) {
  CUTICLE_ASSIGN(const scene::Scene scene, demo_head(request, strands));
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, silent_progress()));
  Quickest best;
  for (int k = 0; k <= request.frames; ++k) {
    const double start = processor_seconds();
    CUTICLE_ASSIGN(plan::FrameResult frame, runner->run(k, {.everything = true}));
    if (k == 0) continue;
    const double seconds = processor_seconds() - start;
    best.processor = std::min(best.processor, seconds);
    if (k == 1 || frame.cost.wall_ms < best.frame.cost.wall_ms) best.frame = std::move(frame);
    if (seconds > k_slow) break;
  }
  return best;
}

void add_frame(Group& group, const Quickest& best, int strands) {
  double sum = 0;
  for (const gpu::PassCost& pass : best.frame.cost.passes) {
    add_time(group, pass.name, strands, 1e-3 * pass.gpu_ms);
    sum += pass.gpu_ms;
  }
  add_time(group, "all passes", strands, 1e-3 * sum);
  add_time(group, "submissions", strands, 1e-3 * best.frame.cost.wall_ms);
  add_time(group, "read back", strands, 1e-3 * best.frame.read_back_ms);
  add_time(group, "clock", strands, 1e-3 * best.frame.clock_ms);
  add_time(group, "processor", strands, best.processor);
}

double seconds_of(const gpu::Device& device, const gpu::SubmitCost& cost, double processor) {
  return device.info().is_software ? processor : 1e-3 * cost.wall_ms;
}

/// The least time of a map and its lookups; the first submissions make what room it needs.
Result<double> shadow_seconds(gpu::Device& device, shadows::GpuShadow& shadow, const shadows::GroomOnDevice& groom,
                              int submissions) {
  const auto submit = [&]() -> Result<double> {
    const double start = processor_seconds();
    gpu::Commands commands = device.record();
    CUTICLE_TRY(shadow.record(commands, groom.strands, 0.4, {glm::dvec3(0.48, 0.72, 0.5)}, groom.transmittance));
    CUTICLE_ASSIGN(const gpu::SubmitCost cost, device.submit(std::move(commands)));
    return seconds_of(device, cost, processor_seconds() - start);
  };
  for (bool holds = false; !holds;) {
    CUTICLE_TRY(submit());
    CUTICLE_ASSIGN(const shadows::MapRoom room, shadow.settle());
    holds = room.holds;
  }
  double best = 1e30;
  for (int k = 0; k < submissions; ++k) {
    const double start = processor_seconds();
    CUTICLE_ASSIGN(const double seconds, submit());
    best = std::min(best, seconds);
    if (processor_seconds() - start > k_slow) break;
  }
  return best;
}

Result<double> time_method(const std::shared_ptr<gpu::Device>& device, const shadows::GpuMethod& method,
                           const shadows::GroomOnDevice& groom, int submissions) {
  CUTICLE_ASSIGN(const shadows::Method* entry, shadows::find_method(method.name));
  CUTICLE_ASSIGN(const auto shadow, method.create(device, registry::default_values(entry->entry.parameters)));
  return shadow_seconds(*device, *shadow, groom, submissions);
}

}  // namespace

Result<Group> frame_growth(const std::shared_ptr<gpu::Device>& device, const GrowthRequest& request,
                           Progress& progress) {
  Group group = group_of_times("frame", "A frame by tiles: its passes, by the clock");
  for (const int strands : request.strands) {
    progress.message(fmt::format("a frame of {} strands", strands));
    const auto best = quickest_frame(device, request, strands);
    best ? add_frame(group, *best, strands) : note_refusal(request, "a frame", strands, best.error());
  }
  return group;
}

Result<Group> shadow_growth(const std::shared_ptr<gpu::Device>& device, const GrowthRequest& request,
                            Progress& progress) {
  Group group = group_of_times("shadows", "Shadow methods: a map and its lookups at all vertices");
  for (const int strands : request.strands) {
    const auto groom = shadows::upload_groom(*device, ball_of_hair(strands, k_drawn_vertices));
    if (!groom) {
      note_refusal(request, "shadows", strands, groom.error());
      continue;
    }
    for (const shadows::GpuMethod* method : shadows::gpu_methods()) {
      progress.message(fmt::format("{} of {} strands", method->name, strands));
      const auto seconds = time_method(device, *method, **groom, request.frames);
      seconds ? add_time(group, std::string(method->name), strands, *seconds)
              : note_refusal(request, method->name, strands, seconds.error());
    }
  }
  return group;
}

}  // namespace cuticle::study
