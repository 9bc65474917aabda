#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per segment: its pieces add to the cells of their middles by integer sums.
layout(local_size_x = 64) in;
#include "shadows/map_geometry.glsl"
#include "shadows/splat.glslh"
#include "shadows/voxel/volume.glslh"

layout(binding = 0) uniform samplerBuffer vertices;
layout(binding = 1) uniform usamplerBuffer segments;
layout(std430, binding = 2) readonly buffer Box { uint least[6]; };
layout(std430, binding = 3) readonly buffer Table { uint table[]; };  // deposits, then the two numbers of a crossing
layout(std430, binding = 4) buffer Sums { uint sums[]; };

const uint k_anisotropic = 2u;  // k_anisotropic_flag of voxel_gpu.cpp

void main() {
  const uint s = invocation();
  if (s >= push.count) return;
  const VolumePlacement placement = volume_placement(lower_of(least), upper_of(least), push.resolution);
  const int v = int(texelFetch(segments, int(s)).r);
  const vec4 a = texelFetch(vertices, v), b = texelFetch(vertices, v + 1);
  precise vec3 along = b.xyz - a.xyz;
  precise float width = a.w + b.w;
  const uint pieces = volume_pieces(placement, exact_length(along));
  const float shown = shown_length(along, -push.forward.xyz, (push.flags & k_anisotropic) != 0u);
  const float units = uintBitsToFloat(table[k_coverage_steps + 1u]);
  const float meeting = uintBitsToFloat(table[k_coverage_steps + 2u]);
  const uint amount = piece_deposit(placement, units, meeting, width, shown, pieces);
  for (uint i = 0u; i < pieces; ++i)
    atomicAdd(sums[cell_number(placement, piece_in_cells(placement, a.xyz, b.xyz, i, pieces))], amount);
}
