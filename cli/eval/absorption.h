#pragma once
// Absorption on the command line: by pigments of a named table, or by a colour with the meaning that it is given.
#include <string>

#include "bsdf/model.h"

namespace cuticle::cli {

/// At most one of both. `pigments`: "TABLE:EUMELANIN/PHEOMELANIN", concentrations, "deon_pbrt:1.3/0". `color`:
/// "assembly:r/g/b" for a dense head of hair (with the model's beta_n, 0.3 where it has none), "fibre:r/g/b" for one
/// fibre of the model itself.
struct AbsorptionRequest {
  std::string pigments, color;
};

/// Sets sigma_a in the values of a model as requested; nothing where nothing is. Errors: usage, naming the option,
/// table, meaning or model; bad_input, naming the component, its value and range.
Result<void> apply_absorption(const AbsorptionRequest& request, const bsdf::Model& model,
                              registry::ParameterValues& values);

}  // namespace cuticle::cli
