#pragma once
// What the helper nodes compute.
#include "bsdf/materialx/document.h"

namespace cuticle::bsdf::materialx {

/// The value of an output of chiang_hair_roughness, chiang_hair_absorption_from_color or
/// deon_hair_absorption_from_melanin. Errors: those of the node's inputs; bad_input for an absorption above 100.
Result<Numbers> helper_value(const HairNode& node, std::string_view output);

}  // namespace cuticle::bsdf::materialx
