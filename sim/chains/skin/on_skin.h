#pragma once
// Hair on a skin that deforms, for solvers of rigid links: roots and root frames of every strand, substep by substep.
#include <span>
#include <vector>

#include "sim/chains/chains.h"
#include "sim/chains/placing.h"
#include "sim/chains/skin/skin_turn.glslh"

namespace cuticle::sim::chains {

/// By what a strand's rotation is found: see skin_turn. Vertices are those of the groom. Where effects ask how strands lie
/// beside each other (clumping, strand_interaction), a strand that does not bend has the root of a near one at its side.
struct SkinStrand {
  glm::vec3 along{0};
  float bends = 0;  ///< 1 where `side` is off the line to the farthest vertex, by a thousandth of the length or more
  glm::vec3 across{0};
  float unused = 0;
  glm::vec3 root{0};  ///< rest place of the anchor, metres
  float also_unused = 0;
  std::uint32_t anchor = 0, farthest = 0, side = 0, nothing = 0;
};
/// One per strand; of a strand without links only the anchor counts.
std::vector<SkinStrand> skin_strands(const strands::Groom& rest, const ChainSettings& settings);

/// Where a skin carries a strand as a rigid body: columns of the rotation rest -> world, and its anchor, metres, world.
struct SkinFrame {
  glm::dmat3 turn{1};
  glm::dvec3 root{0};
};

/// Follows a skin on the CPU. Strands are carried as rigid bodies; between two frames places lie on straight lines.
template <class Real>
class OnSkin {
 public:
  OnSkin(const strands::Groom& rest, const ChainSettings& settings, Chains<Real>& chains);
  /// The next frame's places; onto_skin: as if the frame before had been the same.
  void advance(std::span<const glm::vec3> skinned, bool onto_skin, std::span<const Substep> parts);
  /// Of all moments of the frame, turn_row::count rows each.
  void fill(std::size_t block, Rows<Real>& rows) const;
  /// Whether a strand of the block can come to a sphere in the world in the frame, with a distance to keep.
  bool within_reach(const Chains<Real>& chains, std::size_t block, const LinkSphere<Real>& sphere, double pearl) const;
  /// Where the strand in a lane is carried at the frame's end, relative to its root.
  Placing placing(std::size_t block, std::size_t lane) const;
  /// At this share of the frame, by strand of the groom.
  std::vector<SkinFrame> frames(double share) const;
  /// Whether the strand is carried anywhere else in the frame.
  bool moves(std::size_t strand) const;
  glm::dvec3 place(std::size_t vertex) const { return glm::dvec3(end_[vertex]); }
  /// Of a vertex that the skin carries, m/s.
  glm::dvec3 velocity(std::size_t vertex) const;

 private:
  glm::dvec3 place_at(std::uint32_t vertex, double share) const;
  SkinTurn<double> turn_at(std::size_t strand, double share) const;

  std::vector<SkinStrand> strands_;
  std::vector<std::uint32_t> strand_of_;  ///< by block and lane
  std::vector<glm::vec3> begin_, end_;
  std::size_t steps_ = 1;
  double duration_ = 0;
};

}  // namespace cuticle::sim::chains
