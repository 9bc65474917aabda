// What a strand segment leaves in a volume; needs map_geometry.glsl, vertices and segments.
#include "shadows/splat.glslh"
#include "shadows/voxel/volume.glslh"

layout(std430, binding = 3) readonly buffer Table { uint table[]; };  // deposits, then the two numbers of a crossing

const uint k_anisotropic = 2u;  // k_anisotropic_flag of voxel_gpu.cpp

struct SegmentDeposit {
  vec3 a, b;
  float width;
  uint lanes, pieces, amount;  // of each lane's piece
};
SegmentDeposit segment_deposit(VolumePlacement placement, uint s) {
  const int parts = int(segment_parts()), v = int(texelFetch(segments, int(s) * parts).r);
  const vec4 a = drawn_vertex(uint(v)), b = drawn_vertex(uint(v + parts));
  precise vec3 along = b.xyz - a.xyz;
  precise float width = a.w + b.w;
  const uint pieces = volume_pieces(placement, exact_length(along));
  const float shown = shown_length(along, -push.forward.xyz, (push.flags & k_anisotropic) != 0u);
  const float units = uintBitsToFloat(table[k_coverage_steps + 1u]);
  const float meeting = uintBitsToFloat(table[k_coverage_steps + 2u]);
  const uint lanes = lane_count(placement, width);
  return SegmentDeposit(a.xyz, b.xyz, width, lanes, pieces,
                        piece_deposit(placement, units, meeting, width, shown, lanes * pieces));
}

/// Where piece `i` of all lanes lies, in cells.
vec3 deposit_place(VolumePlacement placement, SegmentDeposit deposit, uint i) {
  precise vec3 along = deposit.b - deposit.a;
  const vec3 offset =
      lane_offset(along, -push.forward.xyz, deposit.width, i / deposit.pieces, deposit.lanes);
  return piece_in_cells(placement, moved_by(deposit.a, offset), moved_by(deposit.b, offset), i % deposit.pieces,
                        deposit.pieces);
}
