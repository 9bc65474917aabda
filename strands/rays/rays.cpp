#include <cuticle/strands/rays/rays.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>
#include <fmt/core.h>

#include <cuticle/strands/rays/round_cone.h>

namespace cuticle::strands {

namespace {

/// Embree's query context, with the segments that the filter was told of.
struct Collector {
  RTCIntersectContext context;  ///< first, so that Embree's pointer is ours
  std::vector<std::uint32_t> segments;
};

/// Takes every segment down and refuses its hit, so that the traversal goes on to the end.
void collect_hit(const RTCFilterFunctionNArguments* arguments) {
  auto* collector = reinterpret_cast<Collector*>(arguments->context);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (arguments->valid[0] == 0) return;
  collector->segments.push_back(hit->primID);
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

/// Embree's single precision misses rays near the surface of long segments, and finds rays that pass beside a segment
/// (of curled hair one crossing in forty): it is asked for fibres a little wider, and what it finds is tested in
/// double.
constexpr float k_wider = 1.02f;

void fill_vertices(RTCGeometry geometry, const std::vector<glm::vec4>& spheres) {
  auto* vertices = static_cast<glm::vec4*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, spheres.size()));
  if (!vertices) return;
  for (std::size_t v = 0; v < spheres.size(); ++v)
    vertices[v] = glm::vec4(glm::vec3(spheres[v]), k_wider * spheres[v].w);
}

/// Each segment is a round cone with both its end spheres (flags 0).
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
  std::vector<std::uint32_t> first_of_segment, strand_of_segment;
  std::vector<glm::vec4> spheres;  ///< of the vertices: position, radius

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Result<void> build(const Groom& groom);
};

Result<void> RayGroom::Impl::build(const Groom& groom) {
  device = rtcNewDevice(nullptr);
  if (!device) return internal_error(fmt::format("Embree gave no device (error {})", int(rtcGetDeviceError(nullptr))));
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) spheres.emplace_back(groom.positions[v], groom.radii[v]);
  first_of_segment = segment_vertices(groom);
  strand_of_segment = segment_strands(groom, first_of_segment);
  if (!first_of_segment.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    fill_vertices(geometry, spheres);
    fill_segments(geometry, first_of_segment);
    rtcSetGeometryIntersectFilterFunction(geometry, collect_hit);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return {};
  const std::string message =
      fmt::format("Embree could not build a tree over {} segments (error {})", first_of_segment.size(), int(error));
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
  collector.segments.clear();
  RTCRayHit query = make_ray(origin, direction);
  rtcIntersect1(impl_->scene, &collector.context, &query);
  std::vector<std::uint32_t>& segments = collector.segments;
  std::sort(segments.begin(), segments.end());
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
  crossings.clear();
  for (const std::uint32_t segment : segments) {
    const glm::vec4* ends = &impl_->spheres[impl_->first_of_segment[segment]];
    const LineInterval interval = round_cone_interval(origin, direction, ends[0], ends[1]);
    if (interval.last > std::max(0.0, interval.first))
      crossings.push_back(
          {impl_->strand_of_segment[segment], float(std::max(0.0, interval.first)), float(interval.last)});
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
