#pragma once
// Bones of a TressFX hairdo (.tfxbone): which four move each strand.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"
#include "strands/formats/format.h"

namespace cuticle::strands {

/// Per strand four bones and their weights, as the file orders them.
struct BoneWeights {
  std::vector<std::string> bones;
  std::vector<std::array<std::uint32_t, 4>> index;  ///< into bones; 0 where the weight is 0
  std::vector<std::array<float, 4>> weight;         ///< >= 0, as in the file
};

/// Layout as AMD's loader of TressFX 4 reads it: i32 count of bones, each i32 index, i32 length with its closing 0, the
/// name; i32 count of strands, each i32 index and four pairs of i32 bone and f32 weight. A bone of -1 is none.
/// Error: bad_input naming field and offset: a count that the file cannot hold, a name longer than 255, a bone out of
/// range with a weight, a weight below 0 or not finite.
Result<BoneWeights> parse_tfxbone(std::span<const std::byte> bytes, const std::string& where);

/// Adds the attributes bone_index and bone_weight (4 per strand). Strands past the file's have its last strand's bones,
/// as the loader has it. Strands whose weights are all 0 are counted in a note. Error: more strands than the groom has.
Result<void> add_bones(const BoneWeights& weights, const std::string& where, ParsedGroom& parsed);

}  // namespace cuticle::strands
