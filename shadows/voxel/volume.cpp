#include "shadows/voxel/volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/shared/disc.glslh"
#include "shadows/detail/map_method.h"

namespace cuticle::shadows::voxel {
namespace {

constexpr double k_largest_depth = 16 * std::numbers::ln2;  // of an opaque crossing, as in maps

/// deposit(cell, amount) for each piece of a segment, `cell` being the whole numbers of the cell.
void for_each_deposit(const Volume& volume, const strands::Groom& groom, std::uint32_t v, bool anisotropic,
                      const auto& deposit) {
  const VolumePlacement<float>& placement = volume.placement;
  const glm::vec3 a = groom.positions[v], b = groom.positions[v + 1], along = b - a;
  const std::uint32_t pieces = volume_pieces(placement, exact_length(along));
  const glm::vec3 to_light = -volume.axes.forward;
  const float shown = shown_length(along, to_light, anisotropic);
  const float width = groom.radii[v] + groom.radii[v + 1];
  const std::uint32_t lanes = lane_count(placement, width);
  const std::uint32_t amount =
      piece_deposit(placement, volume.crossing_units, volume.crossing_meeting, width, shown, lanes * pieces);
  for (std::uint32_t lane = 0; lane < lanes; ++lane) {
    const glm::vec3 offset = lane_offset(along, to_light, width, lane, lanes);
    const glm::vec3 from = moved_by(a, offset), to = moved_by(b, offset);
    for (std::uint32_t i = 0; i < pieces; ++i)
      deposit(cell_of(placement, piece_in_cells(placement, from, to, i, pieces)), amount);
  }
}

/// Trilinear between the middles of cells, 0 outside; `p` in cells.
float sample(const Volume& volume, const glm::vec3& p) {
  const glm::vec3& size = volume.placement.size;
  const float x0 = std::floor(p.x - 0.5f), y0 = std::floor(p.y - 0.5f), z0 = std::floor(p.z - 0.5f);
  float sum = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 cell(x0 + float(i & 1), y0 + float((i >> 1) & 1), z0 + float(i >> 2));
    if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x >= size.x || cell.y >= size.y || cell.z >= size.z) continue;
    const float weight =
        (1 - std::abs(p.x - 0.5f - cell.x)) * (1 - std::abs(p.y - 0.5f - cell.y)) * (1 - std::abs(p.z - 0.5f - cell.z));
    sum += weight * float(volume.sums[cell_number(volume.placement, cell)]);
  }
  return sum;
}

/// Where a ray is inside the box; `leave` is not above `enter` where it misses it.
struct Span {
  float enter = 0, leave = std::numeric_limits<float>::max();
};
Span span_inside(float lower, const glm::vec3& upper, const glm::vec3& p, const glm::vec3& direction) {
  Span span;
  for (int axis = 0; axis < 3; ++axis) {
    const float to_lower = lower - p[axis], to_upper = upper[axis] - p[axis];
    if (direction[axis] == 0) {
      if (to_lower > 0 || to_upper < 0) span.leave = 0;
      continue;
    }
    const float a = to_lower / direction[axis], b = to_upper / direction[axis];
    span.enter = std::max(span.enter, std::min(a, b));
    span.leave = std::min(span.leave, std::max(a, b));
  }
  return span;
}

/// What the receiver's own fibre has left in a cell.
struct OwnCell {
  glm::vec3 cell{0};
  float amount = 0;
};

/// Of the own fibre, in cells as far from the receiver as the rays of a disc of `radius`, metres, read them.
void find_own_cells(const Volume& volume, const Settings& settings, const Asked& asked, std::size_t i,
                    std::vector<OwnCell>& cells) {
  cells.clear();
  const auto own = own_vertex(asked.groom, asked.receivers, i);
  if (!own) return;
  const glm::vec3& forward = volume.axes.forward;
  const auto distance_of = [&](std::uint32_t v) {
    const glm::vec3 away = asked.groom.positions[v] - asked.receivers.points[i];
    return double(glm::length(away - glm::dot(away, forward) * forward));
  };
  const double cell = double(volume.placement.cell), radius = double(asked.groom.radii[own->vertex]);
  const OwnStretch stretch =
      own_stretch(*own, settings.map.filter_radius + double(k_own_cells) * cell + radius, cell, distance_of);
  for (std::uint32_t v = stretch.begin; v < stretch.end; ++v)
    for_each_deposit(volume, asked.groom, v, !settings.isotropic, [&](const glm::vec3& at, std::uint32_t amount) {
      if (cells.empty() || cells.back().cell != at) cells.push_back({at, 0});
      cells.back().amount += float(amount);
    });
}

