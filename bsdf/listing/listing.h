#pragma once
// What the registry of models holds, for programs to read.
#include <string>

namespace cuticle::bsdf {

/// All models as a JSON array: what registry::to_json says of an entry (name, summary, source, parameters with unit, range and
/// default, systems), and lobes, conventions, presets, exceptions (check, why), whether a hair can be mapped, a sampler exists, and
/// the model is a near-field one at its defaults.
std::string models_json();

}  // namespace cuticle::bsdf
