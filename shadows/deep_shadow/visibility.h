#pragma once
// Visibility functions of the texels of the light's view (Lokovic and Veach 2000), as straight pieces between knots.
#include <cstdint>
#include <span>
#include <vector>

#include <cuticle/shadows/detail/fragment_lists.h>

namespace cuticle::shadows::deep_shadow {

/// A point of a visibility function: the part of the light that reaches this depth, in steps.
struct Knot {
  float depth = 0, visibility = 1;
};

/// A texel's function through its fragments: it falls over the step that holds each; `per_unit`: -k / scale.
void exact_function(std::span<const Fragment> fragments, float per_unit, std::vector<Knot>& knots);

/// The knots of a function within `bound` of the exact one everywhere, never rising: each piece goes as far as some
/// slope stays within the bound at all points passed, and takes the middle of those slopes (section 3.2 of the paper).
/// `exact`: depths rising, visibility falling.
void compress(std::span<const Knot> exact, double bound, std::vector<Knot>& knots);
/// The same with at most `pieces` pieces: the bound grows by halves until they suffice.
void compress_to(std::span<const Knot> exact, double bound, std::size_t pieces, std::vector<Knot>& knots);

/// Knots of 16 bits of depth and 16 of visibility each, texel by texel. Where a texel's begin is kept in 16 bits beside
/// one whole number for each run of 64 texels.
struct PackedFunctions {
  std::vector<std::uint32_t> begin_of_run;
  std::vector<std::uint16_t> begin_in_run;
  std::vector<std::uint32_t> knots;

  std::size_t begin(std::size_t texel) const { return begin_of_run[texel / 64] + begin_in_run[texel]; }
  std::span<const std::uint32_t> of(std::size_t texel) const {
    return std::span(knots).subspan(begin(texel), begin(texel + 1) - begin(texel));
  }
  std::size_t bytes() const { return 4 * (begin_of_run.size() + knots.size()) + 2 * begin_in_run.size(); }
};
/// Most pieces of one texel: 64 texels' knots are counted in 16 bits.
inline constexpr std::uint32_t k_most_pieces = 256;

/// All functions of the lists, each within `bound` unless `pieces` do not suffice for that.
PackedFunctions pack(const FragmentLists& lists, float per_unit, double bound, std::size_t pieces);

/// The visibility at a depth, in steps: 1 before the first knot, the last knot's behind it, linear between.
float visibility_at(std::span<const std::uint32_t> words, float depth);

}  // namespace cuticle::shadows::deep_shadow
