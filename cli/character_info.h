#pragma once
// `cuticle info` of a character.
#include <string>

#include "cli/command.h"

namespace cuticle::cli {

struct CharacterInfoRequest {
  std::string file;
  std::string convention;  ///< JSON: units, axes, bones mapped by hand; empty: none
  std::string skeleton;    ///< BVH whose bones are mapped onto the character's; empty: none
  double metres_per_unit = 0;
};
/// Whether a file is a character by its extension (.glb, .gltf).
bool is_character_file(const std::string& file);
int show_character(const CharacterInfoRequest& request, bool json);

}  // namespace cuticle::cli
