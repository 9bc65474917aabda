#include "cli/command.h"

#ifdef CUTICLE_HAS_GPU
#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "cli/at_rest.h"
#include "cli/run_folder.h"
#include "cli/skipped_frames.h"
#include "core/file.h"
#include "core/interrupt.h"
#include "core/json/json.h"
#include "plan/frame_runner_gpu.h"
#include "sim/telemetry.h"
#include "strands/formats/formats.h"
#include "strands/formats/vtp/vtp.h"
#include "viz/strands/collider_file.h"
#endif

namespace cuticle::cli {

#ifdef CUTICLE_HAS_GPU
namespace {

struct SimulateOptions {
  std::string scene, frames = "0:0", format = "vtp", out = "simulation";
  double max_gigabytes = 10;
  bool rest = false;
};

struct Formats {
  bool vtp = false, hair = false;
};
Result<Formats> parse_formats(const std::string& text) {
  Formats formats;
  for (const std::string& name : split_list(text)) {
    if (name == "vtp")
      formats.vtp = true;
    else if (name == "hair")
      formats.hair = true;
    else
      return usage_error(fmt::format("--format: '{}' is not known, allowed vtp, hair", name));
  }
  return formats;
}

/// Says how much will be written, and refuses past the bound or the free space.
Result<void> announce_size(const strands::Groom& groom, const Formats& formats, int frames,
                           const SimulateOptions& options, Progress& progress) {
  const std::size_t frame_bytes =
      (formats.vtp ? strands::vtp_bytes_at_most(groom) : 0) + (formats.hair ? strands::format_hair(groom).size() : 0);
  const double gigabytes = double(frame_bytes) * frames / 1e9;
  const double free = double(std::filesystem::space(options.out).available) / 1e9;
  progress.message(fmt::format("{} frame(s) will take at most {:.3f} GB in {}", frames, gigabytes, options.out));
  if (gigabytes > options.max_gigabytes)
    return usage_error(
        fmt::format("{:.2f} GB would be written, allowed {} (--max-gb)", gigabytes, options.max_gigabytes),
        "ask for fewer frames or raise --max-gb");
  if (gigabytes > free)
    return usage_error(
        fmt::format("{:.2f} GB would be written, {:.2f} GB are free in {}", gigabytes, free, options.out),
        "ask for fewer frames or another folder");
  return {};
}

/// What a run leaves beside the states. What is measured by the clock is kept apart: all else is the same in every run.
struct StateSeries {
  std::string telemetry = sim::telemetry_header(), timings = "frame,wall_ms\n";
  std::vector<strands::SeriesMember> members;
  viz::ColliderWriter colliders;
  double largest_stretch = 1, wall_ms = 0;
  std::uint32_t guards_fired = 0;
};

Result<void> write_state(const strands::Groom& rest, const plan::FrameResult& result, const Formats& formats,
                         const std::string& stem) {
  const sim::State& state = result.state;
  if (formats.vtp) {
    const std::vector<float> stretch = sim::stretch(rest, state.positions);
    const std::vector<float> curvature = sim::curvature(rest, state.positions);
    const std::vector<float> contact = sim::distances(result.colliders, state.positions);
    CUTICLE_TRY(
        write_text_file(stem + ".vtp", strands::format_vtp({&rest, state.positions, state.velocities, stretch,
                                                            state.tensions, curvature, contact, state.resets})));
  }
  if (!formats.hair) return {};
  strands::Groom moved = rest;
  moved.positions = state.positions;
  CUTICLE_ASSIGN([[maybe_unused]] const auto notes, strands::write_groom(stem + ".hair", moved));
  return {};
}

void add_frame(StateSeries& series, int frame, double time, const sim::Telemetry& telemetry, double wall_ms) {
  series.telemetry += sim::telemetry_row(frame, time, telemetry);
  series.timings += fmt::format("{},{}\n", frame, wall_ms);
  series.members.push_back({time, fmt::format("state_{:04d}.vtp", frame)});
  series.largest_stretch = std::max(series.largest_stretch, telemetry.largest_stretch);
  series.guards_fired += telemetry.guards_fired;
  series.wall_ms += wall_ms;
}

/// What belongs to all frames, and the list of the run's files.
Result<void> write_series(const StateSeries& series, const Formats& formats, bool is_complete, const std::string& out,
                          RunFolder& folder, Progress& progress) {
  if (formats.vtp) CUTICLE_TRY(write_text_file(out + "/states.pvd", strands::format_pvd(series.members)));
  if (formats.vtp && !series.colliders.empty())
    CUTICLE_TRY(write_text_file(out + "/colliders.json", series.colliders.text()));
  CUTICLE_TRY(write_text_file(out + "/telemetry.csv", series.telemetry));
  CUTICLE_TRY(write_text_file(out + "/timings.csv", series.timings));
  if (formats.vtp) folder.add("states.pvd");
  if (formats.vtp && !series.colliders.empty()) folder.add("colliders.json");
  for (const std::string& field : series.colliders.fields()) folder.add(field);
  folder.add("telemetry.csv");
  folder.add("timings.csv");
  return folder.finish("simulate", is_complete, progress);
}

Error interrupted(std::size_t done, std::pair<int, int> frames, const std::string& out) {
  return {ErrorKind::internal, fmt::format("interrupted after {} of {} frames", done, frames.second - frames.first + 1),
          fmt::format("what was done is whole, in {}", out)};
}

/// One frame, written. Error: also where numbers stopped being finite.
Result<void> run_frame(plan::FrameRunner& runner, const SimulateOptions& options, const Formats& formats, int frame,
                       double frames_per_second, StateSeries& series, RunFolder& folder) {
  const strands::Groom& rest = runner.control_groom();
  CUTICLE_ASSIGN(const plan::FrameResult result, runner.run(frame, {.render = false, .read_state = true}));
  CUTICLE_TRY(sim::check_finite(rest, result.state, frame));
  const std::string name = fmt::format("state_{:04d}", frame);
  CUTICLE_TRY(write_state(rest, result, formats, options.out + "/" + name));
  if (formats.vtp) CUTICLE_TRY(series.colliders.add(frame, result.colliders, result.head, options.out));
  if (formats.vtp) folder.add(name + ".vtp");
  if (formats.hair) folder.add(name + ".hair");
  add_frame(series, frame, frame / frames_per_second, sim::measure(rest, result.state), result.cost.wall_ms);
  return {};
}

/// Leaves the frames that are done also where one fails or an interrupt comes.
Result<StateSeries> run_frames(plan::FrameRunner& runner, const SimulateOptions& options, const Formats& formats,
                               std::pair<int, int> frames, const scene::Scene& scene, RunFolder& folder,
                               Progress& progress) {
  StateSeries series;
  const StopsBetweenSteps stop;
  Result<void> done = skip_to(runner, scene, frames.first, stop, progress);
  const std::size_t count = std::size_t(frames.second - frames.first) + 1;
  for (int frame = frames.first; done && frame <= frames.second && !stop.is_asked(); ++frame) {
    done = run_frame(runner, options, formats, frame, scene.frames_per_second, series, folder);
    if (done) progress.update("frames", series.members.size(), count);
  }
  const bool is_complete = series.members.size() == count;
  CUTICLE_TRY(write_series(series, formats, is_complete, options.out, folder, progress));
  if (!done) return done.error();
  if (!is_complete) return interrupted(series.members.size(), frames, options.out);
  return series;
}

void print(const StateSeries& series, const strands::Groom& rest, const std::string& folder, bool json) {
  const double frames = double(std::max<std::size_t>(1, series.members.size()));
  if (json) {
    const Json summary = {{"frames", series.members.size()},
                          {"control_strands", rest.strand_count()},
                          {"control_vertices", rest.vertex_count()},
                          {"max_stretch", series.largest_stretch},
                          {"guards_fired", series.guards_fired},
                          {"wall_ms_per_frame", series.wall_ms / frames},
                          {"folder", folder}};
    fmt::print("{}\n", summary.dump(2));
    return;
  }
  fmt::print("{} frame(s) of {} control hairs, {} vertices, in {}\n", series.members.size(), rest.strand_count(),
             rest.vertex_count(), folder);
  fmt::print("largest stretch {:.4f}, strands reset {}, {:.2f} ms of submitted work a frame\n", series.largest_stretch,
             series.guards_fired, series.wall_ms / frames);
}

Result<void> simulate(const SimulateOptions& options, Context& context, Trace* trace) {
  CUTICLE_ASSIGN(const auto frames, parse_frames(options.frames));
  CUTICLE_ASSIGN(const Formats formats, parse_formats(options.format));
  CUTICLE_ASSIGN(scene::Scene scene, scene::load_scene(options.scene, plan::catalogue()));
  scene.outputs.color = scene.outputs.aovs = false;  // states alone: nothing of a picture is made
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = context.device}));
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, *context.progress, trace));
  CUTICLE_ASSIGN(RunFolder folder, RunFolder::open(options.out));
  CUTICLE_TRY(
      announce_size(runner->control_groom(), formats, frames.second - frames.first + 1, options, *context.progress));
  CUTICLE_ASSIGN(const StateSeries series,
                 run_frames(*runner, options, formats, frames, scene, folder, *context.progress));
  print(series, runner->control_groom(), options.out, context.json);
  return {};
}

