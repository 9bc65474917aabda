#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma, between the two nearest slices.
layout(local_size_x = 64) in;
#include "cuticle/shadows/opacity_map/opacity_geometry.glsl"
#include "cuticle/shadows/opacity_map/lookup.glslh"

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 3) writeonly buffer Transmittance { float transmittance[]; };

float between(int i, int j, float z) {
  const uint slice = min(uint(z), push.layers - 1u);
  const uint first = (uint(j) * push.resolution + uint(i)) * push.layers;
  const float nearer = slice == 0u ? 0.0 : float(sums[first + slice - 1u]);
  return between_slices(nearer, float(sums[first + slice]), z - float(slice));
}

float averaged(int i, int j, float z) {
  const int end = int(push.resolution);
  const bool outside = i < 0 || j < 0 || i >= end || j >= end;
  const float exponent = outside ? 0.0 : push.per_unit * between(i, j, z);
  return push.poisson != 0u ? exponent : exp(exponent);
}

float mean(vec2 p, float z, float radius) {
  const int i0 = int(floor(p.x)), j0 = int(floor(p.y)), reach = disc_reach(radius);
  float sum = 0.0, weights = 0.0;
  for (int j = j0 - reach; j <= j0 + reach; ++j)
    for (int i = i0 - reach; i <= i0 + reach; ++i) {
      const float weight = disc_weight(length(vec2(i, j) + 0.5 - p), radius);
      if (weight > 0.0) sum += weight * averaged(i, j, z);
      weights += weight;
    }
  return push.poisson != 0u ? exp(sum / weights) : min(1.0, sum / weights);
}

void main() {
  const uint v = invocation();
  if (v >= push.count) return;
  const MapPlacement placement = placement_of(least);
  const vec3 point = place_in_map(placement, in_light_axes(vertices[v].xyz));
  const float radius = push.filter_radius > 0.0 ? clamp(push.filter_radius * placement.scale.x, 0.5, 64.0) : push.filter_texels;
  const float limit = float(push.resolution) + 130.0;
  const bool inside = abs(point.x) < limit && abs(point.y) < limit;
  transmittance[v] = inside ? mean(point.xy, clamp(point.z, 0.0, float(push.layers)), radius) : 1.0;
}
