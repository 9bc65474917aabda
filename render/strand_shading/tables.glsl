// S of any layout's tables. Which quantity addresses an axis and which products make S are constants of the pipeline
// (tables_gpu.h), so that nothing is computed that the layout does not ask for. Before this stand frame.glsl,
// LAYOUT_CONSTANT, and the samplers table_first, table_second and table_rest, which holds the third table and, below it,
// the fourth.
#include "lut/caustic.glslh"
#include "lut/half_vector.glslh"

layout(constant_id = LAYOUT_CONSTANT) const uint k_axes = 0u;        // four bits an axis: lut::AxisQuantity
layout(constant_id = LAYOUT_CONSTANT + 1) const uint k_terms = 0u;   // twelve bits a term, six a factor
layout(constant_id = LAYOUT_CONSTANT + 2) const uint k_more_terms = 0u;
layout(constant_id = LAYOUT_CONSTANT + 3) const uint k_reading = 0u;
const bool k_over_angles = (k_reading & 1u) != 0u, k_from_caustic = (k_reading & 2u) != 0u, k_over_cos2 = (k_reading & 4u) != 0u,
           k_stored_cosine = (k_reading & 8u) != 0u, k_fourth = (k_reading & 16u) != 0u, k_over_half = (k_reading & 32u) != 0u;

// With mip levels a lookup reads a mean over what lies between it and those of the next pixels, where the tangent is
// another. Half of the way: the tent between texels is twice as wide as they are (README.md).
#ifndef MIP_LEVELS
#define MIP_LEVELS 0u
#endif

// What a direction has on the axes, by lut::AxisQuantity, and the factor that a table from the caustic leaves out.
struct Coordinates { float values[15]; float peak; };

float cos_squared_of_difference(Angles a) {
  float cosines = sqrt(max((1.0 - a.sin_i * a.sin_i) * (1.0 - a.sin_o * a.sin_o), 0.0));
  return clamp(0.5 * (1.0 + cosines + a.sin_i * a.sin_o), 0.0, 1.0);
}

Coordinates coordinates_of(Angles a) {
  Coordinates at;
  float cos_squared = cos_squared_of_difference(a);
  at.values[0] = a.sin_i;
  at.values[1] = a.sin_o;
  at.values[2] = a.cos_phi;
  at.values[3] = sqrt(cos_squared);
  for (uint k = 4u; k < 15u; ++k) at.values[k] = 0.0;
  at.peak = 1.0;
  if (k_over_angles) {
    at.values[4] = asin(clamp(a.sin_i, -1.0, 1.0));
    at.values[5] = asin(clamp(a.sin_o, -1.0, 1.0));
    at.values[6] = acos(clamp(a.cos_phi, -1.0, 1.0));
    at.values[7] = 0.5 * abs(at.values[5] - at.values[4]);
    at.values[9] = abs(at.values[5]);
  }
  if (k_over_half) {
    const float cos_i = sqrt(max(1.0 - a.sin_i * a.sin_i, 0.0)), cos_o = sqrt(max(1.0 - a.sin_o * a.sin_o, 0.0));
    const HalfAngles half_vector = half_angles(vec2(a.sin_i, cos_i), vec2(a.sin_o, cos_o), a.cos_phi,
                                               sqrt(max(1.0 - a.cos_phi * a.cos_phi, 0.0)));
    at.values[10] = half_vector.between;
    at.values[11] = half_vector.inclination;
    at.values[12] = half_vector.azimuth;
    at.values[13] = cos_i * a.cos_phi;
  }
  if (k_from_caustic) {
    FromCaustic beside = from_caustic(caustic.x, caustic.y, at.values[6], cos_squared);
    at.values[8] = beside.value;
    at.peak = beside.peak;
  }
  return at;
}

uint axis_of(uint table, uint axis) { return k_axes >> (8u * table + 4u * axis) & 15u; }
bool leaves_out_peak(uint table) { return axis_of(table, 0u) == 8u; }
vec2 place_in(uint table, Coordinates at) {
  vec2 value = vec2(at.values[axis_of(table, 0u)], at.values[axis_of(table, 1u)]);
  return value * table_maps[table].xy + table_maps[table].zw;
}
// A table's two sides of a caustic do not mix in the first level alone.
vec4 looked_up(sampler2D texels, uint table, Coordinates here, Coordinates right, Coordinates below) {
  vec2 at = place_in(table, here);
  vec4 stored = vec4(0.0);
  if (MIP_LEVELS == 0u || leaves_out_peak(table)) stored = textureLod(texels, at, 0.0);
  else stored = textureGrad(texels, at, 0.5 * (place_in(table, right) - at), 0.5 * (place_in(table, below) - at));
  return stored * table_scales[table] * (leaves_out_peak(table) ? here.peak : 1.0);
}

struct Readings { vec4 of[4]; };

vec3 factor_of(uint code, Readings read) {
  if ((code & 32u) == 0u) return vec3(1.0);
  vec4 values = read.of[code & 3u];
  return (code & 16u) != 0u ? values.rgb : vec3(values[code >> 2 & 3u]);
}
vec3 term_of(uint code, Readings read) {
  return (code & 32u) == 0u ? vec3(0.0) : factor_of(code & 63u, read) * factor_of(code >> 6 & 63u, read);
}

// The first table may hold the cosine that addresses the others.
vec3 scattering_by(Coordinates here, Coordinates right, Coordinates below) {
  Readings read;
  read.of[0] = looked_up(table_first, 0u, here, right, below);
  if (k_stored_cosine) {
    float moved = read.of[0].a - here.values[3];
    here.values[3] += moved;
    right.values[3] += moved;
    below.values[3] += moved;
  }
  read.of[1] = looked_up(table_second, 1u, here, right, below);
  read.of[2] = looked_up(table_rest, 2u, here, right, below);
  read.of[3] = vec4(0.0);
  if (k_fourth) read.of[3] = looked_up(table_rest, 3u, here, right, below);
  vec3 sum = term_of(k_terms & 4095u, read) + term_of(k_terms >> 12, read) + term_of(k_more_terms & 4095u, read) +
             term_of(k_more_terms >> 12, read);
  return k_over_cos2 ? sum / max(here.values[3] * here.values[3], 1e-6) : sum;
}