int act_at_rest(const SimulateOptions& options, Context& context) {
  const Result<Formats> formats = parse_formats(options.format);
  if (!formats) return report(formats.error());
  return simulate_at_rest({options.scene, options.out, formats->vtp, formats->hair}, context);
}

int act(const SimulateOptions& options, Context& context) {
  if (options.rest) return act_at_rest(options, context);
  Trace trace;
  const bool tracing = !context.trace_file.empty();
  if (const auto done = simulate(options, context, tracing ? &trace : nullptr); !done) return report(done.error());
  if (!tracing) return Exit::ok;
  const auto written = trace.write(context.trace_file);
  return written ? int(Exit::ok) : report(written.error());
}

}  // namespace

void add_simulate(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "simulate", "simulate a scene's control hairs; write their states frame by frame, and telemetry.csv");
  auto options = std::make_shared<SimulateOptions>();
  command->add_option("scene", options->scene, "scene file (JSON)")->required();
  command->add_option("--frames", options->frames, "first:last, or one frame (default 0)");
  command
      ->add_flag(
          "--rest", options->rest,
          "no frames: the equilibrium of rods under gravity and colliders, in the head's rest space, by Newton's "
          "method; rest.csv has residual, steps and stiffening of each strand")
      ->excludes("--frames");
  command->add_option("--format", options->format, "vtp (with states.pvd), hair, or both: vtp,hair");
  command->add_option("--out", options->out, "folder to write (default: simulation)");
  command->add_option("--max-gb", options->max_gigabytes, "gigabytes to write, at most")->check(CLI::Range(0.0, 1e6));
  command->callback([&context, options] { context.action = [&context, options] { return act(*options, context); }; });
}
#else
void add_simulate(CLI::App&, Context&) {}
#endif

}  // namespace cuticle::cli
