#include "cli/command.h"
#include "cli/model_options.h"

#ifdef CUTICLE_HAS_GPU
#include <algorithm>
#include <optional>

#include <fmt/core.h>

#include "cli/plan_on_device.h"
#include "cli/render_files.h"
#include "cli/run_folder.h"
#include "cli/skipped_frames.h"
#include "core/interrupt.h"
#include "core/json/json.h"
#include "core/registry/former_names.h"
#include "plan/frame_runner_gpu.h"
#include "plan/told_strands.h"
#include "render/passes/reference/reference_entry.h"
#include "render/passes/velocity/velocity.h"
#endif

namespace cuticle::cli {

#ifdef CUTICLE_HAS_GPU
namespace {

struct RenderOptions {
  std::string scene, frames = "0:0", method, out = "render";
  bool aovs = false, velocity = false, deep = false, cryptomatte = false;
  std::optional<std::int64_t> samples, bounces;
  std::optional<double> max_error;
  std::string state;
  std::vector<std::string> match;
  ParameterRequest parameters;
  std::vector<int> size;
};

/// Sums over the frames, per pass.
struct Costs {
  std::vector<gpu::PassCost> passes;
  std::vector<gpu::FragmentCount> fragments;
  double wall_ms = 0, read_back_ms = 0;
  int frames = 0;

