// The exponent of T in the layers of a texel as it is stored, for the lookups of all texels and of tiles.
#include "shadows/deep_opacity/layers.glslh"
#include "shadows/map_filter.glsl"
#include "shadows/splat.glslh"

layout(binding = 3) uniform usamplerBuffer ranges;
layout(binding = 4) uniform usamplerBuffer layers;
layout(binding = 5) uniform usamplerBuffer sums;
layout(binding = 6) uniform usamplerBuffer table;  // deposits, shares, the exponents of codes, what they are rounded by
layout(std430, binding = 7) writeonly buffer Transmittance { float transmittance[]; };

layout(constant_id = 0) const uint k_packed = 0u;  // 1: sums are codes, four in a word

float fibre_exponent;
uint first_stored = 0u;  // the texel that the sums begin with

bool by_texel() { return (push.flags & k_by_texel_flag) != 0u; }

uint own_range;                 // the texel's range
uint layer_begin, layer_end;    // of the layer that is looked up, as layers count
uint own_before, own_after;     // what the own fibre has left before that layer, and before its end
bool is_nearest, is_farthest;   // whether it is the texel's nearest fibre, or its farthest

Layer layer_of(uint behind) {
  return unpacked_layer(texelFetch(layers, int(k_layer_table + table_step(behind))).r);
}

void own_deposit(uint covered, uint depth_step) {
  const uint nearest = range_nearest(own_range), behind = depth_step - min(depth_step, nearest);
  const uint amount = texelFetch(table, int(covered)).r;
  const uint at = table_step(layer_step(behind, range_extent(own_range), by_texel()));
  own_before += at < layer_begin ? amount : 0u;
  own_after += at < layer_end ? amount : 0u;
  is_nearest = is_nearest || behind == 0u;
  is_farthest = is_farthest || depth_step >= range_farthest(own_range);
}

const uint k_exponents = k_coverage_steps + 1u + k_max_layers, k_thresholds = k_exponents + 256u;

float exponent_of_code(uint code) { return uintBitsToFloat(texelFetch(table, int(k_exponents + code)).r); }

/// How many of the 255 thresholds, which fall, are not below the sum.
uint code_of(uint sum) {
  uint first = 0u;
  for (uint count = 255u; count > 0u;) {
    const uint half_count = count / 2u;
    const bool not_below = texelFetch(table, int(k_thresholds + first + half_count)).r >= sum;
    first = not_below ? first + half_count + 1u : first;
    count = not_below ? count - half_count - 1u : half_count;
  }
  return first;
}

/// The exponent before the end of layer i % layers of texel i / layers, without `own` of its sum.
float exponent_before(uint i, uint own) {
  const uint word = texelFetch(sums, int(k_packed != 0u ? i / 4u : i)).r;
  if (k_packed == 0u) return push.per_unit * float(word - own);
  const float exponent = exponent_of_code(packed_code(word, i % 4u));
  return own > 0u ? min(0.0, exponent - exponent_of_code(code_of(own))) : exponent;
}

float stored_exponent(uint texel, float z) {
  const uint range = texelFetch(ranges, int(texel)).r;
  const float depth = z - float(range_nearest(range)), extent = depth_extent(range);
  const float step = layer_scale(extent, by_texel());
  float exponent = 0.0;
  if (range != k_no_range && depth > 0.0) {
    const Layer layer = layer_of(uint(depth * step));
    const bool is_behind = depth >= extent;
    own_range = range;
    layer_begin = layer.begin;
    layer_end = is_behind ? k_no_end : layer.end;
    own_before = own_after = 0u;
    is_nearest = is_farthest = false;
    walk_own();
    const uint i = (texel - first_stored) * push.layers + (is_behind ? push.layers - 1u : layer.index);
    const float after = exponent_before(i, own_after);
    float before = 0.0;
    if (layer.index > 0u && !is_behind) before = exponent_before(i - 1u, own_before);
    exponent = exponent_within(layer, extent * step, depth * step, step, before, after, is_nearest ? 0.0 : fibre_exponent,
                               is_farthest ? 0.0 : fibre_exponent,
                               (push.flags & k_poisson) != 0u ? 0.0 : fibre_exponent, lookup_power);
  }
  return exponent;
}

/// At a vertex: the mean over the filter's disc of T, or of sigma.
void look_up(MapPlacement placement, uint v) {
  fibre_exponent = push.per_unit * float(texelFetch(table, int(texelFetch(layers, int(k_max_layers)).r)).r);
  const float through = transmittance_of_vertex(placement, v, k_deepest);
  if (through >= 0.0) transmittance[v] = through;
}
