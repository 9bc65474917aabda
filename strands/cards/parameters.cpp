#include "strands/cards/cards.h"

namespace cuticle::strands {

void describe(registry::Members& members, CardParameters& cards) {
  members(cards.cards, "cards", 1, 100000, "at most so many, all layers together");
  members(cards.layers, "layers", 1, 16, "cards that the strands of one place are split into, from the head outward");
  members(cards.segments, "segments", 1, 128, "quads along a card");
  members(cards.width, "width", "m", 0, 1, "of a card; 0: as wide as its strands lie");
  members(cards.within, "within", "1", 0.1, 1,
          "share of a card's strands that lie within its width, where that is derived");
  members(cards.outward, "outward", "1", 0, 10,
          "how much a card faces away from the head; 0: only where its strands are flattest");
  members(cards.iterations, "iterations", 0, 100, "of k-means");
  members(cards.seed, "seed", 0, 4294967295.0, "of the clusters and of the textures' noise");
  members(cards.kinds, "kinds", 1, 64, "textures in the atlas; cards alike share one");
  members(cards.texture_width,
          registry::row("texture_width", "px", 4, 1024, "of one kind, across the card, two of them an empty border"));
  members(cards.texture_height, registry::row("texture_height", "px", 4, 4096, "of one kind, along the card"));
  members(cards.fill, "fill", "1", 0, 0.95,
          "least mean alpha of a kind: its strands are drawn wider until they cover it; 0: as they are");
  members(cards.base_variation, "base_variation", "1", 0, 1, "darkest stretched noise of the base texture below 1");
  members(cards.shift_variation, "shift_variation", "1", 0, 1, "range of the specular shift texture around 0.5");
  members(cards.occlusion_rays, "occlusion_rays", 1, 1024, "for the ambient occlusion of a vertex");
  members(cards.swings_from, "swings_from", "m", 0, 10,
          "distance from the head's centre at which cards are cut: the rest swings and is sorted by itself; 0: "
          "no cut");
}

}  // namespace cuticle::strands
