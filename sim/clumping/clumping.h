#pragma once
// Clumps: who leads whom, and what of a vertex's aim does not change in motion.
#include <span>
#include <vector>

#include "sim/chains/chains.h"
#include "sim/chains/skin/on_skin.h"
#include "sim/clumping/settings.h"

namespace cuticle::sim::clumping {

/// The strand that leads each strand: itself where it leads, is alone or has fewer than two vertices. Strands with
/// equal numbers in the groom's attribute "clump" (of strands, one component) are a clump, led by the one whose root is
/// nearest the mean of their roots; without it chance makes one strand in `strands_per_clump` a guide, and a strand
/// follows the guide whose root is nearest. The same seed gives the same guides.
std::vector<std::uint32_t> guides_of(const strands::Groom& rest, const Settings& settings);

/// A vertex of a chain that is pulled. Indices are of the chains' numbers, x of three that lie k_lanes apart.
struct ClumpedVertex {
  glm::dvec3 base{0};                              ///< see clump_aim, m
  glm::dvec3 apart{0};                             ///< at rest, from the strand's anchor to its guide's, m
  glm::dvec3 at_rest{0};                           ///< its own target without the clump, m
  double share = 0;                                ///< of the clump in all that pulls the vertex
  double between = 0;                              ///< where the guide is between its vertices `above` and `below`
  double most_squared = 0;                         ///< of the guide's place, m^2
  std::uint32_t above = 0, below = 0, target = 0;  ///< two places in the state; the target in the rest rows
  std::uint32_t strand = 0, guide = 0;             ///< of the groom
};

/// The vertices of followers, none past the end of their guide. Their pull in `chains` becomes that of both springs:
/// a critically damped one of rate sqrt(pull^2 + rate^2) towards the mean of both aims, weighted by the squares.
template <class Real>
std::vector<ClumpedVertex> join_clumps(chains::Chains<Real>& chains, const strands::Groom& rest,
                                       const Settings& settings);

/// Columns of the rotation from the state's axes, before a frame's first substep, to rest space.
glm::dmat3 to_rest(const Substep& first);

/// New targets from where the guides are.
template <class Real>
void aim(chains::Chains<Real>& chains, const std::vector<ClumpedVertex>& vertices, const glm::dmat3& to_rest);

/// Targets as they are without clumps.
template <class Real>
void aim_at_rest(chains::Chains<Real>& chains, const std::vector<ClumpedVertex>& vertices);

/// As aim, on a skin, by where it carries each strand.
template <class Real>
void aim_on_skin(chains::Chains<Real>& chains, const std::vector<ClumpedVertex>& vertices,
                 std::span<const chains::SkinFrame> frames);

}  // namespace cuticle::sim::clumping
