#pragma once
// Which model with which parameters: the options --model, --hair, --preset and --set of every command that takes one.
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "bsdf/model.h"

namespace cuticle::cli {

/// Parameters of a model: settings over a named hair, over a preset, or over the defaults.
struct ParameterRequest {
  std::string hair, preset, settings;
};
/// Adds --hair, --preset and --set.
void add_parameter_options(CLI::App& command, ParameterRequest& request);
/// Error: usage, naming the parameter, hair or preset, or that --hair and --preset exclude each other.
Result<registry::ParameterValues> parameters_of(const bsdf::Model& model, const ParameterRequest& request);

}  // namespace cuticle::cli
