// A workgroup of eight per tile, each invocation a column with its eight pixels. Eight segments at a time are set up,
// one each, and drawn by all in the order of the tile's list. The loop over the eight is unrolled: the loops of an
// invocation may make 65,535 turns together on lavapipe, after which it leaves them. The shader that includes this
// defines set_aside() and take(), and includes exchange_shared.glsl or exchange_records.glsl.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cuticle/render/passes/tile_lists/tile_of_group.glsl"
#include "cuticle/render/passes/tiles/stroke.glsl"
#include "cuticle/render/seen.glsl"

layout(constant_id = 0) const uint k_says_seen = 0u;  // 1: `seen` is wanted

layout(std430, binding = 2) readonly buffer Offsets { uint offsets[]; };
layout(binding = 3) uniform usamplerBuffer ordered;  // uvec2 an entry
layout(std430, binding = 4) readonly buffer SceneDepth { float scene_depth[]; };
layout(std430, binding = 5) writeonly buffer Picture { uvec2 picture[]; };  // radiance times alpha, alpha
layout(std430, binding = 6) writeonly buffer Depth { float mean_depth[]; };  // 1 / distance, weighted by what is seen
layout(std430, binding = 7) writeonly buffer SeenSegments { Seen seen[]; };

const float k_opaque = 1.0 / 1024.0;  // what lies behind so little transmittance is left out

// Of the column's pixels: what is let through, the scene's depth, what has been blended.
float through[k_tile], scene[k_tile], depth[k_tile], most_seen[k_tile];
vec3 light[k_tile];
uint seen_vertex[k_tile], samples[k_tile], looked_at;

// Whether a segment whose 1 / depth in the tile lies between the two is left out of what is being drawn.
bool set_aside(float least, float most);

// A segment covers a share of a pixel of the column, in front of the scene.
void take(int row, uint vertex, float covered, vec3 color, float inverse_depth);

uint vertex_of(uint entry) { return texelFetch(ordered, int(2u * entry + 1u)).r; }

// Width is that where the segment passes the tile's middle.
Prepared set_up(uint entry, uint end, vec2 tile_middle) {
  bool used = entry < end;
  uint vertex = vertex_of(min(entry, end - 1u));
  Stroke own = stroke_from(vertex);
  float half_length = own.half_length, len = 2.0 * half_length, reach = 0.7072 * float(k_tile);
  float s = dot(tile_middle, own.axis.xy) + own.axis.w;
  float half_width = own.half_width + own.width_slope * clamp(s, -half_length, half_length);
  vec2 ends = own.inverse_depth + own.depth_slope * clamp(vec2(s - reach, s + reach), -half_length, half_length);
  used = used && !set_aside(min(ends.x, ends.y), max(ends.x, ends.y));
  float per_pixel = len > k_shortest ? 1.0 / len : 0.0;
  return Prepared(own.axis,
                  vec4(half_width + 0.5, used ? min(1.0, 2.0 * half_width) * push.opacity : 0.0, half_length + 0.5,
                       min(1.0, len)),
                  vec4(0.5 * (own.first + own.last), own.inverse_depth),
                  vec4((own.last - own.first) * per_pixel, own.depth_slope), vertex);
}

// The first pixel of a tile of the part that is drawn.
uvec2 corner_of(uint tile) { return uvec2(tile % tile_grid().x, tile / tile_grid().x) * uint(k_tile); }

void begin_column(uint lane, uvec2 corner) {
  uint column = min(corner.x + lane, push.part.x - 1u);
  looked_at = 0u;
  [[unroll]] for (int row = 0; row < k_tile; ++row) {
    uint y = min(corner.y + uint(row), push.part.y - 1u);
    through[row] = 1.0;
    depth[row] = most_seen[row] = 0.0;
    scene[row] = scene_depth[y * push.part.x + column];
    light[row] = vec3(0.0);
    seen_vertex[row] = samples[row] = 0u;
  }
}

// The tile's segments first .. first + 7, those below `end`.
void draw_eight(uint lane, uint first, uint end, uvec2 corner) {
  vec2 in_picture = vec2(corner + first_pixel()), top = in_picture + vec2(lane, 0.0) + 0.5;
  vec2 tile_middle = in_picture + 0.5 * float(k_tile);
  begin_eight(first, end, tile_middle);
  [[unroll]] for (uint k = 0u; k < k_lanes; ++k) {
    Prepared own = prepared(k, first, end, tile_middle);
    vec4 line = own.axis, size = own.extent, middle = own.shade, change = own.slope;
    float across = line.x * top.y - line.y * top.x + line.z, along = line.x * top.x + line.y * top.y + line.w;
    float half_length = size.z - 0.5;
    [[unroll]] for (int row = 0; row < k_tile; ++row) {
      float at = clamp(along, -half_length, half_length), inverse_depth = middle.w + at * change.w;
      float covered = clamp((size.x - abs(across)) * push.opacity, 0.0, size.y);
      covered *= clamp(size.z - abs(along), 0.0, size.w);
      take(row, own.vertex, inverse_depth >= scene[row] ? covered : 0.0, middle.rgb + at * change.rgb,
           inverse_depth);
      across += line.x;
      along += line.y;
    }
  }
}

// Whether every pixel of the tile lets through too little for what lies behind to be seen.
bool is_closed() {
  float most = 0.0;
  [[unroll]] for (int row = 0; row < k_tile; ++row) most = max(most, through[row]);
  return is_below_in_all(most, k_opaque);
}

void end_column(uint lane, uvec2 corner) {
  uint column = corner.x + lane;
  [[unroll]] for (int row = 0; row < k_tile; ++row) {
    uint y = corner.y + uint(row);
    if (column < push.part.x && y < push.part.y) {
      uint pixel = y * push.part.x + column;
      float alpha = 1.0 - through[row];
      picture[pixel] = uvec2(packHalf2x16(light[row].rg), packHalf2x16(vec2(light[row].b, alpha)));
      mean_depth[pixel] = alpha > 0.0 ? depth[row] / alpha : 0.0;
      uint first = seen_vertex[row], last = samples[row] > 0u ? first + 1u : first;
      if (k_says_seen != 0u) seen[pixel] = Seen(first, last, alpha, samples[row], looked_at);
    }
  }
}
