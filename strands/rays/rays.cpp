#include <cuticle/strands/rays/rays.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

/// One hit of the ray with the surface of one segment.
struct Hit {
  std::uint32_t segment = 0;
  float distance = 0;
  bool leaves = false;  ///< the ray goes out of the segment here
};

/// Embree's query context, with the list that the filter fills.
struct Collector {
  RTCIntersectContext context;  ///< first, so that Embree's pointer is ours
  std::vector<Hit> hits;
};

/// Takes every hit down and refuses it, so that the traversal goes on to the end.
void collect_hit(const RTCFilterFunctionNArguments* arguments) {
  auto* collector = reinterpret_cast<Collector*>(arguments->context);
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (arguments->valid[0] == 0) return;
  const float outward = hit->Ng_x * ray->dir_x + hit->Ng_y * ray->dir_y + hit->Ng_z * ray->dir_z;
  collector->hits.push_back({hit->primID, ray->tfar, outward > 0});
  arguments->valid[0] = 0;
}

/// First vertices of the segments that have a length.
std::vector<std::uint32_t> segment_vertices(const Groom& groom) {
  std::vector<std::uint32_t> firsts;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v)
      if (groom.positions[v] != groom.positions[v + 1]) firsts.push_back(v);
  return firsts;
}

std::vector<std::uint32_t> segment_strands(const Groom& groom, const std::vector<std::uint32_t>& firsts) {
  std::vector<std::uint32_t> strands;
  strands.reserve(firsts.size());
  std::uint32_t strand = 0;
  for (std::uint32_t first : firsts) {
    while (groom.offsets[strand + 1] <= first) ++strand;
    strands.push_back(strand);
  }
  return strands;
}

void fill_vertices(RTCGeometry geometry, const Groom& groom) {
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, groom.vertex_count()));
  if (!vertices) return;
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) {
    for (int axis = 0; axis < 3; ++axis) vertices[4 * v + std::size_t(axis)] = groom.positions[v][axis];
    vertices[4 * v + 3] = groom.radii[v];
  }
}

/// Each segment is a round cone with both its end spheres (flags 0): its hits are then an interval of its own.
void fill_segments(RTCGeometry geometry, const std::vector<std::uint32_t>& firsts) {
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 4, firsts.size()));
  auto* flags = static_cast<std::uint8_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, firsts.size()));
  if (!indices || !flags) return;
  std::copy(firsts.begin(), firsts.end(), indices);
  std::fill_n(flags, firsts.size(), std::uint8_t(0));
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
  std::vector<std::uint32_t> strand_of_segment;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Result<void> build(const Groom& groom);
  Crossing crossing_of(const Hit* begin, const Hit* end) const;
};

Result<void> RayGroom::Impl::build(const Groom& groom) {
  device = rtcNewDevice(nullptr);
  if (!device) return internal_error(fmt::format("Embree gave no device (error {})", int(rtcGetDeviceError(nullptr))));
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  const std::vector<std::uint32_t> firsts = segment_vertices(groom);
  strand_of_segment = segment_strands(groom, firsts);
  if (!firsts.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    fill_vertices(geometry, groom);
    fill_segments(geometry, firsts);
    rtcSetGeometryIntersectFilterFunction(geometry, collect_hit);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return {};
  const std::string message =
      fmt::format("Embree could not build a tree over {} segments (error {})", firsts.size(), int(error));
  return error == RTC_ERROR_OUT_OF_MEMORY ? Error{ErrorKind::out_of_memory, message, "use fewer strands"}
                                          : internal_error(message);
}

/// The interval of one segment from its hits (sorted). Where the first already leaves, the ray began inside.
Crossing RayGroom::Impl::crossing_of(const Hit* begin, const Hit* end) const {
  const float entry = begin->leaves && end - begin == 1 ? 0.0f : begin->distance;
  return {strand_of_segment[begin->segment], entry, (end - 1)->distance};
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
  collector.hits.clear();
  RTCRayHit query = make_ray(origin, direction);
  rtcIntersect1(impl_->scene, &collector.context, &query);
  std::vector<Hit>& hits = collector.hits;
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return a.segment != b.segment ? a.segment < b.segment : a.distance < b.distance;
  });
  crossings.clear();
  for (std::size_t begin = 0, end = 0; begin < hits.size(); begin = end) {
    while (end < hits.size() && hits[end].segment == hits[begin].segment) ++end;
    crossings.push_back(impl_->crossing_of(hits.data() + begin, hits.data() + end));
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
