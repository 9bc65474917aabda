#pragma once
// Scene files of earlier formats, brought up to this one.
#include <cstdint>
#include <string>
#include <vector>

#include "core/json/json.h"

namespace cuticle::scene {

/// The format that this program writes and reads.
inline constexpr std::int64_t k_schema_version = 1;

/// Brings the scene of an earlier `schema_version` up to k_schema_version, one format after the other, and says what
/// has changed, a sentence for each change; names that this format had before are read as well. A scene without a whole
/// number there, or of a later format, stays as it is.
std::vector<std::string> migrate(Json& scene);

}  // namespace cuticle::scene
