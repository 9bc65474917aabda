#include "strands/rays/detail/embree_scene.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/core.h>

namespace cuticle::strands {

namespace {

/// Embree's single precision misses rays near the surface of long segments, and finds rays that pass beside a segment
/// (of curled hair one crossing in forty): it is asked for fibres a little wider, and what it finds is tested in
/// double.
constexpr float k_wider = 1.02f;
/// Its hits on cubic curves are off by up to 5 % of the radius.
constexpr float k_curves_wider = 1.06f;
/// Straight pieces that Embree takes a span of a flat curve for.
constexpr float k_flat_pieces = 8;

/// What rounding may take off the box of a scene, metres.
constexpr double k_box_slack = 1e-4;

bool count_memory(void* total, ssize_t bytes, bool) {
  *static_cast<std::atomic<std::size_t>*>(total) += std::size_t(bytes);
  return true;
}

/// Null: no memory.
template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count, unsigned slot = 0) {
  return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, slot, format, sizeof(T), count));
}

/// `count` spheres as Embree's vertices of a time step; sphere(i): position and radius.
void fill_vertices(RTCGeometry geometry, unsigned step, std::size_t count, float wider, const auto& sphere) {
  auto* vertices = new_buffer<glm::vec4>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, count, step);
  for (std::size_t i = 0; vertices && i < count; ++i) vertices[i] = sphere(i) * glm::vec4(1, 1, 1, wider);
}

/// Corners of triangles at a time step.
void fill_corners(RTCGeometry geometry, unsigned step, std::span<const glm::vec3> positions) {
  auto* corners = new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions.size(), step);
  if (corners) std::ranges::copy(positions, corners);
}

RTCGeometryType geometry_of(CurveKind kind) {
  switch (kind.basis) {
    case SplineBasis::linear:
      return RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE;
    case SplineBasis::bezier:
      return kind.is_flat ? RTC_GEOMETRY_TYPE_FLAT_BEZIER_CURVE : RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE;
    case SplineBasis::b_spline:
      return kind.is_flat ? RTC_GEOMETRY_TYPE_FLAT_BSPLINE_CURVE : RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE;
    case SplineBasis::catmull_rom:
      break;
  }
  return kind.is_flat ? RTC_GEOMETRY_TYPE_FLAT_CATMULL_ROM_CURVE : RTC_GEOMETRY_TYPE_ROUND_CATMULL_ROM_CURVE;
}

}  // namespace

std::vector<RaySegment> segments_of(const Groom& groom, bool with_length) {
  std::vector<RaySegment> segments;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v)
      if ((groom.positions[v] != groom.positions[v + 1]) == with_length) segments.push_back({v, s});
  return segments;
}

std::vector<glm::vec4> spheres_of(const Groom& groom) {
  std::vector<glm::vec4> spheres;
  spheres.reserve(groom.vertex_count());
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) spheres.emplace_back(groom.positions[v], groom.radii[v]);
  return spheres;
}

RTCRay ray_of(const glm::dvec3& origin, const glm::dvec3& direction) {
  RTCRay ray{};
  ray.org_x = float(origin.x);
  ray.org_y = float(origin.y);
  ray.org_z = float(origin.z);
  ray.dir_x = float(direction.x);
  ray.dir_y = float(direction.y);
  ray.dir_z = float(direction.z);
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0u;
  return ray;
}

EmbreeScene::~EmbreeScene() {
  if (scene_) rtcReleaseScene(scene_);
  if (device_) rtcReleaseDevice(device_);
}

Result<void> EmbreeScene::open(RTCBuildQuality quality) {
  device_ = rtcNewDevice(nullptr);
  if (!device_) return internal_error(fmt::format("Embree gave no device (error {})", int(rtcGetDeviceError(nullptr))));
  rtcSetDeviceMemoryMonitorFunction(device_, count_memory, &bytes_);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_, quality);
  return {};
}

void EmbreeScene::attach(RTCGeometry geometry, unsigned id, RTCFilterFunctionN filter) {
  rtcSetGeometryIntersectFilterFunction(geometry, filter);
  rtcSetGeometryOccludedFilterFunction(geometry, filter);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, id);
  rtcReleaseGeometry(geometry);
}

