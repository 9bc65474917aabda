// Coverage by samples: a pixel has k_rows rows of k_columns each, and keeps which of them are covered, so that strands
// that overlap in it count once and those side by side add up. On a row a segment covers one span, found without asking
// each sample. Rows lie across most strands of the tile, where spans are shortest and rows cross all of them.
#include "render/passes/tiles/blocks.glsl"

layout(constant_id = 1) const int k_rows = 8;

const int k_pixel_rows = 4;    // of a block, two pixels across, whose samples of a row share a word
const float k_columns = 16.0;  // of a pixel
const float k_cap = 0.7853982, k_longest_cap = 0.5;  // half widths; pixels, as far as lists of tiles and blocks reach
const float k_least_lean = 1e-3;  // a span's ends are found by dividing by the parts of the direction

uint spans[k_pixel_rows * k_rows];
bool is_turned;

uvec2 turned(uvec2 value) { return is_turned ? value.yx : value; }

// By the nearest segments of the tile, a share of them for each invocation.
void choose_turn(uint begin, uint end) {
  float lean = 0.0;
  [[unroll]] for (uint k = 0u; k < 4u; ++k) {
    uint entry = begin + 4u * own_lane() + k;
    ProjectedSegment own = segment_from_vertex(vertex_of(min(entry, end - 1u)));
    float area = own.half_width * min(own.half_length, float(k_tile));
    lean += entry < end ? area * (abs(own.axis.x) - abs(own.axis.y)) : 0.0;
  }
  is_turned = sum_in_all(lean) > 0.0;
}

void empty_spans() {
  [[unroll]] for (int row = 0; row < k_pixel_rows * k_rows; ++row) spans[row] = 0u;
}

// The samples that it covers are those that nothing before it did.
float seen_share(float left, float covered) { return covered; }

float inverse_lean(float part) { return 1.0 / (part < 0.0 ? min(part, -k_least_lean) : max(part, k_least_lean)); }

// Where rows cross a band: columns from the block's edge to the band's middle, for the first row and from row to row,
// and half of what it covers.
struct Crossing {
  float middle, step, reach;
};

// Of a band whose middle line a row crosses so many pixels from the first pixel's middle.
Crossing crossing(float first, float step, float reach) {
  return Crossing((first + 0.5) * k_columns, step * k_columns / float(k_rows), reach * k_columns);
}

// Of a row's samples, columns: each row has others, so that strands along the columns lie on as many places as there are
// samples; neighbouring pixels have them in another order, so that strands at an angle that suits one worst suit the next.
float shift_of(int line_of_pixels, int row) {
  return (float((row * (2 * line_of_pixels + 1)) % k_rows) + 0.5) / float(k_rows);
}

// Two pixels' samples of a row, from the first column to before the last.
uint span_of(float first, float last) {
  int from = int(max(first, 0.0)), to = int(min(last, 2.0 * k_columns));
  return to > from ? (~0u << from) & (~0u >> (32 - to)) : 0u;
}

// Draws it on the block whose first pixel has its middle there.
void draw(Prepared own, vec2 first_pixel) {
  vec4 line = own.axis, middle = own.shade, change = own.slope;
  float across = line.x * first_pixel.y - line.y * first_pixel.x + line.z;
  float along = line.x * first_pixel.x + line.y * first_pixel.y + line.w;
  float half_width = own.extent.x - 0.5, half_length = own.extent.z - 0.5;
  float reach = half_length + min(k_cap * half_width, k_longest_cap);
  vec2 direction = is_turned ? line.yx : line.xy;
  float first_row = 0.5 / float(k_rows) - 0.5;
  vec2 inverse = vec2(inverse_lean(direction.x), inverse_lean(direction.y));
  Crossing side = crossing(((is_turned ? -across : across) + direction.x * first_row) * inverse.y,
                           direction.x * inverse.y, half_width * abs(inverse.y));
  Crossing ends = crossing(-(along + direction.y * first_row) * inverse.x, -direction.y * inverse.x,
                           reach * abs(inverse.x));
  bool is_used = own.extent.y > 0.0;
  [[unroll]] for (int line_of_pixels = 0; line_of_pixels < k_pixel_rows; ++line_of_pixels) {
    float at[2], inverse_depth[2];
    uint open = 0u;
    [[unroll]] for (int x = 0; x < 2; ++x) {
      int k = 2 * line_of_pixels + x;
      float s = along + dot(line.xy, vec2(in_block(k)));
      at[x] = clamp(s, -half_length, half_length);
      inverse_depth[x] = middle.w + at[x] * change.w;
      open |= is_used && inverse_depth[x] >= scene[k] ? 0xffffu << (16 * x) : 0u;
    }
    int first = 0, second = 0;
    [[unroll]] for (int r = 0; r < k_rows; ++r) {
      int row = line_of_pixels * k_rows + r;
      float shift = shift_of(line_of_pixels, r);
      float d = side.middle + shift + float(row) * side.step, s = ends.middle + shift + float(row) * ends.step;
      uint span = open & span_of(max(d - side.reach, s - ends.reach), min(d + side.reach, s + ends.reach));
      uint fresh = span & ~spans[row];
      spans[row] |= span;
      first += bitCount(fresh & 0xffffu);
      second += bitCount(fresh >> 16);
    }
    const float share = 1.0 / (k_columns * float(k_rows));
    take(2 * line_of_pixels, own.vertex, float(first) * share, middle.rgb + at[0] * change.rgb, inverse_depth[0]);
    take(2 * line_of_pixels + 1, own.vertex, float(second) * share, middle.rgb + at[1] * change.rgb,
         inverse_depth[1]);
  }
}
