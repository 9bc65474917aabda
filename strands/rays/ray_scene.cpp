#include "strands/rays/ray_scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include <fmt/core.h>

#include "strands/rays/detail/embree_curves.h"
#include "strands/rays/round_cone.h"

namespace cuticle::strands {

namespace {

/// Surfaces are not met nearer than this, so that a ray that leaves one does not meet it again, metres.
constexpr float k_off_surface = 1e-5f;
constexpr unsigned k_fibres = 0;  ///< geometry; surfaces follow

}  // namespace

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<RaySegment> segments;
  std::vector<glm::vec4> spheres;
  std::vector<std::uint32_t> offsets;
  std::atomic<std::size_t> bytes{0};

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  Result<void> build(const Groom& groom, std::span<const Mesh> surfaces);
  void add_fibres(const Groom& groom);
  void add_surface(const Mesh& mesh, unsigned id);
  LineInterval interval(std::uint32_t vertex, const glm::dvec3& origin, const glm::dvec3& direction) const {
    return round_cone_interval(origin, direction, spheres[vertex], spheres[vertex + 1]);
  }
  double leaves_at(const glm::dvec3& origin, const glm::dvec3& direction, const FibreLeft& from) const;
};

namespace {

/// Embree's query context with the ray in double and what the filter found.
struct Query {
  RTCIntersectContext context;  ///< first, so that Embree's pointer is ours
  const RayScene::Impl* scene;
  glm::dvec3 origin, direction;
  FibreLeft from;
  double limit;          ///< hits from here on do not count
  double left_at = -1;   ///< where the ray is out of the fibre that it leaves; negative: not asked yet
};

void begin(RTCRay& ray, const Query& query) {
  ray.org_x = float(query.origin.x);
  ray.org_y = float(query.origin.y);
  ray.org_z = float(query.origin.z);
  ray.dir_x = float(query.direction.x);
  ray.dir_y = float(query.direction.y);
  ray.dir_z = float(query.direction.z);
  ray.tnear = 0;
  ray.tfar = float(query.limit);
  ray.mask = ~0u;
}

}  // namespace

/// How far the ray runs inside segments of its own strand that overlap one after the other, in both directions.
double RayScene::Impl::leaves_at(const glm::dvec3& origin, const glm::dvec3& direction, const FibreLeft& from) const {
  const double slack = 1e-3 * double(spheres[from.vertex].w);
  double out = std::max(0.0, interval(from.vertex, origin, direction).last);
  const auto extend = [&](std::uint32_t vertex) {
    const LineInterval more = interval(vertex, origin, direction);
    const bool overlaps = more.last >= 0 && more.first <= out + slack;
    if (overlaps) out = std::max(out, more.last);
    return overlaps;
  };
  for (std::uint32_t v = from.vertex + 1; v + 1 < offsets[from.strand + 1] && extend(v);) ++v;
  for (std::uint32_t v = from.vertex; v > offsets[from.strand] && extend(v - 1);) --v;
  return out + slack;
}

namespace {

/// Takes a fibre's hit where the ray enters the cone itself, and puts its distance into the ray.
bool takes(Query& query, unsigned primitive, float& distance) {
  const RaySegment& segment = query.scene->segments[primitive];
  const LineInterval inside = query.scene->interval(segment.first, query.origin, query.direction);
  if (!(inside.first > 0) || !(inside.first < query.limit)) return false;
  if (segment.strand == query.from.strand) {
    if (query.left_at < 0) query.left_at = query.scene->leaves_at(query.origin, query.direction, query.from);
    if (inside.first <= query.left_at) return false;
  }
  query.limit = inside.first;
  distance = float(inside.first);
  return true;
}

void filter_fibre(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& query = *reinterpret_cast<Query*>(arguments->context);
  auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  if (!takes(query, hit.primID, ray.tfar)) arguments->valid[0] = 0;
}

/// A surface that the ray leaves is not met again.
void filter_surface(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& query = *reinterpret_cast<Query*>(arguments->context);
  const float distance = reinterpret_cast<const RTCRay*>(arguments->ray)->tfar;
  if (distance < k_off_surface || !(double(distance) < query.limit))
    arguments->valid[0] = 0;
  else
    query.limit = double(distance);
}

bool count_memory(void* total, ssize_t bytes, bool) {
  *static_cast<std::atomic<std::size_t>*>(total) += std::size_t(bytes);
  return true;
}

}  // namespace

