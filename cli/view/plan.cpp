#include "cli/view/view.h"

namespace cuticle::cli {
namespace {

struct PlanOptions : ViewOptions {
  viz::PlanView shown;
};

Result<void> view_plan(const PlanOptions& options, Context&) {
  return show_or_write(
      options, [&](const std::string& folder) { return viz::write_plan(options.shown, folder); },
      [&](const viz::Views& views, const viz::ViewTarget& target) { return views.plan(options.shown, target); });
}

}  // namespace

void add_view_plan(CLI::App& view, Context& context) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command =
      view.add_subcommand("plan", "what each pixel, tile and strand of a picture cost, from layers of `render --aovs`");
  command->add_option("picture", options->shown.file, "FRAME.exr of `cuticle render SCENE --aovs`")->required();
  command->add_option("--tile", options->shown.tile, "side of the tiles, pixels")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  add_target_options(*command, *options);
  set_view_action(*command, context, options, view_plan);
}

}  // namespace cuticle::cli
