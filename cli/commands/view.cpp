#include "cli/command.h"

#ifdef CUTICLE_HAS_VTK
#include <memory>
#include <numbers>

#include "cli/model_options.h"
#include "viz/viz.h"
#endif

namespace cuticle::cli {

#ifdef CUTICLE_HAS_VTK
namespace {

struct ViewOptions {
  std::string model = "marschner", lobe = "all", radius = "log", file;
  ParameterRequest parameters;
  double theta_i_deg = 30, metres_per_unit = 0;
  std::vector<int> size = {1000, 800};
  viz::ViewTarget target;
};

void add_target(CLI::App& command, const std::shared_ptr<ViewOptions>& options) {
  command.add_option("--screenshot", options->target.screenshot, "write a PNG and exit instead of opening a window");
  command.add_option("--size", options->size, "width and height in pixels")->expected(2)->check(CLI::Range(64, 8192));
}

viz::ViewTarget target_of(const ViewOptions& options) {
  return {options.target.screenshot, {options.size[0], options.size[1]}};
}

Result<void> view_lobes(const ViewOptions& options) {
  viz::LobesView view;
  CUTICLE_ASSIGN(view.model, bsdf::find_model(options.model));
  CUTICLE_ASSIGN(view.values, parameters_of(*view.model, options.parameters));
  if (options.lobe != "all") {
    CUTICLE_ASSIGN(view.lobe, bsdf::find_lobe(*view.model, options.lobe));
  }
  view.theta_i = options.theta_i_deg * std::numbers::pi / 180;
  view.logarithmic = options.radius == "log";
  return viz::show(view, target_of(options));
}

Result<void> view_strands(const ViewOptions& options) {
  CUTICLE_ASSIGN(const viz::StrandsView view, viz::load_strands(options.file, options.metres_per_unit));
  return viz::show(view, target_of(options));
}

template <class View>
void set_action(CLI::App& command, Context& context, const std::shared_ptr<ViewOptions>& options, View view) {
  command.callback([&context, options, view] {
    context.action = [options, view] {
      const Result<void> done = view(*options);
      return done ? int(Exit::ok) : report(done.error());
    };
  });
}

void add_lobes(CLI::App& app, Context& context) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command = app.add_subcommand("lobes", "the polar surface of S over the outgoing directions");
  command->add_option("--model", options->model, "a model (cuticle models)")->capture_default_str();
  add_parameter_options(*command, options->parameters);
  command->add_option("--theta-i-deg,--theta-i", options->theta_i_deg, "inclination of the light, degrees")
      ->check(CLI::Range(-90.0, 90.0));
  command->add_option("--lobe", options->lobe, "R, TT, TRT, sum, or all (one surface each)")->capture_default_str();
  command->add_option("--radius", options->radius, "log (three decades) or linear")
      ->check(CLI::IsMember({"log", "linear"}))
      ->capture_default_str();
  add_target(*command, options);
  set_action(*command, context, options, view_lobes);
}

void add_strands(CLI::App& app, Context& context) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* command =
      app.add_subcommand("strands", "strands coloured by stretch (.vtp states) or by arc length (grooms)");
  command->add_option("file", options->file, "a state (.vtp) or a groom (.hair, .tfx)")->required();
  command->add_option("--metres-per-unit", options->metres_per_unit, "unit of a groom's file; 0 = guess")
      ->check(CLI::Range(0.0, 1000.0));
  add_target(*command, options);
  set_action(*command, context, options, view_strands);
}

}  // namespace

void add_view(CLI::App& app, Context& context) {
  CLI::App* command = app.add_subcommand("view", "view lobes and strands in a window or as a picture (needs a display)");
  command->require_subcommand(1);
  command->fallthrough();
  add_lobes(*command, context);
  add_strands(*command, context);
}
#else
void add_view(CLI::App&, Context&) {}
#endif

}  // namespace cuticle::cli
