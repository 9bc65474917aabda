#pragma once
// A2: textures of hair cards, baked from the strands that the cards stand for.
#include "core/image/image.h"
#include "strands/cards/cards.h"

namespace cuticle::strands {

/// One texture of the atlas.
struct CardKind {
  std::uint32_t card = 0;   ///< whose strands it was baked from
  double coverage = 0;      ///< share of that card that its strands cover as they are
  double strand_width = 1;  ///< factor on their width in the texture
  double alpha = 0;         ///< mean alpha: what they cover at that width
  double opaque = 0;        ///< share of texels of alpha 1
};
/// The kinds side by side, each `width` x `height` texels with a column without hair on either side; row 0 at the
/// roots. Channels 0 .. 1: "base" (noise stretched along strands), "shift" (of the specular tangent, 0.5 is none),
/// "mask" (noise that lets the secondary highlight sparkle), "alpha" (share of 8 x 8 points that strands cover).
struct CardTextures {
  int width = 0, height = 0;
  Image atlas;
  std::vector<CardKind> kinds;
  double kind_error = 0;  ///< mean difference of a card's coverage from that of the card its kind was baked from
  /// Place in the atlas of a point of a card.
  glm::vec2 atlas_uv(std::uint32_t kind, float u, float v) const;
};

/// Cards whose strands cover them alike become one kind (`kinds`, k-means on 4 x 4 mean alphas), baked from the card
/// nearest to their mean; sets `kind` of every card. Strands are drawn by their radii
/// over their arc length, so that alpha is their coverage within 0.005 (cards_test, against random points); widened, at
/// most k_max_widening times, until it is `fill`.
CardTextures bake_textures(const Groom& groom, CardSet& set, const CardParameters& parameters);
inline constexpr double k_max_widening = 16;

}  // namespace cuticle::strands
