#pragma once
// What strands leave in each texel of the light's view, sorted by depth: all that a map of that resolution could know.
#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"
#include "shadows/map_settings.h"
#include "shadows/map_view.h"
#include "strands/groom.h"

namespace cuticle::shadows {

/// A part of a fibre in a texel; `sum` counts the texel's deposits up to and with this one, in integers of the scale.
struct Fragment {
  std::uint32_t depth = 0, sum = 0;
};

/// Depth steps from the nearest to the farthest vertex, and a depth, in steps, behind every fragment.
inline constexpr float k_list_steps = 65536;
inline constexpr float k_behind_lists = 65537;
/// Pieces per depth step: a steep segment is cut where it passes 1/64 of the whole depth.
inline constexpr float k_list_pieces_per_step = 64 / k_list_steps;

struct FragmentLists {
  MapView view;
  double scale = 1;                  ///< integers per unit of sigma
  std::vector<std::uint32_t> table;  ///< of deposits
  std::vector<std::uint32_t> first;  ///< where each texel's list begins, and the end
  std::vector<Fragment> fragments;
  std::size_t bytes() const { return sizeof(Fragment) * fragments.size() + 4 * first.size(); }
  std::span<const Fragment> of(std::size_t texel) const {
    return std::span(fragments).subspan(first[texel], first[texel + 1] - first[texel]);
  }
};

/// The lists of all texels, the same at any thread count. Error: usage, naming the method, when they would pass 2 GiB.
Result<FragmentLists> sort_fragments(const strands::Groom& groom, double alpha, const LightAxes& axes,
                                     const MapSettings& settings);
template <class Settings>
Result<FragmentLists> sort_fragments_of(const strands::Groom& groom, double alpha, const LightAxes& axes,
                                        const Settings& settings) {
  return sort_fragments(groom, alpha, axes, settings.map);
}

}  // namespace cuticle::shadows
