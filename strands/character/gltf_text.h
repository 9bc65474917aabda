#pragma once
// What the library that reads glTF accepts in silence.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace cuticle::strands {

/// The JSON of a .glb or .gltf; empty where a .glb has none.
std::string_view gltf_text(std::span<const std::byte> bytes);

/// Error: bad_input for text that is no JSON or deeper than 256 levels (the library reads it by recursion), for
/// negative offsets and counts (which it takes as 0), and for buffers whose `uri` leads out of the file's own folder.
Result<void> check_gltf_text(std::string_view text, const std::string& where);

/// Whether a relative name, percent signs decoded, stays in its folder.
bool stays_inside(std::string_view uri);

}  // namespace cuticle::strands
