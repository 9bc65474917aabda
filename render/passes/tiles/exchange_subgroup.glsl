// The invocations of a tile are a subgroup, which lavapipe keeps in registers where it runs shared memory lane by lane.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_vote : require
#include "cuticle/render/passes/tiles/prepared.glsl"

Prepared offered;

uint own_lane() { return gl_SubgroupInvocationID; }

void offer(Prepared own) { offered = own; }

Prepared prepared_by(uint k) {
  return Prepared(subgroupBroadcast(offered.axis, k), subgroupBroadcast(offered.extent, k),
                  subgroupBroadcast(offered.shade, k), subgroupBroadcast(offered.slope, k),
                  subgroupBroadcast(offered.vertex, k));
}

bool is_below_in_all(float own, float limit) { return subgroupAll(own < limit); }
