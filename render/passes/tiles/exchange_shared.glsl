// The invocations of a tile speak through shared memory.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "render/passes/tiles/prepared.glsl"
#include "render/passes/tiles/projected_segment_vertices.glsl"

shared vec4 axis[k_lanes], extent[k_lanes], shade[k_lanes], slope[k_lanes];
shared uint first_vertex[k_lanes];
shared float values[k_lanes];

uint own_lane() { return gl_LocalInvocationID.x; }

void tell(Prepared own) {
  uint lane = own_lane();
  axis[lane] = own.axis;
  extent[lane] = own.extent;
  shade[lane] = own.shade;
  slope[lane] = own.slope;
  first_vertex[lane] = own.vertex;
  barrier();
}

const uint k_chunk = k_lanes;

// Each invocation sets up one, all draw all.
void draw_chunk(uint first, uint end, vec2 first_pixel, vec2 tile_corner) {
  tell(set_up(first + own_lane(), end, tile_corner + 0.5 * float(k_tile)));
  [[unroll]] for (uint k = 0u; k < k_lanes; ++k)
    draw(Prepared(axis[k], extent[k], shade[k], slope[k], first_vertex[k]), first_pixel);
}

bool is_below_in_all(float own, float limit) {
  values[own_lane()] = own;
  barrier();
  [[unroll]] for (uint k = 0u; k < k_lanes; ++k) own = max(own, values[k]);
  return own < limit;
}

float sum_in_all(float own) {
  values[own_lane()] = own;
  barrier();
  float sum = 0.0;
  [[unroll]] for (uint k = 0u; k < k_lanes; ++k) sum += values[k];
  barrier();
  return sum;
}
