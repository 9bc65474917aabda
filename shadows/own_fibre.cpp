#include "shadows/own_fibre.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "shadows/detail/map_walk.h"

namespace cuticle::shadows {
namespace {

float squared_distance(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 along = b - a, from = p - a;
  const float length = glm::dot(along, along);
  const float t = length > 0 ? std::clamp(glm::dot(from, along) / length, 0.0f, 1.0f) : 0.0f;
  const glm::vec3 away = from - t * along;
  return glm::dot(away, away);
}

/// The first vertex of the strand's segment that is nearest to the point.
std::uint32_t nearest_segment(const strands::Groom& groom, const glm::vec3& p, std::uint32_t first,
                              std::uint32_t last) {
  std::uint32_t nearest = first;
  float least = std::numeric_limits<float>::max();
  for (std::uint32_t v = first; v < last && least > 0; ++v) {
    const float distance = squared_distance(p, groom.positions[v], groom.positions[v + 1]);
    if (distance < least) nearest = v;
    least = std::min(least, distance);
  }
  return nearest;
}

}  // namespace

std::optional<OwnVertex> own_vertex(const strands::Groom& groom, const Receivers& receivers, std::size_t i) {
  if (receivers.strands.empty()) return {};
  const std::uint32_t first = groom.offsets[receivers.strands[i]], last = groom.offsets[receivers.strands[i] + 1] - 1;
  if (!receivers.vertices.empty()) return OwnVertex{receivers.vertices[i], first, last};
  return OwnVertex{nearest_segment(groom, receivers.points[i], first, last), first, last};
}

glm::vec3 own_along(const strands::Groom& groom, const OwnVertex& own) {
  const std::uint32_t from = own.vertex < own.last ? own.vertex : std::max(own.first + 1, own.vertex) - 1;
  return groom.positions[std::min(from + 1, own.last)] - groom.positions[from];
}

LookupPlace lookup_place(const Asked& asked, const glm::vec3& on_axis, const std::optional<OwnVertex>& own,
                         const LightAxes& axes) {
  LookupPlace place{on_axis};
  const glm::vec3 way = light_way(axes, on_axis);
  const std::optional<glm::dvec3>& viewer = asked.receivers.seen_from;
  const glm::vec3 view = viewer ? glm::vec3(*viewer) - on_axis : glm::vec3(0);
  const float cosine = viewer ? cosine_seen_from(view, way) : 0.0f;
  if (viewer) place.power = seen_power(cosine);
  if (!own) return place;
  const glm::vec3 along = own_along(asked.groom, *own);
  if (along == glm::vec3(0)) return place;  // a puff
  const float radius = asked.groom.radii[own->vertex] * float(asked.receivers.fibre_width);
  place.held = half_crossing(along, way, radius);
  place.is_seen = viewer.has_value();
  if (!place.is_seen) return place;
  place.clearance = seen_clearance(cosine);
  place.held *= fibre_clearance(along, view, way, radius);
  place.point += to_seen_surface(on_axis, along, glm::vec3(*viewer), radius);
  return place;
}

void OwnFibre::add(const Footprint<float>& footprint) {
  const glm::vec2 ends[] = {footprint.from + footprint.start * footprint.direction,
                            footprint.from + footprint.end * footprint.direction};
  const float margin = footprint.half_width + 0.75f;
  pieces_.push_back({footprint, glm::min(ends[0], ends[1]) - margin, glm::max(ends[0], ends[1]) + margin});
}

void OwnFibre::find(const MapView& view, const strands::Groom& groom, const OwnVertex& own, const glm::vec3& seen,
                    const glm::vec2& at, float disc_radius, float steps_to_pieces) {
  pieces_.clear();
  const float half_width = groom.radii[own.vertex] * view.scale.x * view_scale(seen, view.axes.reach);
  const OwnStretch stretch = own_stretch(
      own, double(own_reach(disc_radius, half_width)), double(own_slack(half_width)),
      [&](std::uint32_t v) { return double(glm::distance(at, glm::vec2(to_map(view, groom.positions[v])))); });
  for (std::uint32_t v = stretch.begin; v < stretch.end; ++v)
    for_each_piece(view, groom, v, v == own.first, v + 1 == own.last, steps_to_pieces,
                   [&](const Footprint<float>& footprint) { add(footprint); });
}

OwnFibre::Columns OwnFibre::enter_row(int j) {
  in_row_.clear();
  row_ = j;
  const float y = float(j) + 0.5f;
  float first = std::numeric_limits<float>::max(), last = std::numeric_limits<float>::lowest();
  for (const Piece& piece : pieces_) {
    if (y < piece.lower.y || y > piece.upper.y) continue;
    in_row_.push_back(&piece);
    first = std::min(first, piece.lower.x);
    last = std::max(last, piece.upper.x);
  }
  if (in_row_.empty()) return {};
  return {int(std::floor(first)), int(std::floor(last))};
}

std::span<const OwnDeposit> OwnFibre::deposits(int i) {
  deposits_.clear();
  const float x = float(i) + 0.5f;
  for (const Piece* piece : in_row_) {
    if (x < piece->lower.x || x > piece->upper.x) continue;
    const glm::vec2 offset = texel_offset(piece->footprint.from, i, row_);
    const std::uint32_t covered = coverage_index(coverage(piece->footprint, offset));
    if (covered > 0)
      deposits_.push_back({covered, std::uint32_t(std::max(0, depth_bin(piece->footprint, offset))),
                           holds_point(piece->footprint, offset)});
  }
  return deposits_;
}

}  // namespace cuticle::shadows