void RayScene::Impl::add_fibres(const Groom& groom) {
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) spheres.emplace_back(groom.positions[v], groom.radii[v]);
  offsets = groom.offsets;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = offsets[s]; v + 1 < offsets[s + 1]; ++v)
      if (groom.positions[v] != groom.positions[v + 1]) segments.push_back({v, s});
  if (segments.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  if (fill_vertices(geometry, spheres.size(), [&](std::size_t v) { return spheres[v]; })) {
    fill_segments(geometry, segments);
    rtcSetGeometryIntersectFilterFunction(geometry, filter_fibre);
    rtcSetGeometryOccludedFilterFunction(geometry, filter_fibre);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, k_fibres);
  }
  rtcReleaseGeometry(geometry);
}

void RayScene::Impl::add_surface(const Mesh& mesh, unsigned id) {
  if (mesh.triangles.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
  auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.triangles.size()));
  if (vertices && triangles) {
    std::ranges::copy(mesh.positions, vertices);
    std::ranges::copy(mesh.triangles, triangles);
    rtcSetGeometryIntersectFilterFunction(geometry, filter_surface);
    rtcSetGeometryOccludedFilterFunction(geometry, filter_surface);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
  }
  rtcReleaseGeometry(geometry);
}

Result<void> RayScene::Impl::build(const Groom& groom, std::span<const Mesh> surfaces) {
  device = rtcNewDevice(nullptr);
  if (!device) return internal_error(fmt::format("Embree gave no device (error {})", int(rtcGetDeviceError(nullptr))));
  rtcSetDeviceMemoryMonitorFunction(device, count_memory, &bytes);
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  add_fibres(groom);
  for (std::size_t k = 0; k < surfaces.size(); ++k) add_surface(surfaces[k], k_fibres + 1 + unsigned(k));
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return {};
  const std::string message =
      fmt::format("Embree could not build a tree over {} segments (error {})", segments.size(), int(error));
  return error == RTC_ERROR_OUT_OF_MEMORY ? Error{ErrorKind::out_of_memory, message, "use fewer strands"}
                                          : internal_error(message);
}

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::~RayScene() = default;

Result<std::unique_ptr<RayScene>> RayScene::build(const Groom& groom, std::span<const Mesh> surfaces) {
  CUTICLE_TRY(validate(groom));
  auto impl = std::make_unique<Impl>();
  CUTICLE_TRY(impl->build(groom, surfaces));
  return std::unique_ptr<RayScene>(new RayScene(std::move(impl)));
}

RayHit RayScene::closest(const glm::dvec3& origin, const glm::dvec3& direction, const FibreLeft& from) const {
  Query query{{}, impl_.get(), origin, direction, from, std::numeric_limits<double>::infinity()};
  rtcInitIntersectContext(&query.context);
  RTCRayHit found{};
  begin(found.ray, query);
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &query.context, &found);
  RayHit hit;
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.distance = query.limit;
  if (found.hit.geomID == k_fibres) {
    const RaySegment& segment = impl_->segments[found.hit.primID];
    hit.kind = RayHit::Kind::fibre;
    hit.strand = segment.strand;
    hit.vertex = segment.first;
  } else {
    hit.kind = RayHit::Kind::surface;
    hit.surface = found.hit.geomID - k_fibres - 1;
    hit.triangle = found.hit.primID;
    hit.barycentrics = {double(found.hit.u), double(found.hit.v)};
  }
  return hit;
}

bool RayScene::is_blocked(const glm::dvec3& origin, const glm::dvec3& direction, double distance,
                          const FibreLeft& from) const {
  Query query{{}, impl_.get(), origin, direction, from, distance};
  rtcInitIntersectContext(&query.context);
  RTCRay ray{};
  begin(ray, query);
  rtcOccluded1(impl_->scene, &query.context, &ray);
  return ray.tfar < 0;
}

std::size_t RayScene::memory_bytes() const { return impl_->bytes; }

}  // namespace cuticle::strands