  void add(const gpu::SubmitCost& cost, double read_back) {
    wall_ms += cost.wall_ms;
    read_back_ms += read_back;
    ++frames;
    for (const gpu::PassCost& pass : cost.passes) {
      auto found = std::ranges::find(passes, pass.name, &gpu::PassCost::name);
      if (found == passes.end()) found = passes.insert(found, {.name = pass.name});
      found->gpu_ms += pass.gpu_ms;
      found->dispatches += pass.dispatches;
      found->draws += pass.draws;
    }
    for (const gpu::FragmentCount& count : cost.fragments) {
      const auto found = std::ranges::find(fragments, count.name, &gpu::FragmentCount::name);
      if (found == fragments.end())
        fragments.push_back(count);
      else
        found->invocations += count.invocations;
    }
  }
};

/// H19: what becomes of a frame's timestamps: simulation, generation of the drawn strands, and the picture.
struct CostSplit {
  double simulate = 0, generate = 0, render = 0;
  double sum() const { return simulate + generate + render; }
};
CostSplit split_of(const Costs& costs, const plan::Plan& plan) {
  CostSplit split;
  for (const gpu::PassCost& pass : costs.passes) {
    const plan::PlannedPass* planned = plan::find_pass(plan, pass.name);
    const registry::Stage stage = planned ? planned->entry->stage : registry::Stage::simulate;
    const double ms = pass.gpu_ms / costs.frames;
    (stage <= registry::Stage::simulate   ? split.simulate
     : stage == registry::Stage::generate ? split.generate
                                          : split.render) += ms;
  }
  return split;
}

void print_text(const Costs& costs, const CostSplit& split, const std::string& device) {
  fmt::print("{} frame(s) on {}: {:.1f} ms of submitted work a frame by wall clock, {:.1f} ms to read pictures back\n",
             costs.frames, device, costs.wall_ms / costs.frames, costs.read_back_ms / costs.frames);
  fmt::print("{:<20} {:>10} {:>6} {:>15}   (each a frame)\n", "pass", "dispatches", "draws", "timestamps, ms");
  for (const gpu::PassCost& pass : costs.passes)
    fmt::print("{:<20} {:>10g} {:>6g} {:>15.3f}\n", pass.name, double(pass.dispatches) / costs.frames,
               double(pass.draws) / costs.frames, pass.gpu_ms / costs.frames);
  for (const gpu::FragmentCount& count : costs.fragments)
    fmt::print("{:<20} {:>17.0f} fragments covered\n", count.name, double(count.invocations) / costs.frames);
  const double percent = 100 / std::max(split.sum(), 1e-9);
  fmt::print("simulate {:.2f} ms ({:.0f} %), generate {:.2f} ms ({:.0f} %), render {:.2f} ms ({:.0f} %)\n",
             split.simulate, percent * split.simulate, split.generate, percent * split.generate, split.render,
             percent * split.render);
}

void print_json(const Costs& costs, const CostSplit& split, const std::string& device) {
  Json passes = Json::list();
  for (const gpu::PassCost& pass : costs.passes)
    passes.push_back({{"name", pass.name},
                      {"dispatches_per_frame", double(pass.dispatches) / costs.frames},
                      {"draws_per_frame", double(pass.draws) / costs.frames},
                      {"timestamp_ms_per_frame", pass.gpu_ms / costs.frames}});
  Json fragments = Json::object();
  for (const gpu::FragmentCount& count : costs.fragments)
    fragments[count.name] = double(count.invocations) / costs.frames;
  const Json json = {
      {"device", device},
      {"frames", costs.frames},
      {"wall_ms_per_frame", costs.wall_ms / costs.frames},
      {"read_back_ms_per_frame", costs.read_back_ms / costs.frames},
      {"split_ms", {{"simulate", split.simulate}, {"generate", split.generate}, {"render", split.render}}},
      {"passes", passes},
      {"fragments_per_frame", fragments}};
  fmt::print("{}\n", json.dump(2));
}

Result<void> render_frame(const RenderOptions& options, plan::FrameRunner& runner, const scene::Scene& scene, int frame,
                          Progress& progress, RunFolder& folder, Costs& costs) {
  const std::string state = options.state.empty() ? std::string() : fmt::format("{}.{:04d}", options.state, frame);
  CUTICLE_ASSIGN(plan::FrameResult result, runner.run(frame, {.path_state = state, .progress = &progress}));
  for (const std::string& note : result.notes) progress.message(note);
  CUTICLE_ASSIGN(const std::vector<std::string> files, write_frame(options.out, frame, result, scene));
  costs.add(result.cost, result.read_back_ms);
  for (const std::string& file : files) folder.add(file);
  return {};
}

/// Leaves the frames that are done also where one fails or an interrupt comes.
Result<Costs> render(const RenderOptions& options, gpu::Device& device, plan::FrameRunner& runner,
                     const scene::Scene& scene, Progress& progress, std::pair<int, int> frames, RunFolder& folder) {
  Costs costs;
  const StopsBetweenSteps stop;
  Result<void> done = skip_to(runner, scene, frames.first, stop, progress);
  const int count = frames.second - frames.first + 1;
  for (int frame = frames.first; done && frame <= frames.second && !stop.is_asked(); ++frame) {
    done = render_frame(options, runner, scene, frame, progress, folder, costs);
    if (done) progress.update("frames", std::size_t(costs.frames), std::size_t(count));
  }
  CUTICLE_TRY(folder.finish("render", costs.frames == count, progress));
  if (!done) return done.error();
  if (costs.frames < count)
    return Error{ErrorKind::internal, fmt::format("interrupted after {} of {} frames", costs.frames, count),
                 fmt::format("what was done is whole, in {}", options.out)};
  progress.message(
      fmt::format("most device memory at once: {:.1f} MiB", double(device.peak_allocated_bytes()) / (1 << 20)));
  return costs;
}

/// Whether the scene or an option asks for what this pass makes.
bool asks_for(const scene::Scene& scene, const plan::Plan& plan, std::string_view pass) {
  if (pass == "aovs") return scene.outputs.aovs;
  if (pass == "velocity") return scene.passes.contains(pass);
  const auto fact = plan.facts.find(pass);
  return fact != plan.facts.end() && fact->second.holds;
}

/// What is asked for and this way of drawing strands does not do.
void tell_left_out(const scene::Scene& scene, const plan::Plan& plan, Progress& progress) {
  for (const plan::LeftOut& left : plan.left_out)
    if (asks_for(scene, plan, left.entry->name))
      progress.message(fmt::format("{}: asked for, but left out: {}; strands are drawn by '{}'", left.entry->name,
                                   left.reason, scene.render_method));
}

/// One item of --match as a parameter of the pass 'reference'. Errors: usage.
Result<void> add_restriction(std::string_view restriction, registry::ParameterTable table,
                             registry::ParameterValues& values) {
  constexpr std::string_view k_shadow = "shadow=";
  if (restriction == "far_field") {
    values.set("field", std::string("far"));
  } else if (restriction == "single_scattering") {
    values.set("bounces", std::int64_t(1));
  } else if (restriction == "tables" || restriction == "dual_scattering") {
    values.set(restriction, true);
  } else if (restriction.starts_with(k_shadow)) {
    CUTICLE_ASSIGN(const registry::Parameter* shadow, registry::find_parameter(table, "shadow"));
    CUTICLE_ASSIGN(registry::Value method, registry::parse_value(*shadow, restriction.substr(k_shadow.size())));
    values.set("shadow", std::move(method));
  } else {
    return usage_error(fmt::format("--match {}: not one of far_field, single_scattering, tables, dual_scattering, shadow=METHOD",
                                   restriction),
                       "cuticle methods lists the shadow methods");
  }
  return {};
}

/// The options that only paths know, as parameters of the pass 'reference'.
Result<void> set_path_options(const RenderOptions& options, scene::Scene& scene) {
  const bool asks = options.samples || options.bounces || options.max_error || !options.state.empty() || !options.match.empty();
  if (asks && scene.render_method != "reference")
    return usage_error(fmt::format("--samples, --bounces, --max-error, --match and --state are of the method 'reference', and "
                                   "strands are drawn by '{}'",
                                   scene.render_method),
                       "add --method reference");
  const registry::ParameterTable table = render::reference::entry().entry.parameters;
  auto& values = scene.passes.try_emplace("reference", registry::default_values(table)).first->second;
  if (options.samples) values.set("samples", *options.samples);
  if (options.bounces) values.set("bounces", *options.bounces);
  if (options.max_error) values.set("max_error", *options.max_error);
  for (const std::string& restriction : options.match) CUTICLE_TRY(add_restriction(restriction, table, values));
  return {};
}

/// "name=value,name=value", as --set takes them.
std::string settings_text(const registry::ParameterValues& values) {
  std::string text;
  for (const auto& [name, value] : values.all())
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", name, registry::to_text(value));
  return text;
}

/// What options say in place of the scene: the hair's parameters, the size of the picture.
Result<void> set_scene_options(const RenderOptions& options, scene::Scene& scene) {
  if (!options.method.empty()) scene.render_method = options.method;
  if (options.size.size() == 2) scene.camera.camera.resolution = {options.size[0], options.size[1]};
  const ParameterRequest& asked = options.parameters;
  if (asked.hair.empty() && asked.preset.empty() && asked.settings.empty()) return {};
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(scene.material.model.name));
  ParameterRequest over = asked;
  if (asked.hair.empty() && asked.preset.empty())
    over.settings = fmt::format("{},{}", settings_text(scene.material.model.values), asked.settings);
  CUTICLE_ASSIGN(scene.material.model.values, parameters_of(*model, over));
  return {};
}

Result<void> run_render(const RenderOptions& options, Context& context, Trace* trace) {
  CUTICLE_ASSIGN(const auto frames, parse_frames(options.frames));
  CUTICLE_ASSIGN(scene::Scene scene, scene::load_scene(options.scene, plan::catalogue()));
  CUTICLE_TRY(set_scene_options(options, scene));
  CUTICLE_ASSIGN(const std::string refused, meet_budgets(scene, context));
  if (!refused.empty()) return usage_error(refused, "raise the budget, or leave it out");
  CUTICLE_TRY(set_path_options(options, scene));
  scene.outputs.aovs = scene.outputs.aovs || options.aovs;
  scene.outputs.deep = scene.outputs.deep || options.deep;
  scene.outputs.cryptomatte = scene.outputs.cryptomatte || options.cryptomatte;
  if (options.velocity)
    scene.passes.try_emplace("velocity", registry::default_values(render::velocity::entry().entry.parameters));
  if (!scene.outputs.color)
    return bad_input(fmt::format("{}: outputs.color = false leaves nothing to render", options.scene));
  CUTICLE_TRY(plan::check_told_strands(scene));
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = context.device}));
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, *context.progress, trace));
  tell_left_out(scene, runner->plan(), *context.progress);
  CUTICLE_ASSIGN(RunFolder folder, RunFolder::open(options.out));
  CUTICLE_ASSIGN(const Costs costs, render(options, *device, *runner, scene, *context.progress, frames, folder));
  if (context.json)
    print_json(costs, split_of(costs, runner->plan()), device->info().name);
  else
    print_text(costs, split_of(costs, runner->plan()), device->info().name);
  return {};
}

