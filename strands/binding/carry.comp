#version 460
#extension GL_GOOGLE_include_directive : require
// H2: one thread per control vertex: its place in the frame of its root on the moved mesh.
#include "gpu/groups.glsl"
#include "strands/binding/surface_frame.glslh"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer MeshPositions { vec4 mesh_positions[]; };
layout(std430, binding = 1) readonly buffer MeshNormals { vec4 mesh_normals[]; };
layout(std430, binding = 2) readonly buffer Corners { uvec4 corners[]; };       // per strand
layout(std430, binding = 3) readonly buffer Weights { vec4 weights[]; };        // per strand
layout(std430, binding = 4) readonly buffer Locals { vec4 locals[]; };          // per vertex
layout(std430, binding = 5) readonly buffer Strands { uint strand_of[]; };      // per vertex
layout(std430, binding = 6) writeonly buffer Positions { vec4 positions[]; };
layout(push_constant) uniform Constants { uint count; };

void main() {
  const uint v = invocation();
  if (v >= count) return;
  const uint strand = strand_of[v];
  const uvec4 t = corners[strand];
  const SurfaceFrame frame =
      surface_frame(mesh_positions[t.x].xyz, mesh_positions[t.y].xyz, mesh_positions[t.z].xyz, mesh_normals[t.x].xyz,
                    mesh_normals[t.y].xyz, mesh_normals[t.z].xyz, weights[strand].xyz);
  positions[v] = vec4(from_frame(frame, locals[v].xyz), 0);
}
