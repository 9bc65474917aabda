#version 460
#extension GL_GOOGLE_include_directive : require
// One invocation per vertex: the mean over the filter's disc of T, or of sigma; sigma is four 4-vector dot products of
// the targets with tent weights, which are the same for all texels.
layout(local_size_x = 64) in;
#include "cuticle/shadows/map_filter.glsl"
#include "cuticle/shadows/opacity_map/tent.glslh"

layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Box { uint least[6]; };
layout(std430, binding = 2) writeonly buffer Transmittance { float transmittance[]; };
layout(binding = 3) uniform sampler2D planes_1_to_4;
layout(binding = 4) uniform sampler2D planes_5_to_8;
layout(binding = 5) uniform sampler2D planes_9_to_12;
layout(binding = 6) uniform sampler2D planes_13_to_16;

float known_z = -1.0;  // the depth that the weights are of
vec4 weights[4];

void set_weights(float z) {
  if (z == known_z) return;
  known_z = z;
  const float limited = min(z, float(push.layers));
  for (int i = 0; i < 16; ++i) weights[i / 4][i % 4] = tent_weight(limited, float(i + 1));
}

float exponent_at(uint texel, float z) {
  set_weights(z);
  const ivec2 at = ivec2(texel % push.resolution, texel / push.resolution);
  const float sigma =
      dot(weights[0], texelFetch(planes_1_to_4, at, 0)) + dot(weights[1], texelFetch(planes_5_to_8, at, 0)) +
      dot(weights[2], texelFetch(planes_9_to_12, at, 0)) + dot(weights[3], texelFetch(planes_13_to_16, at, 0));
  return -push.own[0] * sigma;
}

void main() {
  const uint v = invocation();
  if (v < push.count) transmittance[v] = transmittance_at(placement_of(least), vertices[v].xyz, push.intervals);
}
