// Coverage by samples: a pixel has k_rows rows of 32 each, and keeps which of them are covered, so that strands that
// overlap in it count once and those side by side add up. On a row a segment covers one span, found without asking each
// sample. Rows lie across most strands of the tile, where spans are shortest and rows cross all of them. Where strands lie
// in all directions (fur) some lie along the rows: such a tile is drawn three times, each with rows between the others'.
#include "render/passes/tiles/blocks.glsl"
#include "render/randomness/mixed_bits.glsl"

layout(constant_id = 1) const int k_rows = 8;
layout(constant_id = 4) const uint k_lets_through = 0u;  // 1: a level of detail may let strands let light through

const float k_columns = 32.0;  // of a pixel: a word holds a row
// Of what strands lean to one side or the other, the least that is left of the sum where a tile is drawn once.
const float k_least_agreement = 0.2;
// Longer lists are drawn once: of the turns that lavapipe allows, a segment takes half of one, and with many rows three.
const uint k_longest_drawn_again = k_rows > 8 ? 6000u : 32768u;
const float k_least_lean = 1e-3;  // a span's ends are found by dividing by the parts of the direction

uint spans[k_block * k_rows];
float shifts[k_block * k_rows];  // of those rows, kept where each invocation has other pixels
bool is_turned;
uint drawings = 1u;
vec2 samples_moved = vec2(0.0);  // from where they lie when a tile is drawn once, in pixels

uvec2 turned(uvec2 value) { return is_turned ? value.yx : value; }

// By 32 segments at even steps through the tile's list, four for each of eight invocations: the nearest alone may lie
// across all others.
void choose_turn(uint begin, uint end) {
  const uint taken = 32u;
  float lean = 0.0, all_leans = 0.0, per_step = float(end - begin) / float(taken);
  [[unroll]] for (uint k = 0u; k < 4u; ++k) {
    uint step = 4u * own_lane() + k, entry = begin + uint((float(step) + 0.5) * per_step);
    ProjectedSegment own = segment_from_vertex(vertex_of(min(entry, end - 1u)));
    float area = own.half_width * min(own.half_length, float(k_tile));
    float own_lean = step < taken ? area * (abs(own.axis.x) - abs(own.axis.y)) : 0.0;
    lean += own_lean;
    all_leans += abs(own_lean);
  }
  lean = sum_in_all(lean);
  is_turned = lean > 0.0;
  bool agrees = abs(lean) >= k_least_agreement * sum_in_all(all_leans);
  drawings = agrees || end - begin > k_longest_drawn_again ? 1u : 3u;
}

uint drawings_of_tile() { return drawings; }

// The samples that it covers are those that nothing before it did.
float seen_share(float left, float covered) { return covered; }

bool is_full() { return most_through() < 0.5 / (k_columns * float(k_rows)); }  // less than a sample

float inverse_lean(float part) { return 1.0 / (part < 0.0 ? min(part, -k_least_lean) : max(part, k_least_lean)); }

// Of a row's samples, columns: each row has others, so that a strand along the columns meets as many distances as there
// are samples. Neighbouring rows are about the golden ratio of a column apart, so that no common angle meets few;
// neighbouring pixels begin elsewhere.
float shift_of(int pixel, int row) {
  const int step = int(0.618034 * float(k_rows) + 0.5) | 1;
  return (float((row * step + 3 * pixel) % k_rows) + 0.5) / float(k_rows);
}

float own_shift(int k, int row) {
  if (k_sharers == 1u) return shift_of(k, row);  // a number that the compiler knows
  return shifts[k * k_rows + row];
}

// Of three drawings the samples lie a third of a row apart, and a third of the least step between columns.
void begin_drawing(uint drawing) {
  vec2 moved = ((float(drawing) + 0.5) / float(drawings) - 0.5) / float(k_rows) * vec2(1.0 / k_columns, 1.0);
  samples_moved = is_turned ? moved.yx : moved;
  [[unroll]] for (int row = 0; row < k_block * k_rows; ++row) {
    spans[row] = 0u;
    if (k_sharers > 1u) shifts[row] = shift_of(pixel_of(row / k_rows), row % k_rows);
  }
}

