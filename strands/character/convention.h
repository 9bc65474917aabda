#pragma once
// H16: what a file of any program means by its numbers, and what its bones are called.
#include <map>
#include <span>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/result.h"
#include "strands/groom.h"

namespace cuticle::strands {

/// Units and axes of an asset, and bones that are mapped by hand. The file for all of it (cuticle info --override, a
/// scene's character.override): {"metres_per_unit": 0.01, "up": "+z", "forward": "-y", "bones": {"Head": "b_Head_05"}}.
struct Convention {
  double metres_per_unit = 0;                ///< 0: guessed from the size
  std::string up = "+y", forward = "+z";     ///< axes of the file: +x, -x, +y, ...
  std::map<std::string, std::string> bones = {};  ///< names of ours -> names of theirs
};

/// Error: bad_input naming the key and what is allowed.
Result<Convention> read_convention(const std::string& path);
Result<Convention> parse_convention(std::string_view json, const std::string& where);

/// The turn from the file's axes to ours (y up, facing +z), right-handed. Error: bad_input where an axis is no axis, or
/// both are one.
Result<glm::dmat4> axes_to_ours(const Convention& convention);

/// What a character's units seem to be: the first of metres, centimetres, inches, feet and millimetres by which its
/// longest side is 0.1 .. 4 m; metres where none is.
UnitGuess guess_character_units(double longest_side);

/// Which of their bones each of ours is: by hand first; then of equal name; then of equal plain name (plain_bone_name),
/// but only where one bone of theirs has it.
struct BoneMap {
  struct Pair {
    std::string ours, theirs;
    std::string rule;  ///< "override", "name", "plain name"
  };
  std::vector<Pair> pairs;             ///< in the order of ours
  std::vector<std::string> unmapped;   ///< of ours
  std::vector<std::string> ambiguous;  ///< of ours, with several bones of theirs
};
/// Error: bad_input where an override names a bone that is not there.
Result<BoneMap> map_bones(std::span<const std::string> ours, std::span<const std::string> theirs,
                          const std::map<std::string, std::string>& overrides = {});

/// A bone's name without what programs add: a namespace ("mixamorig:"), a prefix ("b_", "bip01", "def-"), a number of
/// the exporter ("_05"), case and separators; sides as a leading "left" or "right" ("hand.L", "LeftHand" and "l_hand"
/// are "lefthand"); a few synonyms ("pelvis" and "hip" are "hips").
std::string plain_bone_name(std::string_view name);

}  // namespace cuticle::strands
