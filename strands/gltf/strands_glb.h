#pragma once
// A groom's strands as lines of a binary glTF.
#include <string>
#include <vector>

#include "core/result.h"
#include "strands/groom.h"

namespace cuticle::strands {

/// Writes a .glb whose one mesh draws every strand as line segments (mode 1). Per vertex: POSITION; TANGENT, its first
/// three components from root to tip, the fourth 1; TEXCOORD_0: radius in the unit of the positions, and the share of
/// the strand's length from the root; TEXCOORD_1: root uv, where the groom has it; COLOR_0, where it has the attribute
/// "color" of three components. No attributes of our own: Filament refuses a file with one. glTF's unit is the metre;
/// another unit becomes the node's scale. Gives what the file cannot hold, one sentence each. Opened by three.js,
/// Babylon.js, PlayCanvas, Filament and Blender (tests/clients). Error: bad_input where the file would pass 4 GiB.
Result<std::vector<std::string>> write_strands_glb(const std::string& path, const Groom& groom,
                                                   double metres_per_unit = 1);

}  // namespace cuticle::strands
