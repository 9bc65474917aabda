// One invocation per segment: visits the tiles that it may cover in front of the scene. The shader that includes this
// defines visit().
#include "cuticle/gpu/groups.glsl"
#include "cuticle/render/passes/lines/strand_chance.glsl"
#include "cuticle/render/passes/tile_lists/segment.glsl"

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Tangents { vec4 tangents[]; };
layout(std430, binding = 2) readonly buffer Segments { uint segments[]; };
layout(std430, binding = 3) readonly buffer TileDepth { float tile_depth[]; };  // 1 / distance of the farthest scene

const float k_half_tile = 0.5 * float(k_tile - 1);  // from the middle to the outermost pixel's centre
const uint k_thinning = 5u;                         // purpose of a chance

/// A tile that the segment may cover, and 1 / its depth where it passes the tile's middle.
void visit(uint tile, uint vertex, float inverse_depth);

// A segment that chance takes away: the tip of a strand, or one of too many.
bool is_kept(uint vertex) {
  return tangents[vertex + 1u].w <= kept_length(vertex / push.vertices_per_strand, push.tip_variation) &&
         mixed(vertex, k_thinning) < push.kept_share;
}

// How many tiles were visited.
uint walk(uint vertex, Projected p) {
  vec2 along = abs(p.direction), across = along.yx;
  float beyond = k_half_tile * (along.x + along.y) + 0.5;
  float widest = p.half_width + abs(p.width_slope) * p.half_length;
  vec2 reach = along * (p.half_length + 0.5) + across * (widest + 0.5);
  ivec2 begin = ivec2(first_tile()), grid = ivec2(tile_grid());
  ivec2 least = max(ivec2(floor((p.middle - reach) / float(k_tile))), begin);
  ivec2 most = min(ivec2(floor((p.middle + reach) / float(k_tile))), begin + grid - 1);
  uint visits = 0u;
  for (int y = least.y; y <= most.y; ++y)
    for (int x = least.x; x <= most.x; ++x) {
      vec2 from_middle = (vec2(x, y) + 0.5) * float(k_tile) - p.middle;
      float s = dot(from_middle, p.direction), d = p.direction.x * from_middle.y - p.direction.y * from_middle.x;
      float at = clamp(s, -p.half_length, p.half_length), inverse_depth = p.inverse_depth + p.depth_slope * at;
      float nearest = inverse_depth + abs(p.depth_slope) * beyond;
      float half_width = p.half_width + p.width_slope * at;  // the fine rasteriser's for this tile
      uint tile = uint((y - begin.y) * grid.x + x - begin.x);
      if (abs(d) <= half_width + beyond && abs(s) <= p.half_length + beyond && nearest >= tile_depth[tile]) {
        visit(tile, vertex, inverse_depth);
        ++visits;
      }
    }
  return visits;
}
