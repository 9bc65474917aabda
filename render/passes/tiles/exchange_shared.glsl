// The invocations of a tile speak through shared memory: each sets up some of the tile's segments for all. Eight with large
// blocks draw all of these; where each has few pixels, it draws those that may cover them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "render/passes/tiles/prepared.glsl"
#ifdef MARKS_SEEN
#define COLOR_OF(vertex) vec3(0.0)
#endif
#include "render/passes/tiles/projected_segment_vertices.glsl"

const bool k_draws_lists = k_lanes > 8u;
const uint k_told = k_draws_lists ? 128u / k_lanes : 1u;  // segments that an invocation sets up at a time
const uint k_chunk = k_told * k_lanes;
const float k_margin = 0.02;  // pixels, more than rounding takes

shared vec4 axis[k_chunk], extent[k_chunk], shade[k_chunk], slope[k_chunk];
shared vec2 reach[k_chunk];  // of lists: how far from its axis' middle its pixels may have theirs, across and along
shared uint first_vertex[k_chunk];
shared float values[k_lanes];

uint own_lane() { return gl_LocalInvocationID.x; }

// From the middle of an invocation's pixels to its first's and last's, and half the size of them all.
vec2 own_middle() { return 0.5 * vec2(in_block(0) + in_block(k_block - 1)); }
vec2 own_size() { return 0.5 * vec2(in_block(k_block - 1) - in_block(0) + 1u); }

vec2 reach_of(Prepared own) {
  vec2 size = own_size(), along = abs(own.axis.xy);
  float half_length = own.extent.z, half_width = own.extent.x + abs(own.extent.w) * half_length;
  return vec2(half_width + dot(along.yx, size), half_length + cap_of(half_width) + dot(along, size)) + k_margin;
}

void tell(uint place, Prepared own) {
  axis[place] = own.axis;
  extent[place] = own.extent;
  shade[place] = own.shade;
  slope[place] = own.slope;
  first_vertex[place] = own.vertex;
  if (k_draws_lists) reach[place] = own.extent.y > 0.0 ? reach_of(own) : vec2(-1.0);
}

Prepared told(uint place) {
  return Prepared(axis[place], extent[place], shade[place], slope[place], first_vertex[place]);
}

void draw_all(vec2 first_pixel) {
  const uint drawn = k_draws_lists ? 0u : k_chunk;
  [[unroll]] for (uint k = 0u; k < drawn; ++k) draw(told(k), first_pixel);
}

// Bit k: segment 32 * word + k of those told may cover the invocation's pixels, which have their middle there.
uint own_segments(uint word, vec2 middle) {
  uint own = 0u;
  [[unroll]] for (uint k = 0u; k < 32u; ++k) {
    vec4 line = axis[32u * word + k];
    float d = line.x * middle.y - line.y * middle.x + line.z, s = dot(line.xy, middle) + line.w;
    bool covers = all(lessThan(abs(vec2(d, s)), reach[32u * word + k]));
    own |= covers ? 1u << k : 0u;
  }
  return own;
}

// Each invocation goes its own way through all that was told, so that one with a long list waits for few others.
void draw_lists(uint count, vec2 first_pixel) {
  const uint words = (k_chunk + 31u) / 32u;
  uint lists[words], base = 0u;
  [[unroll]] for (uint word = 0u; word < words; ++word)
    lists[word] = 32u * word < count && !is_full() ? own_segments(word, first_pixel + own_middle()) : 0u;
  for (;;) {
    while (lists[0] == 0u && base < k_chunk) {
      [[unroll]] for (uint word = 1u; word < words; ++word) lists[word - 1u] = lists[word];
      lists[words - 1u] = 0u;
      base += 32u;
    }
    if (lists[0] == 0u) break;
    uint next = uint(findLSB(lists[0]));
    lists[0] &= lists[0] - 1u;
    draw(told(base + next), first_pixel);
  }
}

void draw_chunk(uint first, uint end, vec2 first_pixel, vec2 tile_corner) {
  [[unroll]] for (uint k = 0u; k < k_told; ++k) {
    uint place = k * k_lanes + own_lane();
    tell(place, set_up(first + place, end, tile_corner + 0.5 * float(k_tile)));
  }
  barrier();
  if (k_draws_lists) draw_lists(end - first, first_pixel);
  else draw_all(first_pixel);
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
