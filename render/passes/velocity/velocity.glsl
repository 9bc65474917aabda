// The grid over the hair and the two cameras; velocity_gpu.cpp holds the same fields. Displacements are those of a
// frame, metres.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"

layout(std430, binding = 0) readonly buffer Frame {
  mat4 world_to_clip_before;  // of the frame before
  vec4 eye, right, up, forward;  // right and up as long as half the picture at distance 1
  vec4 lower;                 // of the grid
  vec4 nodes_per_metre;
  uint nodes;                 // along each axis
  uint vertex_count;
  uvec2 resolution;
  float frame_duration;  // what velocities are multiplied by; 0: control vertices come with where they were before
  uint has_scene;        // 1: what is no hair moves too
  vec2 pixel_shift;      // of the picture, to the right and down
};

vec3 moved(vec4 now, vec4 motion) { return frame_duration > 0.0 ? frame_duration * motion.xyz : now.xyz - motion.xyz; }

uint node_index(uvec3 node) { return (node.z * nodes + node.y) * nodes + node.x; }

// Where a point lies among the nodes: the first of the eight around it, and its shares of the way to the next.
uvec3 node_below(vec3 place, out vec3 share) {
  vec3 at = clamp((place - lower.xyz) * nodes_per_metre.xyz, vec3(0.0), vec3(float(nodes - 1u)));
  uvec3 below = min(uvec3(at), uvec3(nodes - 2u));
  share = at - vec3(below);
  return below;
}

// The weight of corner 0 .. 7 in trilinear interpolation, and its node.
float corner_of(uvec3 below, vec3 share, uint corner, out uint node) {
  uvec3 side = uvec3(corner & 1u, corner >> 1 & 1u, corner >> 2);
  node = node_index(below + side);
  vec3 weights = mix(1.0 - share, share, vec3(side));
  return weights.x * weights.y * weights.z;
}
