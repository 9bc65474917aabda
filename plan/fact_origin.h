#pragma once
// Where a fact comes from: a key of the scene file, or a measurement.
#include <string>
#include <string_view>

namespace cuticle::plan {

/// "lights", "shadow.method", "passes.velocity"; "measured: ..." of a fact of a frame, or of the device.
std::string origin_of(std::string_view fact);

}  // namespace cuticle::plan
