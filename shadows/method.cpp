#include "shadows/method.h"

#include <cmath>

#include <fmt/ranges.h>
#include <tbb/task_arena.h>

namespace cuticle::shadows {

Result<const Method*> find_method(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Method* method : methods()) {
    if (method->entry.name == name) return method;
    known.push_back(method->entry.name);
  }
  const std::string nearest = registry::nearest_name(name, known);
  return usage_error(fmt::format("shadow method '{}' is not known; known: {}", name, fmt::join(known, ", ")),
                     nearest.empty() ? "cuticle methods" : nearest);
}

Result<LightAxes> axes_of(const Casters& casters) {
  return light_axes(casters.light(), strands::bounds(*casters.groom));
}

namespace {

Result<void> check_casters(const Casters& casters) {
  CUTICLE_EXPECT(casters.groom != nullptr, "casters name a groom");
  CUTICLE_TRY(axes_of(casters));
  if (!(casters.alpha >= 0 && casters.alpha <= 1))
    return usage_error(fmt::format("alpha: {} is outside 0 .. 1", casters.alpha));
  if (auto sound = strands::validate(*casters.groom); !sound)
    return bad_input(sound.error().message, sound.error().hint);
  return {};
}

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

Result<void> check_segments(const Receivers& receivers) {
  if (receivers.segments.empty()) return {};
  if (receivers.segments.size() != receivers.points.size())
    return usage_error(
        fmt::format("receivers: {} segments for {} points", receivers.segments.size(), receivers.points.size()));
  for (std::size_t i = 0; i < receivers.segments.size(); ++i) {
    const SegmentPlace& place = receivers.segments[i];
    if (!is_finite(place.from) || !is_finite(place.to) || !(place.fraction >= 0 && place.fraction <= 1))
      return bad_input(
          fmt::format("receivers: the segment of point {} is not finite, or its fraction {} is outside "
                      "0 .. 1",
                      i, place.fraction));
  }
  return {};
}

/// Vertices of the strands that the receivers name.
Result<void> check_vertices(const Casters& casters, const Receivers& receivers) {
  if (receivers.vertices.empty()) return {};
  if (receivers.vertices.size() != receivers.points.size())
    return usage_error(
        fmt::format("receivers: {} vertices for {} points", receivers.vertices.size(), receivers.points.size()));
  const std::vector<std::uint32_t>& offsets = casters.groom->offsets;
  for (std::size_t i = 0; i < receivers.vertices.size(); ++i) {
    const std::uint32_t strand = receivers.strands[i], vertex = receivers.vertices[i];
    if (vertex < offsets[strand] || vertex >= offsets[strand + 1])
      return usage_error(fmt::format("receivers: vertex {} of point {} is not of strand {}", vertex, i, strand));
  }
  return {};
}

Result<void> check_strands(const Casters& casters, const Receivers& receivers) {
  if (receivers.strands.empty() && !receivers.vertices.empty())
    return usage_error("receivers: vertices are given without their strands");
  if (receivers.strands.empty()) return {};
  if (receivers.strands.size() != receivers.points.size())
    return usage_error(
        fmt::format("receivers: {} strand numbers for {} points", receivers.strands.size(), receivers.points.size()));
  for (std::size_t i = 0; i < receivers.strands.size(); ++i)
    if (receivers.strands[i] >= casters.groom->strand_count())
      return usage_error(fmt::format("receivers: strand {} of point {} is outside 0 .. {}", receivers.strands[i], i,
                                     std::int64_t(casters.groom->strand_count()) - 1));
  return check_vertices(casters, receivers);
}

}  // namespace

Result<void> check(const Casters& casters, const Receivers& receivers) {
  CUTICLE_TRY(check_casters(casters));
  for (std::size_t i = 0; i < receivers.points.size(); ++i)
    if (!is_finite(receivers.points[i])) return bad_input(fmt::format("receivers: point {} is not finite", i));
  CUTICLE_TRY(check_segments(receivers));
  return check_strands(casters, receivers);
}

std::string cpu_device_name() { return fmt::format("cpu ({} threads)", tbb::this_task_arena::max_concurrency()); }

}  // namespace cuticle::shadows