// Which samples of a row strands cover that let light through: of eight so many, by chance, for each strand and row
// others, and for all segments of a strand the same, so that they cover no sample twice.
uint covering[k_rows];

// From the last binary place to the first: a place that is one adds half of what is not covered, a zero takes half away.
void choose_samples(uint vertex, float opacity) {
  if (k_lets_through == 0u) return;
  uint eighths = uint(8.0 * opacity + 0.5), random = mixed_bits(vertex / push.vertices_per_strand);
  [[unroll]] for (int row = 0; row < k_rows; ++row) {
    uint chosen = 0u;
    [[unroll]] for (uint place = 0u; place < 3u; ++place) {
      random = random * 1664525u + 1013904223u;
      uint half_of_all = random ^ (random >> 16);
      chosen = (eighths >> place & 1u) != 0u ? chosen | half_of_all : chosen & half_of_all;
    }
    covering[row] = eighths > 7u ? ~0u : chosen;
  }
}

// In each pixel they lie elsewhere.
uint covered_samples(int pixel, int row) {
  if (k_lets_through == 0u) return ~0u;
  const int step = (5 * pixel) % 31 + 1;
  return covering[row] << step | covering[row] >> (32 - step);
}

// A row's samples from the first column to before the last.
uint span_of(float first, float last) {
  int from = int(max(first, 0.0)), to = int(min(last, k_columns));
  return to > from ? (~0u << from) & (~0u >> (32 - to)) : 0u;
}

// Draws it on the block whose first pixel has its middle there.
void draw(Prepared own, vec2 first_pixel) {
  first_pixel += samples_moved;
  vec4 line = own.axis, middle = own.shade, change = own.slope;
  float across = line.x * first_pixel.y - line.y * first_pixel.x + line.z;
  float along = line.x * first_pixel.x + line.y * first_pixel.y + line.w;
  float half_length = own.extent.z;
  vec2 direction = is_turned ? line.yx : line.xy;
  float first_row = 0.5 / float(k_rows) - 0.5;
  // In columns: how far a row runs from the line across the middle to an end (x) and from the axis to a side (y).
  vec2 inverse = k_columns * vec2(inverse_lean(direction.x), inverse_lean(direction.y));
  vec2 per_row = vec2(-direction.y, direction.x) * inverse * (1.0 / float(k_rows));
  bool is_used = own.extent.y > 0.0;
  const float share = 1.0 / (k_columns * float(k_rows));
  choose_samples(own.vertex, own.extent.y);
  [[unroll]] for (int k = 0; k < k_block; ++k) {
    vec2 from_first = vec2(in_block(k));
    float d = across + line.x * from_first.y - line.y * from_first.x, s = along + dot(line.xy, from_first);
    float at = clamp(s, -half_length, half_length), inverse_depth = middle.w + at * change.w;
    uint open = is_used && inverse_depth >= scene[k] ? ~0u : 0u;
    vec2 from_first_row = vec2(-(s + direction.y * first_row), (is_turned ? -d : d) + direction.x * first_row);
    float half_width = half_width_at(own, s);
    vec2 extent = vec2(half_length + cap_of(half_width), half_width) * abs(inverse);
    vec2 crossed = from_first_row * inverse + 0.5 * k_columns;
    vec2 least = crossed - extent, most = crossed + extent;
    int fresh = 0;
    [[unroll]] for (int r = 0; r < k_rows; ++r) {
      int row = k * k_rows + r;
      vec2 moved = float(r) * per_row + own_shift(k, r);
      vec2 first = least + moved, last = most + moved;
      uint span = open & covered_samples(pixel_of(k), r) & span_of(max(first.x, first.y), min(last.x, last.y));
      fresh += bitCount(span & ~spans[row]);
      spans[row] |= span;
    }
    take(k, vertex_at(own, at, inverse_depth), float(fresh) * share, color_at(own, at, inverse_depth), inverse_depth);
  }
  end_segment();
}
