#include "cli/view/view.h"

namespace cuticle::cli {
namespace {

constexpr double k_degree = std::numbers::pi / 180;

struct PathsOptions : ViewOptions {
  viz::PathsView shown;
  double theta_i_deg = 0, turned_deg = 0;
};

Result<void> view_paths(const PathsOptions& options, Context&) {
  viz::PathsView view = options.shown;
  view.theta = options.theta_i_deg * k_degree;
  view.turned = options.turned_deg * k_degree;
  return show_or_write(
      options, [&](const std::string& folder) { return viz::write_paths(view, folder); },
      [&](const viz::Views& views, const viz::ViewTarget& target) { return views.paths(view, target); });
}

}  // namespace

void add_view_paths(CLI::App& view, Context& context) {
  auto options = std::make_shared<PathsOptions>();
  CLI::App* command =
      view.add_subcommand("paths", "rays of R, TT and TRT through the cross-section of a fibre, with the caustic");
  command->add_option("--eta", options->shown.eta, "refractive index")
      ->check(CLI::Range(1.05, 3.0))
      ->capture_default_str();
  command->add_option("--theta-i-deg,--theta-i", options->theta_i_deg, "inclination of the light, degrees")
      ->check(CLI::Range(-85.0, 85.0));
  command->add_option("--aspect", options->shown.aspect, "axis across the light over the axis along it, before turning")
      ->check(CLI::Range(0.4, 2.5))
      ->capture_default_str();
  command->add_option("--turned-deg", options->turned_deg, "by which the section is turned against the light, degrees")
      ->check(CLI::Range(-180.0, 180.0));
  command->add_option("--rays", options->shown.rays, "rays drawn")->check(CLI::Range(1, 200))->capture_default_str();
  add_target_options(*command, *options);
  set_view_action(*command, context, options, view_paths);
}

}  // namespace cuticle::cli
