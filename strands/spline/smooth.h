#pragma once
// N4: control hairs -> cubic Bezier curves from per-frame tangents -> more vertices. N5: three smoothed hairs -> one between them.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <cuticle/strands/groom.h>
#include <cuticle/strands/growing/growing.h>
#include <cuticle/strands/mesh.h>

namespace cuticle::strands {

/// Every strand of `control` resampled to `vertices` points (2 .. 64; 7 -> 36 in the published system), uniform in curve
/// parameter; end points kept. Strands of 1 vertex are repeated; strands of 2 stay straight.
Groom smooth(const Groom& control, int vertices);

/// `roots` strands blended from the three smoothed hairs of each root's triangle. All smoothed strands have equal counts.
/// `hair_of_vertex[v]` is the smoothed strand that grew on scalp vertex v.
Groom interpolate(const Groom& smoothed, const Mesh& scalp, std::span<const Root> roots,
                  std::span<const std::uint32_t> hair_of_vertex);

}  // namespace cuticle::strands
