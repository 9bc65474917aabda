#pragma once
// Hair cards as triangles of a binary glTF.
#include <cstddef>
#include <vector>

#include "core/result.h"
#include "strands/cards/hair_cards.h"

namespace cuticle::strands {

/// Base (noise along strands) as R, G, B and the strands' coverage as A.
Image card_picture(const CardTextures& textures);

/// A .glb of the cards in metres, one double-sided mesh in the static order: POSITION, NORMAL, TEXCOORD_0, COLOR_0
/// (ambient occlusion) and TANGENT across the card, so that -w cross(NORMAL, TANGENT) runs from root to tip. No
/// attributes of our own: Filament refuses a file with one. `picture`: a PNG of card_picture, which becomes the base
/// color texture with its alpha masked at .5. KHR_materials_anisotropy stretches the highlight across the strands.
/// Error: bad_input where the file would pass 4 GiB.
Result<std::vector<std::byte>> cards_glb(const HairCards& cards, std::span<const std::byte> picture);

}  // namespace cuticle::strands
