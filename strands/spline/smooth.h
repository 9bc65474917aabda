#pragma once
// N4: control hairs -> curves from per-frame tangents -> more vertices. N5: three smoothed hairs -> one between them.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "strands/groom.h"
#include "strands/growing/growing.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// The curve through (`b_spline`: beside) the control vertices. `bezier`, the published one, neither loops nor
/// overshoots where segments are uneven; `catmull_rom` may; `b_spline` is smoothest and cuts corners.
enum class Curve { bezier, catmull_rom, b_spline };

inline constexpr int k_max_vertices = 256;  ///< of a drawn strand

/// Every strand of `control` resampled to `vertices` points (2 .. k_max_vertices; 7 -> 36 in the published system),
/// uniform in curve parameter; end points kept. Strands of 1 vertex are repeated; strands of 2 stay straight. Radii and
/// vertex attributes are linear between control vertices; what belongs to a strand is kept.
Groom smooth(const Groom& control, int vertices, Curve curve = Curve::bezier);

/// How far smoothed vertices lie from the polyline of their control vertices, metres.
struct Deviation {
  double largest = 0, mean = 0;
};
/// Both grooms have the same strands.
Deviation deviation_from_controls(const Groom& control, const Groom& smoothed);

/// `roots` strands blended from the three smoothed hairs of each root's triangle, attributes too. All smoothed strands
/// have equal counts. `hair_of_vertex[v]` is the smoothed strand that grew on scalp vertex v. Exact for affine motion
/// of the hairs: within float rounding, moving them and then blending is blending and then moving (interpolation_test).
Groom interpolate(const Groom& smoothed, const Mesh& scalp, std::span<const Root> roots,
                  std::span<const std::uint32_t> hair_of_vertex);

/// As interpolate(), but each strand follows the one hair of the greatest weight: its root's offset from that hair's is
/// carried along the hair's parallel-transported frames. Keeps the hair's shape, so that strands between hairs which
/// run apart do not collapse, and jumps where the nearest hair changes. Exact for rigid motion of the hairs.
Groom follow(const Groom& smoothed, const Mesh& scalp, std::span<const Root> roots,
             std::span<const std::uint32_t> hair_of_vertex);

}  // namespace cuticle::strands