/// From a point to the end of the volume along a unit direction: trilinear samples half a cell apart, without the
/// receiver's own fibre.
float optical_depth(const Volume& volume, const glm::vec3& p, const glm::vec3& direction,
                    std::span<const OwnCell> own) {
  const glm::vec3 start = in_cells(volume.placement, p);
  const Span inside = span_inside(-0.5f, volume.placement.size + 0.5f, start, direction);
  const glm::vec3 entry = start + inside.enter * direction;
  const float length = inside.leave - inside.enter;
  float sum = 0;
  for (float t = 0.5f * k_ray_step; t < length; t += k_ray_step) sum += sample(volume, entry + t * direction);
  for (const OwnCell& mine : own) sum -= mine.amount * weight_of_cell(mine.cell, entry, direction, length);
  return std::max(0.0f, sum) * k_ray_step / float(k_units);
}

/// Starts of the rays of a lookup, relative to its point, spread over the disc.
std::vector<glm::vec3> ray_starts(const Volume& volume, double radius) {
  const int count = ray_count(float(radius) * volume.placement.per_metre);
  if (count == 1) return {glm::vec3(0)};
  std::vector<glm::vec3> starts;
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 place = radius * disc_point(std::uint32_t(i), std::uint32_t(count), 0.0);
    starts.push_back(float(place.x) * volume.axes.right + float(place.y) * volume.axes.up);
  }
  return starts;
}

}  // namespace

float units_per_crossing(double alpha, const Settings& settings) {
  const double depth = settings.map.accumulation.poisson ? alpha : std::min(k_largest_depth, -std::log1p(-alpha));
  return float(double(k_units) * depth);
}
float crossing_met_at_random(double alpha, const Settings& settings) {
  return settings.map.accumulation.poisson ? float(alpha) : 0;
}

Result<Volume> build_volume(const strands::Groom& groom, double alpha, const LightAxes& axes,
                            const Settings& settings) {
  if (axes.reach > 0) return point_light_refused("voxel");
  const strands::Bounds box = strands::bounds(groom);
  Volume volume{volume_placement(box.lower, box.upper, settings.map.resolution),
                axes,
                {},
                units_per_crossing(alpha, settings),
                crossing_met_at_random(alpha, settings)};
  const glm::vec3& size = volume.placement.size;
  volume.sums.resize(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
  for_each_index(groom.strand_count(), [&](std::size_t s) {
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v)
      for_each_deposit(volume, groom, v, !settings.isotropic, [&](const glm::vec3& cell, std::uint32_t amount) {
        add_to(volume.sums[cell_number(volume.placement, cell)], amount);
      });
  });
  return volume;
}

std::vector<float> look_up(const Volume& volume, const Settings& settings, const Asked& asked) {
  const auto starts = ray_starts(volume, settings.map.filter_radius);
  const glm::vec3 direction = -volume.axes.forward;
  std::vector<float> values(asked.receivers.points.size());
  for_each_index(values.size(), [&](std::size_t i) {
    thread_local std::vector<OwnCell> own;
    find_own_cells(volume, settings, asked, i, own);
    const LookupPlace place =
        lookup_place(asked, asked.receivers.points[i], own_vertex(asked.groom, asked.receivers, i), volume.axes);
    const glm::vec3 from = place.point + place.held * direction;
    float sum = 0;
    for (const glm::vec3& start : starts) sum += std::exp(-optical_depth(volume, from + start, direction, own));
    values[i] = sum / float(starts.size());
  });
  return values;
}

}  // namespace cuticle::shadows::voxel
