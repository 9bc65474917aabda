#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
// Fine rasteriser: a workgroup of eight per tile, each invocation a column with its eight pixels in registers. Eight
// segments at a time are set up, one each, and drawn by all, from near to far. The loop over the eight is unrolled: the
// loops of an invocation may make 65,535 turns together on lavapipe, after which it leaves them.
layout(local_size_x = 8) in;
#include "cuticle/render/passes/tile_lists/segment.glsl"
#include "cuticle/render/seen.glsl"

layout(constant_id = 0) const uint k_says_seen = 0u;  // 1: `seen` is wanted

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Colors { uvec2 colors[]; };
layout(std430, binding = 2) readonly buffer Offsets { uint offsets[]; };
layout(std430, binding = 3) readonly buffer Sorted { uvec2 ordered[]; };
layout(std430, binding = 4) readonly buffer SceneDepth { float scene_depth[]; };
layout(std430, binding = 5) writeonly buffer Picture { uvec2 picture[]; };  // radiance times alpha, alpha
layout(std430, binding = 6) writeonly buffer Depth { float mean_depth[]; };  // 1 / distance, weighted by what is seen
layout(std430, binding = 7) writeonly buffer SeenSegments { Seen seen[]; };

const uint k_lanes = 8u;
const float k_opaque = 1.0 / 1024.0;  // what lies behind so little transmittance is left out
const uint k_stride = 7919u;  // a prime: neighbouring tiles, which cost alike, go to different threads of the device

// The axis: pixel q lies cross(xy, q) + z across it and dot(xy, q) + w along it. Extents and limits of the coverage
// across and along. Colour and 1 / depth at the middle of the axis, and how they change per pixel.
shared vec4 axis[k_lanes], extent[k_lanes], shade[k_lanes], slope[k_lanes];
shared float open[k_lanes];
shared uint first_vertex[k_lanes];

vec3 color_of(uint vertex) { return vec3(unpackHalf2x16(colors[vertex].x), unpackHalf2x16(colors[vertex].y).x); }

// Width is that where the segment passes the tile's middle.
void set_up(uint lane, uint entry, bool used, vec2 tile_middle) {
  uint vertex = ordered[entry].y;
  first_vertex[lane] = vertex;
  Projected p;
  project(vertices[vertex], vertices[vertex + 1u], p);
  vec3 root = color_of(vertex), tip = color_of(vertex + 1u);
  vec3 first = mix(root, tip, p.shares.x), last = mix(root, tip, p.shares.y);
  float len = 2.0 * p.half_length, s = dot(tile_middle - p.middle, p.direction);
  float half_width = p.half_width + p.width_slope * clamp(s, -p.half_length, p.half_length);
  axis[lane] = vec4(p.direction, p.direction.y * p.middle.x - p.direction.x * p.middle.y, -dot(p.direction, p.middle));
  extent[lane] = vec4(half_width + 0.5, used ? min(1.0, 2.0 * half_width) * push.opacity : 0.0,
                      p.half_length + 0.5, min(1.0, len));
  shade[lane] = vec4(0.5 * (first + last), p.inverse_depth);
  slope[lane] = vec4(len > k_shortest ? (last - first) / len : vec3(0.0), p.depth_slope);
}

uint spread(uint group, uint count) { return count % k_stride == 0u ? group : uint((group * k_stride) % count); }

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint tile = spread(gl_WorkGroupID.y * push.grid.x + gl_WorkGroupID.x, push.grid.x * push.grid.y);
  uint begin = min(offsets[tile], push.capacity), end = min(offsets[tile + 1u], push.capacity);
  uvec2 corner = uvec2(tile % push.grid.x, tile / push.grid.x) * uint(k_tile);
  uint column = corner.x + lane, last_column = min(column, push.resolution.x - 1u);
  vec2 top = vec2(column, corner.y) + 0.5;

  float through[k_tile], depth[k_tile], scene[k_tile];
  vec3 light[k_tile];
  float most_seen[k_tile];
  uint seen_vertex[k_tile], samples[k_tile], looked_at = 0u;
  [[unroll]] for (int row = 0; row < k_tile; ++row) {
    uint y = min(corner.y + uint(row), push.resolution.y - 1u);
    through[row] = 1.0;
    depth[row] = 0.0;
    scene[row] = scene_depth[y * push.resolution.x + last_column];
    light[row] = vec3(0.0);
    most_seen[row] = 0.0;
    seen_vertex[row] = samples[row] = 0u;
  }
  for (uint first = begin; first < end; first += k_lanes) {
    set_up(lane, min(first + lane, end - 1u), first + lane < end, vec2(corner) + 0.5 * float(k_tile));
    barrier();
    looked_at += min(k_lanes, end - first);
    [[unroll]] for (uint k = 0u; k < k_lanes; ++k) {
      vec4 line = axis[k], size = extent[k], middle = shade[k], change = slope[k];
      float across = line.x * top.y - line.y * top.x + line.z, along = line.x * top.x + line.y * top.y + line.w;
      float half_length = size.z - 0.5;
      [[unroll]] for (int row = 0; row < k_tile; ++row) {
        float at = clamp(along, -half_length, half_length), inverse_depth = middle.w + at * change.w;
        float covered = clamp((size.x - abs(across)) * push.opacity, 0.0, size.y);
        covered *= clamp(size.z - abs(along), 0.0, size.w);
        float weight = inverse_depth >= scene[row] ? through[row] * covered : 0.0;
        light[row] += weight * (middle.rgb + at * change.rgb);
        depth[row] += weight * inverse_depth;
        through[row] -= weight;
        if (k_says_seen != 0u) {
          samples[row] += weight > 0.0 ? 1u : 0u;
          seen_vertex[row] = weight > most_seen[row] ? first_vertex[k] : seen_vertex[row];
          most_seen[row] = max(most_seen[row], weight);
        }
        across += line.x;
        along += line.y;
      }
    }
    float most = 0.0;
    [[unroll]] for (int row = 0; row < k_tile; ++row) most = max(most, through[row]);
    open[lane] = most;
    barrier();
    [[unroll]] for (uint k = 0u; k < k_lanes; ++k) most = max(most, open[k]);
    if (most < k_opaque) break;
  }
  [[unroll]] for (int row = 0; row < k_tile; ++row) {
    uint y = corner.y + uint(row);
    if (column < push.resolution.x && y < push.resolution.y) {
      uint pixel = y * push.resolution.x + column;
      float alpha = 1.0 - through[row];
      picture[pixel] = uvec2(packHalf2x16(light[row].rg), packHalf2x16(vec2(light[row].b, alpha)));
      mean_depth[pixel] = alpha > 0.0 ? depth[row] / alpha : 0.0;
      uint first = seen_vertex[row], last = samples[row] > 0u ? first + 1u : first;
      if (k_says_seen != 0u) seen[pixel] = Seen(first, last, alpha, samples[row], looked_at);
    }
  }
}
