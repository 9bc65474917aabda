#version 460
// Strands as lines: two vertices a segment, pulled from the drawn strands' buffers. Transmittance comes per strand vertex.
#extension GL_GOOGLE_include_directive : require
#include "lines_frame.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, set = 0, binding = 1) readonly buffer Tangents { vec4 tangents[]; };
layout(std430, set = 0, binding = 2) readonly buffer Segments { uint segments[]; };
layout(std430, set = 0, binding = 3) readonly buffer Transmittance { float transmittance[]; };

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 tangent;
layout(location = 2) out vec4 reached[2];
layout(location = 4) flat out float brightness;

// A number in [0, 1) for a strand and a purpose: a bit mixer (multiply and shift), the same on every device.
float mixed(uint strand, uint purpose) {
  uint bits = strand * 0x9E3779B1u + purpose * 0x85EBCA77u;
  bits = (bits ^ (bits >> 15)) * 0x2C1B3C6Du;
  bits = (bits ^ (bits >> 12)) * 0x297A2D39u;
  return float((bits ^ (bits >> 15)) >> 8) * (1.0 / 16777216.0);
}

void main() {
  uint vertex = segments[gl_VertexIndex >> 1] + uint(gl_VertexIndex & 1);
  uint strand = vertex / vertices_per_strand;
  vec3 tilt = vec3(mixed(strand, 0u), mixed(strand, 1u), mixed(strand, 2u)) - 0.5;
  position = vertices[vertex].xyz;
  tangent = tangents[vertex].xyz + variation * tilt;
  brightness = 1.0 + variation * (2.0 * mixed(strand, 3u) - 1.0);
  for (uint k = 0u; k < 8u; ++k)
    reached[k >> 2][k & 3u] = k < light_count ? transmittance[k * vertex_count + vertex] : 0.0;
  // A strand that chance cuts short ends in a segment of no length, outside the view.
  uint last = segments[gl_VertexIndex >> 1] + 1u;
  bool kept = tangents[last].w <= 1.0 - tip_variation * mixed(strand, 4u);
  gl_Position = kept ? world_to_clip * vec4(position, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
