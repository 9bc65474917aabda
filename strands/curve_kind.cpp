#include "strands/curve_kind.h"

#include <algorithm>
#include <array>

#include <fmt/core.h>

namespace cuticle::strands {

namespace {

/// By basis, round before flat.
constexpr std::array<std::string_view, 8> k_names = {"round_linear",      "flat_linear",     "round_bezier",
                                                     "flat_bezier",       "round_b_spline",  "flat_b_spline",
                                                     "round_catmull_rom", "flat_catmull_rom"};

}  // namespace

std::span<const std::string_view> curve_kind_names() { return k_names; }

CurveKind curve_kind(std::string_view name) {
  const auto at = std::size_t(std::ranges::find(k_names, name) - k_names.begin());
  CUTICLE_EXPECT(at < k_names.size(), "the name of a kind of curves");
  return {SplineBasis(at / 2), at % 2 == 1};
}

Result<void> validate(const Groom& groom, CurveKind kind) {
  CUTICLE_TRY(validate(groom));
  if (kind.basis != SplineBasis::bezier) return {};
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s) {
    const std::uint32_t count = groom.offsets[s + 1] - groom.offsets[s];
    if (count < 4 || count % 3 != 1)
      return usage_error(fmt::format("strand {} has {} vertices; Bezier curves need 4, 7, 10, ...", s, count));
  }
  return {};
}

}  // namespace cuticle::strands
