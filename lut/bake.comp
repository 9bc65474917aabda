#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The texels of all tables of a set, for any model: one thread a texel, one row of workgroups a table. What they are of is
// data (bake_kernel_gpu.h), written once; only the parameters change. model_of_kernel.glslh is written by CMake for each model.
#include "model_of_kernel.glslh"
#include "bsdf/shared/adaptive_quadrature.glslh"
#include "lut/caustic.glslh"

const uint k_texel_words = 5u;  // of bake_kernel_gpu.h: four floats, and whether a caustic lies inside
const int k_none = -1, k_mean = 1, k_cos_theta_d = 2;
const float k_tolerance = 3e-4;  // of a mean by quadrature: below what a half holds
const float k_end_gap = 0.008544628637;  // from the outermost of 15 nodes to the end of [-1, 1]

// What is evaluated once: kind, quantity, lobes as bits, 0. A channel takes one component of one of them.
struct Table { uint first, count, from_caustic, unused; ivec4 terms[4]; ivec4 term_of_channel, component_of_channel; };
struct TexelPoint { float theta_i, theta_o, theta_d, phi, h, phi_o, begin, end; };

layout(local_size_x = 64) in;
layout(scalar, binding = 0) readonly buffer Parameters { Prepared prepared; };
layout(std430, binding = 1) readonly buffer Tables { Table tables[]; };
layout(std430, binding = 2) readonly buffer Points { TexelPoint points[]; };
layout(push_constant) uniform Push { float glass; };  // eta^2 - 1 of the fibre with the caustic
layout(std430, binding = 3) writeonly buffer Stored { uint words[]; };

// Whether a peak may stand between a panel's ends, whose values these are, and the nodes next to them.
bool has_hidden_peak(AdaptiveIntegral integral, Panel panel, vec3 first, vec3 last, vec3 lower, vec3 upper) {
  vec3 jump = (abs(first - lower) + abs(last - upper)) * (k_end_gap * panel_half(integral));
  vec3 size = integral.value + panel.fine * panel_half(integral);
  return any(greaterThan(jump, k_tolerance * size + 1e-9));
}

// N at a point, or its mean: one loop, so that the model's N is in the kernel once. Nodes 15 and 16 are the panel's ends.
vec3 azimuthal(int lobe, EvaluationPoint at, bool is_mean, float begin, float end) {
  AdaptiveIntegral integral = start_integral(begin, end);
  int nodes = is_mean ? 17 : 1;
  vec3 value = vec3(0.0);
  bool open = true;
  while (open) {
    Panel panel = empty_panel(begin);
    vec3 first, last, lower;
    for (int k = 0; k < nodes; ++k) {
      if (is_mean) at.phi = k < 15 ? panel_point(integral, k) : k == 15 ? panel_lower(integral) : panel_upper(integral);
      value = evaluate(prepared, CUTICLE_QUANTITY_N, lobe, at);
      if (k == 0) first = value;
      if (k == 14) last = value;
      if (k == 15) lower = value;
      if (k < 15) panel = with_value(panel, k, value);
    }
    integral = settled(integral, panel, k_tolerance, has_hidden_peak(integral, panel, first, last, lower, value));
    open = is_mean && is_open(integral);
  }
  return is_mean ? integral.value / (end - begin) : value;
}

vec3 azimuthal_or_own_mean(int lobe, EvaluationPoint at, bool is_mean, float begin, float end) {
#ifdef CUTICLE_AZIMUTHAL_MEAN
  if (is_mean && has_exact_means(prepared))
    return azimuthal_mean(prepared, lobe, at.theta_d, begin, end);
#endif
  return azimuthal(lobe, at, is_mean, begin, end);
}

bool is_singular(int lobe, float theta_d, float begin, float end) {
#ifdef CUTICLE_AZIMUTHAL_MEAN
  if (has_exact_means(prepared)) return is_singular(prepared, lobe, theta_d, begin, end);
#endif
  return false;
}

vec3 value_of(ivec4 term, TexelPoint p, inout bool singular) {
  // A float's right angle can lie just beyond it.
  if (term.x == k_cos_theta_d) return vec3(max(precise_cos(p.theta_d), 0.0));
  EvaluationPoint at = EvaluationPoint(p.theta_i, p.theta_o, p.theta_d, p.phi, p.h, p.phi_o);
  vec3 sum = vec3(0.0);
  for (int lobe = 0; (term.z >> lobe) != 0; ++lobe) {
    if (((term.z >> lobe) & 1) == 0) continue;
    if (term.y == CUTICLE_QUANTITY_M) {
      sum += evaluate(prepared, CUTICLE_QUANTITY_M, lobe, at);
      continue;
    }
    bool is_mean = term.x == k_mean;
    sum += azimuthal_or_own_mean(lobe, at, is_mean, p.begin, p.end);
    singular = singular || is_mean && is_singular(lobe, p.theta_d, p.begin, p.end);
  }
  return sum;
}

void store(uint texel, vec4 value, bool singular) {
  uint first = texel * k_texel_words;
  for (uint c = 0u; c < 4u; ++c) words[first + c] = floatBitsToUint(value[c]);
  words[first + 4u] = uint(singular);
}

// A texel beside the caustic (caustic.glslh), and the factor that it leaves out.
float placed_beside_caustic(inout TexelPoint p) {
  float cosine = precise_cos(p.theta_d);
  vec2 texel = caustic_texel(glass, p.begin, p.phi, cosine * cosine);
  if (texel.y != cosine * cosine) p.theta_d = precise_atan2(sqrt(1.0 - texel.y), sqrt(texel.y));
  p.phi = texel.x;
  return from_caustic(glass, p.begin, p.phi, texel.y).peak;
}

void main() {
  uint table = gl_WorkGroupID.y;
  uint i = gl_GlobalInvocationID.x;
  if (i >= tables[table].count) return;
  uint texel = tables[table].first + i;
  vec4 stored = vec4(0.0);
  TexelPoint point = points[texel];
  float left_out = tables[table].from_caustic != 0u ? placed_beside_caustic(point) : 1.0;
  bool singular = false;
  for (int t = 0; t < 4; ++t) {
    ivec4 term = tables[table].terms[t];
    if (term.x == k_none) break;
    vec3 value = value_of(term, point, singular) / left_out;
    for (int c = 0; c < 4; ++c)
      if (tables[table].term_of_channel[c] == t) stored[c] = value[tables[table].component_of_channel[c]];
  }
  store(texel, stored, singular);
}
