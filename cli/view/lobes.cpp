#include <algorithm>

#include "cli/model_options.h"
#include "cli/view/view.h"

namespace cuticle::cli {
namespace {

struct LobesOptions : ViewOptions {
  std::string model = "marschner", lobe = "all", radius = "log", compare = "side";
  ParameterRequest parameters;
  double theta_i_deg = 30, h = 0;
};

/// Of settings for two models, those of which this one has the parameter.
std::string settings_for(const bsdf::Model& model, const std::string& settings) {
  std::string kept;
  for (const std::string& setting : split_list(settings)) {
    std::string name = setting.substr(0, setting.find('='));
    if (name.ends_with("_deg")) name.resize(name.size() - 4);
    if (registry::find_parameter(model.entry.parameters, name)) kept += (kept.empty() ? "" : ",") + setting;
  }
  return kept;
}

Result<std::vector<viz::ShownModel>> models_of(const LobesOptions& options) {
  const std::vector<std::string> names = split_list(options.model);
  if (names.empty() || names.size() > 2)
    return usage_error("--model takes one model, or two to compare", "--model marschner,chiang");
  std::vector<viz::ShownModel> shown;
  for (const std::string& name : names) {
    CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
    ParameterRequest request = options.parameters;
    if (names.size() == 2) request.settings = settings_for(*model, request.settings);
    CUTICLE_ASSIGN(registry::ParameterValues values, parameters_of(*model, request));
    shown.push_back({model, std::move(values)});
  }
  return shown;
}

Result<void> check_settings(const std::string& settings, const std::vector<viz::ShownModel>& models) {
  if (settings.empty()) return {};
  for (const std::string& setting : split_list(settings)) {
    const bool is_known = std::any_of(models.begin(), models.end(),
                                      [&](const auto& shown) { return !settings_for(*shown.model, setting).empty(); });
    if (!is_known) return usage_error("--set: no model shown has the parameter of '" + setting + "'", "cuticle models");
  }
  return {};
}

Result<void> view_lobes(const LobesOptions& options, Context&) {
  viz::LobesView view;
  CUTICLE_ASSIGN(view.models, models_of(options));
  CUTICLE_TRY(check_settings(options.parameters.settings, view.models));
  view.settings = {options.theta_i_deg * std::numbers::pi / 180, options.lobe, options.radius == "log", options.h};
  view.difference = options.compare == "difference";
  return show_or_write(
      options, [&](const std::string& folder) { return viz::write_lobes(view, folder); },
      [&](const viz::Views& views, const viz::ViewTarget& target) { return views.lobes(view, target); });
}

}  // namespace

void add_view_lobes(CLI::App& view, Context& context) {
  auto options = std::make_shared<LobesOptions>();
  CLI::App* command = view.add_subcommand("lobes", "S over the outgoing directions as surfaces, M and N beside them");
  command->add_option("--model", options->model, "a model, or two to compare: marschner,chiang")->capture_default_str();
  add_parameter_options(*command, options->parameters);
  command->add_option("--theta-i-deg,--theta-i", options->theta_i_deg, "inclination of the light, degrees")
      ->check(CLI::Range(-90.0, 90.0));
  command->add_option("--lobe", options->lobe, "R, TT, TRT, sum, or all (one surface each)")->capture_default_str();
  command->add_option("--radius", options->radius, "log (three decades) or linear")
      ->check(CLI::IsMember({"log", "linear"}))
      ->capture_default_str();
  command->add_option("--compare", options->compare, "two models side by side, or their difference")
      ->check(CLI::IsMember({"side", "difference"}))
      ->capture_default_str();
  command->add_option("--h", options->h, "offset across the fibre, of near-field models")->check(CLI::Range(-1.0, 1.0));
  add_target_options(*command, *options);
  set_view_action(*command, context, options, view_lobes);
}

}  // namespace cuticle::cli
