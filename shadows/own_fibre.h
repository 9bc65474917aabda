#pragma once
// What a receiver's own fibre has left in the texels that a lookup reads, so that it can be taken out of them.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "shadows/map_view.h"
#include "shadows/method.h"
#include "shadows/own_fibre.glslh"
#include "shadows/splat.glslh"
#include "strands/groom.h"

namespace cuticle::shadows {

/// What a lookup is asked: receivers, and the groom whose strands they name.
struct Asked {
  const strands::Groom& groom;
  const Receivers& receivers;
};

/// A vertex of a strand, whose vertices are first .. last.
struct OwnVertex {
  std::uint32_t vertex = 0, first = 0, last = 0;
};
/// Where on its strand a receiver lies: at the vertex, or on the segment that begins there. None where receivers name
/// no strands. Without Receivers::vertices the nearest segment of the strand is searched.
std::optional<OwnVertex> own_vertex(const strands::Groom& groom, const Receivers& receivers, std::size_t i);

/// A vector along the strand there: of the segment that begins at the vertex, or of its last one.
glm::vec3 own_along(const strands::Groom& groom, const OwnVertex& own);

/// Where a receiver is looked up, given its place on the fibre's axis: on the surface that the viewer sees; and how far
/// before it, metres, the axes of fibres that hold it may lie.
struct LookupPlace {
  glm::vec3 point{0};
  float held = 0;
  bool is_seen = false;  ///< by a viewer
  float clearance = 1;   ///< seen_clearance() there
  float power = 1;       ///< seen_power() of a place that a viewer sees, on a strand that casts or not; else 1
};
LookupPlace lookup_place(const Asked& asked, const glm::vec3& on_axis, const std::optional<OwnVertex>& own,
                         const LightAxes& axes);

/// Segments of the strand, by their first vertices begin .. end - 1, that do not shadow the vertex (own_fibre.glslh);
/// distance_of(v): of a vertex from the receiver, across the light.
struct OwnStretch {
  std::uint32_t begin = 0, end = 0;
};
OwnStretch own_stretch(const OwnVertex& own, double reach, double slack, const auto& distance_of);

/// A deposit as the map counts it: a step of coverage, the depth step, and whether the fibre holds the texel's centre.
struct OwnDeposit {
  std::uint32_t covered = 0, step = 0;
  bool is_at_centre = false;
};

/// The pieces of a receiver's own fibre around it. One object serves one lookup after the other, to keep its memory.
class OwnFibre {
 public:
  /// None: nothing is taken out.
  void leave_none() { pieces_.clear(); }
  /// The pieces that may cover texels of a disc around a receiver; `seen`: it in the light's view, `at`: in the map.
  void find(const MapView& view, const strands::Groom& groom, const OwnVertex& own, const glm::vec3& seen,
            const glm::vec2& at, float disc_radius, float steps_to_pieces);

  bool is_empty() const { return pieces_.empty(); }
  /// Prepares row j; the columns that the fibre may cover there, none where last < first.
  struct Columns {
    int first = 0, last = -1;
  };
  Columns enter_row(int j);
  /// What it has left in column i of that row; valid until the next call.
  std::span<const OwnDeposit> deposits(int i);

 private:
  struct Piece {
    Footprint<float> footprint;
    glm::vec2 lower, upper;  ///< of the texel centres that it may cover
  };
  void add(const Footprint<float>& footprint);

  std::vector<Piece> pieces_;
  std::vector<const Piece*> in_row_;
  std::vector<OwnDeposit> deposits_;
  int row_ = 0;
};

OwnStretch own_stretch(const OwnVertex& own, double reach, double slack, const auto& distance_of) {
  OwnStretch stretch{own.vertex, std::min(own.vertex + 1, own.last)};  // the segment that the receiver may lie on
  const auto goes_on = [&, furthest = 0.0](std::uint32_t v) mutable {
    const double distance = distance_of(v);
    const bool still = is_still_own(distance, furthest, reach, slack);
    furthest = std::max(furthest, distance);
    return still;
  };
  for (auto ahead = goes_on; stretch.end < own.last && ahead(stretch.end);) ++stretch.end;
  for (auto back = goes_on; stretch.begin > own.first && back(stretch.begin);) --stretch.begin;
  return stretch;
}

}  // namespace cuticle::shadows
