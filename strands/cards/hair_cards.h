#pragma once
// Everything that is made of a groom's cards, and its files.
#include <string>

#include "strands/cards/card_mesh.h"

namespace cuticle::strands {

struct HairCards {
  CardSet set;
  CardTextures textures;
  CardMesh mesh;
  std::vector<float> occlusion;  ///< A3, one per vertex of the mesh
};
/// `head`: what the hair grows on, null or without vertices where there is none. Error: as make_cards.
Result<HairCards> make_hair_cards(const Groom& groom, const Mesh* head, const CardParameters& parameters);

/// Into a folder that exists: cards.obj (metres; occlusion as grey vertex colours; faces in the static order, one group
/// for each part), cards.mtl, base.png, alpha.png, shift.png, mask.png (8 bits, values as they are), cards.png (base and alpha in one), cards.glb
/// (cards_glb.h), and cards.json
/// (sizes, kinds, error of cover).
Result<void> write_cards(const std::string& folder, const HairCards& cards);
/// The figures of cards.json.
std::string card_report(const HairCards& cards);

}  // namespace cuticle::strands
