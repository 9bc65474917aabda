#pragma once
// What one fibre of a map counts in the mean (fibres.glslh).
#include <array>
#include <cstdint>
#include <span>

#include "shadows/map_settings.h"
#include "shadows/map_view.h"
#include "strands/groom.h"

namespace cuticle::shadows {

/// Weights and coverages of the mean fibre.
using FibreSums = std::array<std::uint32_t, 2>;

/// Sums over the sampled segments, one in 64; the same integers at any thread count, and as the GPU's.
FibreSums sums_of_fibre(const MapView& view, const strands::Groom& groom);

/// What the mean fibre counts in the exponent of T, `per_unit` a unit of the map's integers; `table`: of deposits.
float fibre_exponent(const FibreSums& sums, std::span<const std::uint32_t> table, float per_unit);

}  // namespace cuticle::shadows
