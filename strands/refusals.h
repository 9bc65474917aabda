#pragma once
// What the engines' importers refuse or cut in a groom.
#include <string>
#include <vector>

#include "strands/groom.h"

namespace cuticle::strands {

struct Refusal {
  std::string engine;
  std::string what;  ///< with the number found and the number allowed
};

/// Limits as the engines' sources state them: Unreal's HairStrandsDefinitions.h (255 points a curve, 4,194,303 curves
/// and 16,777,215 points a group), Unity's com.unity.demoteam.hair HairSim.cs (64 .. 64,000 strands of 3 .. 128
/// particles), AMD's TressFX guide (strands of one size, 4 .. 64 points, a power of two). `groom` must be valid.
std::vector<Refusal> refusals(const Groom& groom);
/// Engines and programs that `refusals` and `missing` know; Blender and Houdini state no limits.
inline constexpr const char* k_importers[] = {"unreal", "unity", "tressfx", "blender", "houdini"};
/// What an importer fills in by itself, which a user may not want: Unreal finds roots on the skin by distance where there
/// is no root UV. (Without widths it takes 1 cm; grooms that were read always have some.)
std::vector<Refusal> missing(const Groom& groom);

}  // namespace cuticle::strands
