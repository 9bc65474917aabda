#version 460
#extension GL_GOOGLE_include_directive : require
// H1: one thread per vertex of the growth mesh.
#include "gpu/groups.glsl"
#include "strands/skinning/skinning.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };  // bind pose; w is passed on
layout(std430, binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 2) readonly buffer Joints { uvec4 joints[]; };       // four per vertex
layout(std430, binding = 3) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 4) readonly buffer Motions { float motions[]; };     // 32 per joint: skinning.h, JointMotion
layout(std430, binding = 5) writeonly buffer MovedPositions { vec4 moved_positions[]; };
layout(std430, binding = 6) writeonly buffer MovedNormals { vec4 moved_normals[]; };
layout(push_constant) uniform Constants { uint count; uint dual; };

vec3 three(uint k) { return vec3(motions[k], motions[k + 1u], motions[k + 2u]); }
Affine affine_at(uint k) { return Affine(three(k), three(k + 3u), three(k + 6u), three(k + 9u)); }
DualQuaternion rigid_of(uint joint) {
  const uint k = 32u * joint + 24u;
  return DualQuaternion(three(k), motions[k + 3u], three(k + 4u), motions[k + 7u]);
}

void linear_blend(uint v) {
  Affine whole = no_affine();
  for (int k = 0; k < 4; ++k)
    if (weights[v][k] != 0.0) whole = add_affine(whole, affine_at(32u * joints[v][k]), weights[v][k]);
  moved_positions[v] = vec4(affine_point(whole, positions[v].xyz), positions[v].w);
  moved_normals[v] = vec4(direction_or(affine_normal(whole, normals[v].xyz), normals[v].xyz), 0);
}

void dual_quaternion(uint v) {
  Affine stretch = no_affine();
  DualQuaternion rigid = no_motion();
  const DualQuaternion pivot = rigid_of(joints[v][0]);
  for (int k = 0; k < 4; ++k) {
    if (weights[v][k] == 0.0) continue;
    stretch = add_affine(stretch, affine_at(32u * joints[v][k] + 12u), weights[v][k]);
    rigid = add_motion(rigid, rigid_of(joints[v][k]), pivot, weights[v][k]);
  }
  rigid = unit_motion(rigid);
  moved_positions[v] = vec4(motion_point(rigid, affine_point(stretch, positions[v].xyz)), positions[v].w);
  const vec3 normal = motion_direction(rigid, affine_normal(stretch, normals[v].xyz));
  moved_normals[v] = vec4(direction_or(normal, normals[v].xyz), 0);
}

void main() {
  const uint v = invocation();
  if (v >= count) return;
  if (dual != 0u)
    dual_quaternion(v);
  else
    linear_blend(v);
}
