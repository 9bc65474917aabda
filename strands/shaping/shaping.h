#pragma once
// H9, H17: effects that shape drawn strands after interpolation; one folder each, run only when a specification names
// it.
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/registry/entry.h"
#include "core/registry/members.h"
#include "strands/groom.h"

namespace cuticle::strands {

/// One strand as an effect sees it. The base is the strand before all effects.
struct ShapedStrand {
  std::uint32_t strand = 0, leader = 0;  ///< the leader of its lock; the strand itself where nothing clumps
  std::uint64_t seed = 0;
  std::span<glm::vec3> points;                    ///< changed in place, root first
  std::span<const glm::vec3> base, leader_base;   ///< of the strand, of the leader
  std::span<const glm::vec3> normals, binormals;  ///< across the leader's base, parallel-transported
  std::span<const float> travelled;               ///< along the strand's base from its root, metres
  glm::vec3 root_normal{0, 1, 0};                 ///< of the surface it roots on, unit
  float length() const { return travelled.back(); }
  /// Place of a vertex along the base, 0 at the root, 1 at the tip.
  float place(std::size_t vertex) const { return length() > 0 ? travelled[vertex] / length() : 0; }
};

/// Changes the points of one strand.
using Shaper = std::function<void(const ShapedStrand&)>;

/// A shaping effect. Effects run by rising `order`.
struct Shaping {
  registry::Entry entry;
  int order = 0;
  Shaper (*make)(const registry::ParameterValues& values) = nullptr;
};
/// The registered effect of a struct of parameters and of what makes a shaper of it; `entry` says what is its own.
template <class Parameters, Shaper (*make)(const Parameters&)>
Shaping shaping_of(registry::Entry entry, int order) {
  entry.kind = registry::EntryKind::effect;
  entry.stage = registry::Stage::generate;
  entry.parameters = registry::table_of<Parameters>();
  return {entry, order,
          [](const registry::ParameterValues& values) { return make(registry::from_values<Parameters>(values)); }};
}
/// The effects found in the folders of strands/shaping.
std::span<const Shaping* const> shapings();
/// Error: usage, listing the known names and hinting at the nearest.
Result<const Shaping*> find_shaping(std::string_view name);

/// Effects by name with their parameters.
using ShapingBlocks = std::map<std::string, registry::ParameterValues, std::less<>>;

/// Runs the effects on every strand, roots kept in place. Strands of a lock follow its leader: the nearest by root and
/// tip of those that chance makes leaders, one in `strands_per_lock` (of `clumping`; without it each leads itself).
/// `root_normals`: one per strand, or empty (+y). The same seed gives the same strands in any order.
void shape(Groom& groom, const ShapingBlocks& blocks, std::span<const glm::vec3> root_normals, std::uint64_t seed);

/// Four numbers in [0, 1) that belong to `owner` (a strand or a leader) and an effect.
struct ShapingChance {
  float a = 0, b = 0, c = 0, d = 0;
};
ShapingChance shaping_chance(const ShapedStrand& strand, std::uint32_t owner, std::string_view effect);

}  // namespace cuticle::strands
