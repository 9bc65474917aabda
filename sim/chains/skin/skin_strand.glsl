// Where a skin carries a strand as a rigid body, on the device.
#include "sim/chains/skin/skin_turn.glslh"

// SkinStrand of on_skin.h.
struct SkinStrand {
  vec4 along, across, root;  // unit, at rest; along.w: whether the strand bends; rest place of the anchor
  uvec4 vertices;            // anchor, farthest, side
};

SkinTurn turn_of(SkinStrand s, vec3 anchor, vec3 farthest, vec3 side) {
  return skin_turn(s.along.xyz, s.across.xyz, farthest - anchor, side - anchor, s.along.w > 0);
}