/// Each segment is a round cone with both its end spheres (flags 0).
void EmbreeScene::add_segments(std::span<const glm::vec4> spheres, std::span<const glm::vec4> spheres_at_end,
                               std::span<const RaySegment> segments, unsigned id, RTCFilterFunctionN filter) {
  if (segments.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  if (!spheres_at_end.empty()) rtcSetGeometryTimeStepCount(geometry, 2);
  fill_vertices(geometry, 0, spheres.size(), k_wider, [&](std::size_t v) { return spheres[v]; });
  if (!spheres_at_end.empty())
    fill_vertices(geometry, 1, spheres.size(), k_wider, [&](std::size_t v) { return spheres_at_end[v]; });
  auto* indices = new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, segments.size());
  auto* flags = new_buffer<std::uint8_t>(geometry, RTC_BUFFER_TYPE_FLAGS, RTC_FORMAT_UCHAR, segments.size());
  if (indices) std::ranges::transform(segments, indices, &RaySegment::first);
  if (flags) std::fill_n(flags, segments.size(), std::uint8_t(0));
  attach(geometry, id, filter);
}

void EmbreeScene::add_curves(CurveKind kind, std::span<const glm::vec4> controls,
                             std::span<const glm::vec4> controls_at_end, std::span<const std::uint32_t> first,
                             unsigned id, RTCFilterFunctionN filter) {
  if (first.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_, geometry_of(kind));
  if (kind.is_flat && kind.basis != SplineBasis::linear) rtcSetGeometryTessellationRate(geometry, k_flat_pieces);
  if (!controls_at_end.empty()) rtcSetGeometryTimeStepCount(geometry, 2);
  fill_vertices(geometry, 0, controls.size(), k_curves_wider, [&](std::size_t i) { return controls[i]; });
  if (!controls_at_end.empty())
    fill_vertices(geometry, 1, controls.size(), k_curves_wider, [&](std::size_t i) { return controls_at_end[i]; });
  auto* indices = new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, first.size());
  if (indices) std::ranges::copy(first, indices);
  attach(geometry, id, filter);
}

bool EmbreeScene::may_meet(const glm::dvec3& origin, const glm::dvec3& direction) const {
  double enters = 0, leaves = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = lower_[axis] - origin[axis], high = upper_[axis] - origin[axis];
    if (direction[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / direction[axis], b = high / direction[axis];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves;
}

void EmbreeScene::add_points(std::span<const glm::vec4> spheres, std::span<const RaySegment> points, unsigned id,
                             RTCFilterFunctionN filter) {
  if (points.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  fill_vertices(geometry, 0, points.size(), k_wider, [&](std::size_t i) { return spheres[points[i].first]; });
  attach(geometry, id, filter);
}

void EmbreeScene::add_mesh(const Mesh& mesh, std::span<const glm::vec3> positions_at_end, unsigned id,
                           RTCFilterFunctionN filter) {
  if (mesh.triangles.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!positions_at_end.empty()) rtcSetGeometryTimeStepCount(geometry, 2);
  fill_corners(geometry, 0, mesh.positions);
  if (!positions_at_end.empty()) fill_corners(geometry, 1, positions_at_end);
  auto* triangles = new_buffer<std::array<std::uint32_t, 3>>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                             mesh.triangles.size());
  if (triangles) std::ranges::copy(mesh.triangles, triangles);
  attach(geometry, id, filter);
}

Result<void> EmbreeScene::commit(std::size_t segments) {
  rtcCommitScene(scene_);
  const RTCError error = rtcGetDeviceError(device_);
  if (error == RTC_ERROR_NONE) {
    RTCBounds box{};
    rtcGetSceneBounds(scene_, &box);
    lower_ = glm::dvec3(box.lower_x, box.lower_y, box.lower_z) - k_box_slack;
    upper_ = glm::dvec3(box.upper_x, box.upper_y, box.upper_z) + k_box_slack;
    return {};
  }
  const std::string message =
      fmt::format("Embree could not build a tree over {} segments (error {})", segments, int(error));
  return error == RTC_ERROR_OUT_OF_MEMORY ? Error{ErrorKind::out_of_memory, message, "use fewer strands"}
                                          : internal_error(message);
}

}  // namespace cuticle::strands
