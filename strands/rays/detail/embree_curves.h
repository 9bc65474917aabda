#pragma once
// Strands as Embree's round linear curves; for the sources of this folder alone.
#include <algorithm>
#include <cstdint>
#include <span>

#include <embree3/rtcore.h>
#include <glm/vec4.hpp>

namespace cuticle::strands {

/// A segment of a strand, by its first vertex.
struct RaySegment {
  std::uint32_t first = 0, strand = 0;
};

/// Embree's single precision misses rays near the surface of long segments, and finds rays that pass beside a segment
/// (of curled hair one crossing in forty): it is asked for fibres a little wider, and what it finds is tested in
/// double.
constexpr float k_wider = 1.02f;

/// `count` spheres as Embree's vertices; sphere(i): position and radius. Null: no memory.
bool fill_vertices(RTCGeometry geometry, std::size_t count, const auto& sphere) {
  auto* vertices = static_cast<glm::vec4*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(glm::vec4), count));
  if (!vertices) return false;
  for (std::size_t i = 0; i < count; ++i) vertices[i] = sphere(i) * glm::vec4(1, 1, 1, k_wider);
  return true;
}

/// Each segment is a round cone with both its end spheres (flags 0).
inline void fill_segments(RTCGeometry geometry, std::span<const RaySegment> segments) {
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, 4, segments.size()));
  auto* flags = static_cast<std::uint8_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_FLAGS, 0, RTC_FORMAT_UCHAR, 1, segments.size()));
  if (!indices || !flags) return;
  for (std::size_t i = 0; i < segments.size(); ++i) indices[i] = segments[i].first;
  std::fill_n(flags, segments.size(), std::uint8_t(0));
}

}  // namespace cuticle::strands
