#include "strands/rays/rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "strands/rays/detail/embree_curves.h"
#include "strands/rays/round_cone.h"

namespace cuticle::strands {

namespace {

/// Embree's query context, with the segments that the filter was told of.
struct Collector {
  RTCIntersectContext context;         ///< first, so that Embree's pointer is ours
  std::array<std::uint32_t, 2> first;  ///< segment of each geometry
  std::vector<std::uint32_t> segments;
};

/// Takes every segment down and refuses its hit, so that the traversal goes on to the end.
void collect_hit(const RTCFilterFunctionNArguments* arguments) {
  auto* collector = reinterpret_cast<Collector*>(arguments->context);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (arguments->valid[0] == 0) return;
  collector->segments.push_back(collector->first[hit->geomID] + hit->primID);
  arguments->valid[0] = 0;
}

/// The segments that have a length, or those that have none.
std::vector<RaySegment> segments_of(const Groom& groom, bool with_length) {
  std::vector<RaySegment> segments;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v)
      if ((groom.positions[v] != groom.positions[v + 1]) == with_length) segments.push_back({v, s});
  return segments;
}

RTCRayHit make_ray(const glm::dvec3& origin, const glm::dvec3& direction) {
  RTCRayHit query{};
  query.ray.org_x = float(origin.x);
  query.ray.org_y = float(origin.y);
  query.ray.org_z = float(origin.z);
  query.ray.dir_x = float(direction.x);
  query.ray.dir_y = float(direction.y);
  query.ray.dir_z = float(direction.z);
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

struct RayGroom::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<RaySegment> segments;  ///< those with a length, then those without
  std::uint32_t with_length = 0;
  std::vector<glm::vec4> spheres;  ///< of the vertices: position, radius

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Result<void> build(const Groom& groom);
  void attach(RTCGeometry geometry, unsigned id);
};

void RayGroom::Impl::attach(RTCGeometry geometry, unsigned id) {
  rtcSetGeometryIntersectFilterFunction(geometry, collect_hit);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

Result<void> RayGroom::Impl::build(const Groom& groom) {
  device = rtcNewDevice(nullptr);
  if (!device) return internal_error(fmt::format("Embree gave no device (error {})", int(rtcGetDeviceError(nullptr))));
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) spheres.emplace_back(groom.positions[v], groom.radii[v]);
  segments = segments_of(groom, true);
  with_length = std::uint32_t(segments.size());
  const std::vector<RaySegment> points = segments_of(groom, false);
  if (with_length > 0) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    if (fill_vertices(geometry, spheres.size(), [&](std::size_t v) { return spheres[v]; }))
      fill_segments(geometry, segments);
    attach(geometry, 0);
  }
  if (!points.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    fill_vertices(geometry, points.size(), [&](std::size_t i) { return spheres[points[i].first]; });
    attach(geometry, 1);
  }
  segments.insert(segments.end(), points.begin(), points.end());
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return {};
  const std::string message =
      fmt::format("Embree could not build a tree over {} segments (error {})", segments.size(), int(error));
  return error == RTC_ERROR_OUT_OF_MEMORY ? Error{ErrorKind::out_of_memory, message, "use fewer strands"}
                                          : internal_error(message);
}

RayGroom::RayGroom(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayGroom::~RayGroom() = default;

Result<std::unique_ptr<RayGroom>> RayGroom::build(const Groom& groom) {
  CUTICLE_TRY(validate(groom));
  auto impl = std::make_unique<Impl>();
  CUTICLE_TRY(impl->build(groom));
  return std::unique_ptr<RayGroom>(new RayGroom(std::move(impl)));
}

namespace {

/// Joins the overlapping intervals of one strand; `crossings` sorted by (strand, entry).
void join_overlaps(std::vector<Crossing>& crossings) {
  std::size_t kept = 0;
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    Crossing& last = crossings[kept];
    if (crossings[i].strand == last.strand && crossings[i].entry <= last.exit)
      last.exit = std::max(last.exit, crossings[i].exit);
    else
      crossings[++kept] = crossings[i];
  }
  if (!crossings.empty()) crossings.resize(kept + 1);
}

}  // namespace

void RayGroom::all_crossings(const glm::dvec3& origin, const glm::dvec3& direction,
                             std::vector<Crossing>& crossings) const {
  thread_local Collector collector;
  rtcInitIntersectContext(&collector.context);
  collector.first = {0, impl_->with_length};
  collector.segments.clear();
  RTCRayHit query = make_ray(origin, direction);
  rtcIntersect1(impl_->scene, &collector.context, &query);
  std::vector<std::uint32_t>& found = collector.segments;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  crossings.clear();
  for (const std::uint32_t i : found) {
    const RaySegment& segment = impl_->segments[i];
    const glm::vec4* ends = &impl_->spheres[segment.first];
    const LineInterval interval = round_cone_interval(origin, direction, ends[0], ends[1]);
    if (interval.last > std::max(0.0, interval.first))
      crossings.push_back({segment.strand, float(std::max(0.0, interval.first)), float(interval.last)});
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.strand != b.strand ? a.strand < b.strand : a.entry < b.entry;
  });
  join_overlaps(crossings);
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.entry != b.entry ? a.entry < b.entry : a.strand < b.strand;
  });
}

}  // namespace cuticle::strands
