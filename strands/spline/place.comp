#version 460
#extension GL_GOOGLE_include_directive : require
// One thread per drawn strand: its vertices as they are given, tangents and fractions of the length.
#include "gpu/groups.glsl"
#include "strands/tangent.glslh"

layout(local_size_x = 64) in;
layout(binding = 1) uniform samplerBuffer controls;                          // world positions
layout(std430, binding = 2) readonly buffer Radii { float radii[]; };        // per control vertex
layout(std430, binding = 3) writeonly buffer Vertices { vec4 vertices[]; };  // of this dispatch's strands: position, radius
layout(std430, binding = 4) writeonly buffer Tangents { vec4 tangents[]; };  // unit tangent, fraction of the length

vec3 control_at(uint k) { return texelFetch(controls, int(k)).xyz; }
#include "strands/spline/place.glsl"

void main() {
  const uint strand = invocation();
  if (strand >= strands) return;
  const Row row = rows[first_strand + strand];
  const vec3 offset = offset_now(row), root = placed_at(row, offset, 0u), tip = placed_at(row, offset, last_vertex(row));
  float whole = 0.0;
  vec3 before = root;
  for (uint i = 1u; i <= last_vertex(row); ++i) {
    const vec3 point = placed_at(row, offset, i);
    whole += distance(before, point);
    before = point;
  }
  float along = 0.0;
  vec3 here = root;
  before = root;
  for (uint i = 0u; i < size; ++i) {
    const Place at = place_of(row, i);
    const vec3 after = placed_at(row, offset, i + 1u);
    const float fraction = whole > 0.0 ? min(along / whole, 1.0) : float(min(i, last_vertex(row))) / float(last_vertex(row));
    vertices[strand * size + i] = vec4(here, mix(radii[row.first + at.k], radii[row.first + at.next], at.share) * row.thickness);
    tangents[strand * size + i] = vec4(vertex_tangent(before, after, root, tip), fraction);
    along += distance(here, after);
    if (i < last_vertex(row)) before = here;
    here = after;
  }
}
