#version 460
#extension GL_GOOGLE_include_directive : require
// One thread per drawn strand: how its vertices move, a moment later less a moment earlier, the head held still.
#include "gpu/groups.glsl"
#include "strands/tangent.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 1) readonly buffer Controls { vec4 controls[]; };       // world positions
layout(std430, binding = 2) readonly buffer Motion { vec4 motion[]; };           // velocities, or positions before
layout(std430, binding = 3) writeonly buffer Velocities { vec4 velocities[]; };  // m/s

const float k_moment = 1e-3;  // seconds: hair moves a small part of a segment, and many rounding errors
float moment;                 // along the velocities

vec3 control_at(uint k) { return controls[k].xyz + moment * motion[k].xyz; }
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
  return since > 0.0 ? (controls[vertex].xyz - motion[vertex].xyz) / since : motion[vertex].xyz;
}

void main() {
  const uint strand = invocation();
  if (strand >= strands) return;
  const Row row = rows[strand];
  const vec3 turning = offset_velocity(row);
  for (uint i = 0u; i < size; ++i) {
    const Place at = place_of(row, i);
    const vec3 own = mix(velocity_of(row.first + at.k), velocity_of(row.first + at.next), at.share);
    const float along = (float(at.k) + at.share) / float(row.size);
    velocities[strand * size + i] = vec4(own + turning * (1.0 + row.offset.w * along), 0.0);
  }
}
