#include "cli/groom_options.h"
#include "cli/run_folder.h"
#include "cli/shared_files.h"

#include <fmt/core.h>

#ifdef CUTICLE_HAS_DEMO
#include "study/demo/demo.h"
#endif

namespace cuticle::cli {

#ifdef CUTICLE_HAS_DEMO
namespace {

int run(const study::DemoOptions& options, Context& context) {
  Trace trace;
  Trace* tracing = context.trace_file.empty() ? nullptr : &trace;
  auto device = gpu::Device::open({context.device});
  if (!device) return report(device.error());
  context.progress->message(
      fmt::format("device: {} ({})", (*device)->info().name, (*device)->info().is_software ? "software" : "GPU"));
  if (auto done = study::run_demo(*device, options, *context.progress, tracing); !done) return report(done.error());
  if (tracing)
    if (auto written = trace.write(context.trace_file); !written) return report(written.error());
  return make_page("--demo", options.out, *context.progress);
}

}  // namespace

void add_demo(CLI::App& app, Context& context) {
  auto* command =
      app.add_subcommand("demo", "run the main job on a small scene: bake, grow, simulate, shadow, render, study");
  auto options = std::make_shared<study::DemoOptions>();
  options->out = "demo";
  command->add_option("--groom", options->groom_file,
                      "groom in place of the grown hair: " + strands::list_of_extensions(false));
  command->add_flag("!--part-only", options->whole_project,
                    "of a .tfx that a .tfxproj beside it names, draw this part only");
  add_groom_options(*command, options->metres_per_unit, options->radius);
  command->add_option("--out", options->out, "folder to write (default: demo)");
  command->add_option("--frames", options->frames, "frames to simulate and render")->check(CLI::Range(2, 2000));
  command->add_flag("!--no-study", options->study, "leave the shadow study out");
  command->callback([&context, options] {
    context.action = [&context, options] {
      options->scene_file = share_file(options->groom_file.empty() ? "scenes/demo.json" : "scenes/demo_groom.json");
      return in_folder(options->out, [&] { return run(*options, context); });
    };
  });
}
#else
void add_demo(CLI::App&, Context&) {}
#endif

}  // namespace cuticle::cli
