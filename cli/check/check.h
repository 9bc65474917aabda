#pragma once
// The targets of `cuticle check`, one file each.
#include "cli/command.h"

namespace cuticle::cli {

/// `check device`: what Vulkan offers, what was chosen, and the catalogue of hard cases in float, double and on the device.
void add_check_device(CLI::App& check, Context& context);
/// `check groom FILE`: whether a groom's strands look like hair, and which mistake of an export they show if not.
void add_check_groom(CLI::App& check, Context& context);
/// `check lut DIR`: whether a folder of tables still says what its manifest says, and which mistake was made if not.
void add_check_lut(CLI::App& check, Context& context);
/// `check model NAME|all`: what a fibre model must hold, with its stated exceptions and the likely cause of what fails.
void add_check_model(CLI::App& check, Context& context);
/// `check scene FILE`: whether a scene file is valid.
void add_check_scene(CLI::App& check, Context& context);

}  // namespace cuticle::cli
