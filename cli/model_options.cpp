#include "cli/model_options.h"

#include <fmt/format.h>

#include "bsdf/fibre/fibres.h"

namespace cuticle::cli {

void add_parameter_options(CLI::App& command, ParameterRequest& request) {
  command.add_option("--hair", request.hair,
                     "a whole fibre by name (pigment, cross-section, tilt, roughness): blond, brown, black, red, ...");
  command.add_option("--preset", request.preset, "the pigment of blond, brown or black hair over the model's defaults");
  command.add_option("--set", request.settings, "parameters, name=value,name=value, over the hair, preset or defaults");
}

Result<registry::ParameterValues> parameters_of(const bsdf::Model& model, const ParameterRequest& request) {
  if (request.hair.empty()) return bsdf::parse_settings(model, request.preset, request.settings);
  if (!request.preset.empty()) return usage_error("--hair and --preset exclude each other");
  CUTICLE_ASSIGN(const bsdf::NamedFibre hair, bsdf::find_fibre(request.hair));
  if (!model.from_fibre)
    return usage_error(fmt::format("model {} has no mapping from a hair", model.entry.name), "--set name=value,...");
  return bsdf::parse_settings(model, "", fmt::format("{},{}", model.from_fibre(hair.fibre).settings, request.settings));
}

}  // namespace cuticle::cli
