#version 460
#extension GL_GOOGLE_include_directive : require
// One thread per drawn strand: how its vertices move, a moment later less a moment earlier, the head held still.
#include "gpu/groups.glsl"
#include "strands/tangent.glslh"

layout(local_size_x = 64) in;
layout(binding = 1) uniform samplerBuffer controls;                              // world positions
layout(binding = 2) uniform samplerBuffer motion;                                // velocities, or positions before
layout(std430, binding = 3) writeonly buffer Velocities { vec4 velocities[]; };  // of this dispatch's strands, m/s

const float k_moment = 1e-3;  // seconds: hair moves a small part of a segment, and many rounding errors
float moment;                 // along the velocities

vec3 motion_at(uint k) { return texelFetch(motion, int(k)).xyz; }
vec3 control_at(uint k) { return texelFetch(controls, int(k)).xyz + moment * motion_at(k); }
#include "strands/spline/place.glsl"

// Of a follow hair's offset: its turn is the guide's first segment's.
vec3 offset_velocity(Row row) {
  if (since > 0.0) return vec3(0.0);
  moment = k_moment;
  const vec3 later = offset_now(row);
  moment = -k_moment;
  const vec3 earlier = offset_now(row);
  return (later - earlier) / (2.0 * k_moment);
}

vec3 velocity_of(uint vertex) {
  return since > 0.0 ? (texelFetch(controls, int(vertex)).xyz - motion_at(vertex)) / since : motion_at(vertex);
}

void main() {
  const uint strand = invocation();
  if (strand >= strands) return;
  const Row row = rows[first_strand + strand];
  const vec3 turning = offset_velocity(row);
  for (uint i = 0u; i < size; ++i) {
    const Place at = place_of(row, i);
    const vec3 own = mix(velocity_of(row.first + at.k), velocity_of(row.first + at.next), at.share);
    const float along = (float(at.k) + at.share) / float(row.size);
    velocities[strand * size + i] = vec4(own + turning * (1.0 + row.offset.w * along), 0.0);
  }
}