int act(const RenderOptions& options, Context& context) {
  Trace trace;
  const bool tracing = !context.trace_file.empty();
  if (const auto done = run_render(options, context, tracing ? &trace : nullptr); !done) return report(done.error());
  if (!tracing) return Exit::ok;
  const auto written = trace.write(context.trace_file);
  return written ? int(Exit::ok) : report(written.error());
}

}  // namespace

void add_render(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "render", "render pictures of a scene: EXR (linear) and PNG (tone mapped), with the cost of each pass");
  auto options = std::make_shared<RenderOptions>();
  command->add_option("scene", options->scene, "scene file (JSON)")->required();
  command->add_option("--frames", options->frames, "first:last, or one frame (default 0)");
  const std::vector<std::string> methods(std::begin(scene::k_render_methods), std::end(scene::k_render_methods));
  command->add_option("--method", options->method, "how strands are drawn, in place of the scene's render.method")
      ->check(CLI::IsMember(methods))
      ->transform(CLI::Validator(
          [](std::string& name) {
            name = registry::name_now("render.method", name);
            return std::string();
          },
          ""));
  add_parameter_options(*command, options->parameters);
  command->add_option("--size", options->size, "width and height in pixels, in place of the scene's")
      ->expected(2)
      ->check(CLI::Range(16, 16384));
  command->add_flag("--aovs", options->aovs, "EXR of floats with layers: what each pixel sees (lines, quads, tiles)");
  command->add_flag("--deep", options->deep,
                    "also FRAME.deep.exr: what each pixel sees of each strand, as samples in depth (tiles, supersampled, reference)");
  command->add_flag("--cryptomatte", options->cryptomatte,
                    "mattes by strand, groom and material in the EXR, for compositing programs (tiles, supersampled, reference)");
  command->add_flag("--velocity", options->velocity, "the layers, and motion vectors of the hair");
  command->add_option("--samples", options->samples, "reference: paths of a pixel (default 64)")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--bounces", options->bounces, "reference: scatterings of a path; 1: direct light alone; 0: all (default)")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--max-error", options->max_error,
                      "reference: relative standard error of a pixel at which its tile rests (default 0: none does)")
      ->check(CLI::Range(0.0, 10.0));
  command->add_option("--match", options->match,
                      "reference: restrictions of the real-time ways: far_field (the model's mean over the width), "
                      "single_scattering, tables (of the material's layout), dual_scattering (fibres counted along rays), "
                      "shadow=METHOD (at the vertices)")
      ->delimiter(',');
  command->add_option("--state", options->state,
                      "reference: files FILE.0000, ... of a frame's sums, written as it goes; where they are there, it goes on from them");
  command->add_option("--out", options->out, "folder to write (default: render)");
  command->callback([&context, options] { context.action = [&context, options] { return act(*options, context); }; });
}
#else
void add_render(CLI::App&, Context&) {}
#endif

}  // namespace cuticle::cli
