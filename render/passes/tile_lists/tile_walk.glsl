// One invocation per segment: visits the tiles that it may cover in front of the scene. The shader that includes this
// defines visit().
#include "gpu/groups.glsl"
#include "render/randomness/strand_chance.glsl"
#include "render/passes/tile_lists/segment.glsl"
#define PARTS_CONSTANT 0
#include "render/passes/tile_lists/segment_parts.glsl"

#define VERTICES_BINDING 0
#define TANGENTS_BINDING 1
#include "strands/spline/drawn.glsl"
layout(binding = 2) uniform usamplerBuffer segments;   // of all parts
layout(binding = 3) uniform samplerBuffer tile_depth;  // 1 / distance of the farthest scene

const float k_half_tile = 0.5 * float(k_tile);
const uint k_thinning = 5u;                         // purpose of a chance

uint first_vertex(uint segment) { return texelFetch(segments, int(segment * k_parts)).r; }

/// A tile that the segment may cover, and 1 / its depth where it passes the tile's middle.
void visit(uint tile, uint vertex, float inverse_depth);

// Not of a strand that chance takes away, one of too many, nor of the tip of one that it cuts.
bool is_kept(uint vertex) {
  const uint strand = vertex / push.vertices_per_strand;
  return mixed(strand, k_thinning) < push.kept_share &&
         drawn_tangent(vertex + k_parts).w <= kept_length(strand, push.tip_variation);
}

bool visits(uint vertex, Projected p, ivec2 at, ivec2 begin, float beyond) {
  vec2 from_middle = (vec2(at) + 0.5) * float(k_tile) - p.middle;
  float s = dot(from_middle, p.direction), d = p.direction.x * from_middle.y - p.direction.y * from_middle.x;
  float on_axis = clamp(s, -p.half_length, p.half_length), inverse_depth = p.inverse_depth + p.depth_slope * on_axis;
  float nearest = inverse_depth + abs(p.depth_slope) * beyond;
  float half_width = p.half_width + p.width_slope * on_axis;  // the fine rasteriser's for this tile
  uint tile = uint((at.y - begin.y) * int(tile_grid().x) + at.x - begin.x);
  bool visited = abs(d) <= half_width + beyond && abs(s) <= p.half_length + cap_of(half_width) + beyond &&
                 nearest >= texelFetch(tile_depth, int(tile)).r;
  if (visited) visit(tile, vertex, inverse_depth);
  return visited;
}

// How many tiles were visited. The loop ends at its last line: on lavapipe one that asks first runs its body once more.
uint walk(uint vertex, Projected p) {
  vec2 along = abs(p.direction), across = along.yx;
  float beyond = k_half_tile * (along.x + along.y);  // to the tile's farthest corner
  float widest = p.half_width + abs(p.width_slope) * p.half_length;
  vec2 reach = along * (p.half_length + 0.5) + across * (widest + 0.5);
  ivec2 begin = ivec2(first_tile()), grid = ivec2(tile_grid());
  ivec2 least = max(ivec2(floor((p.middle - reach) / float(k_tile))), begin);
  ivec2 most = min(ivec2(floor((p.middle + reach) / float(k_tile))), begin + grid - 1), at = least;
  uint count = 0u;
  do {
    if (at.x <= most.x && at.y <= most.y) count += visits(vertex, p, at, begin, beyond) ? 1u : 0u;
    bool is_last = at.x >= most.x;
    at = is_last ? ivec2(least.x, at.y + 1) : ivec2(at.x + 1, at.y);
  } while (at.y <= most.y);
  return count;
}
