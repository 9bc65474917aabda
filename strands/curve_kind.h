#pragma once
// What lies between the vertices of a strand: straight pieces or cubic curves, round or flat.
#include <cstdint>
#include <span>
#include <string_view>

#include "core/result.h"
#include "strands/groom.h"

namespace cuticle::strands {

enum class SplineBasis : std::uint8_t { linear, bezier, b_spline, catmull_rom };

/// Round: the spheres along the curve, without caps at the strand's ends (linear: with them). Flat: a ribbon of the
/// same width that faces every ray. The vertices are control points. Curves of B-splines and of Catmull and Rom have
/// one span for each segment and begin and end at the strand's ends: points beyond them are 2 p0 - p1 (USD calls this
/// pinned).
struct CurveKind {
  SplineBasis basis = SplineBasis::linear;
  bool is_flat = false;

  bool is_cone() const { return basis == SplineBasis::linear && !is_flat; }
};

/// "round_linear", "flat_linear", "round_bezier", ...
std::span<const std::string_view> curve_kind_names();
/// Of one of these names.
CurveKind curve_kind(std::string_view name);
/// Error: usage, naming the strand, where Bezier curves do not have 4, 7, 10, ... vertices.
Result<void> validate(const Groom& groom, CurveKind kind);

}  // namespace cuticle::strands
