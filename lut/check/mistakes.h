#pragma once
#include "lut/check/check.h"

namespace cuticle::lut::check {

/// What explains that a table's probes do not read right: "unknown" when nothing does.
Mistake find_mistake(const ManifestTable& table, const Image& image);

}  // namespace cuticle::lut::check
