#pragma once
// Pictures of grooming specifications side by side.
#include "cli/command.h"

namespace cuticle::cli {

/// Draws each specification by the passes of scenes/presets.json, frames 0 (front) and 1 (behind) side by side, two
/// specifications to a row where their number is even, as one PNG. Error: no_device without a device or in a build
/// without Vulkan.
Result<void> draw_preset_sheet(const std::vector<std::string>& specifications, const std::string& file,
                               Context& context);

}  // namespace cuticle::cli
