#pragma once
// Places of roots without hair: text, first their number, then for each two lines of three numbers, its position and
// its normal.
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"

namespace cuticle::strands {

struct RootPlaces {
  std::vector<glm::vec3> positions;  ///< file units
  std::vector<glm::vec3> normals;    ///< of any length
};
/// Error: bad_input naming file and line and what was expected.
Result<RootPlaces> read_root_places(const std::string& path);
Result<RootPlaces> parse_root_places(std::string_view text, const std::string& where);

}  // namespace cuticle::strands
