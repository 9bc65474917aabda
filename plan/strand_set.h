#pragma once
// The hair of a scene before the first frame: control hairs, the strands drawn between them, and what they grow on.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/registry/entry.h"
#include "scene/scene.h"
#include "sim/solver.h"
#include "strands/character/character.h"
#include "strands/groom.h"
#include "strands/mesh.h"
#include "strands/spline/place.h"

namespace cuticle::plan {

struct StrandSet {
  strands::Groom control;                           ///< at rest, metres
  std::vector<std::array<std::uint32_t, 3>> hairs;  ///< per drawn strand: its three control strands
  std::vector<glm::vec3> weights;                   ///< per drawn strand, sum 1
  float radius = strands::k_default_radius;         ///< of a drawn strand, metres: as wide as the fibres it stands for
  double opacity = 1;                               ///< of one crossing, unless the scene gives one
  float fibre_width = 1;                            ///< of a fibre, as a share of that of the strand which stands for it
  float taper = 0.5f;                               ///< share of it that is gone at the tip
  /// A file's strands as they are, and the follow hairs beside them; what is drawn where the scene draws them as given,
  /// with the control hairs' radii. Empty: hair of no file.
  std::vector<strands::PlacedStrand> placed;
  bool is_spread = false;           ///< each prefix of hairs and placed is spread over them (put_in_spread_order)
  std::uint32_t segment_parts = 1;  ///< of a segment of these: light is found at the ends of each part
  float follow_reach = 0;           ///< how far from its guide a follow hair may lie, metres
  strands::Mesh head, scalp;        ///< drawn; empty where the scene has none
  std::shared_ptr<const strands::Character> character;  ///< what the control hairs follow; null: the head
  std::vector<strands::Root> control_roots;             ///< on the character's mesh, one per control hair
  std::vector<Sphere> colliders;                        ///< in the head's rest space
  std::vector<RoundedBox> boxes;                        ///< colliders as well, there too
  std::vector<sim::FieldPointer> fields;                ///< the scene's mesh colliders, there too
  std::vector<sim::MovingCollider> moving;              ///< colliders that move by themselves
  strands::Mesh fins;                                   ///< in the head's rest space; empty where the scene has none
  std::vector<float> fin_weights;                       ///< one per vertex: 0 rigid .. 1 simulated
  glm::dvec3 pivot{0};             ///< about which the head turns: the neck, or the middle of the roots
  std::vector<std::string> notes;  ///< what was guessed, one sentence each
};

/// Reads or grows the scene's hair. A file's strands are drawn as they are, each vertex with its radius, and follow
/// hairs as a TressFX project asks. With groom.interpolate they are control hairs; where `strand_count` asks for more,
/// each further strand is mixed from a strand of the file and the two that root nearest to it. Error: bad_input from
/// the readers, or naming the key that cannot be met.
Result<StrandSet> build_strand_set(const scene::Scene& scene);

/// Strands that the scene draws, and vertices of each (of the longest, where it draws them as given).
std::size_t drawn_strands(const scene::Scene& scene, const StrandSet& set);
int drawn_vertices(const scene::Scene& scene, const StrandSet& set);

/// Sizes of a frame of this scene.
registry::FrameShape shape_of(const scene::Scene& scene, const StrandSet& set);

}  // namespace cuticle::plan
