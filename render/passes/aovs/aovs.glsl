// One invocation per pixel: from the segment that it sees to numbers, those of the point nearest to the pixel's middle.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"
#include "render/visibility/seen.glsl"
#include "render/visibility/segment_share.glsl"

#define VERTICES_BINDING 0
#define TANGENTS_BINDING 1
#include "strands/spline/drawn.glsl"
layout(std430, binding = 2) readonly buffer Transmittance { float transmittance[]; };
layout(std430, binding = 3) writeonly buffer Aovs { float aovs[]; };  // k_channels of aovs.h
layout(binding = 4) uniform samplerBuffer velocities;
layout(std430, binding = 5) writeonly buffer SeenVelocities { float seen_velocities[]; };  // three a pixel
layout(std430, binding = 6) readonly buffer OfSecond { float of_second[]; };  // transmittance of other opacities
layout(std430, binding = 7) readonly buffer OfThird { float of_third[]; };
layout(push_constant) uniform Push {
  mat4 world_to_clip;
  uvec2 resolution;
  uint vertices_per_strand;
  uint drawn_segments;  // of a strand
  uint shadowed;        // 1: there is transmittance
  uint moves;           // 1: there are velocities
};

const uint k_channels = 9u;

#define CHANNEL_CONSTANT 1
#include "render/channels.glsl"

/// What the shader that includes this finds out; its source stands at binding 8.
Seen seen_in(uint pixel);

/// Of white light; of Rec. 709 by its luminance.
float transmitted(uint vertex) {
  if (k_different == 1u) return transmittance[vertex];
  const float of[3] = float[](transmittance[vertex], of_second[vertex], of_third[vertex]);
  return dot(vec3(of[k_of_red], of[k_of_green], of[k_of_blue]), vec3(0.2126, 0.7152, 0.0722));
}

void write_aovs(uint pixel) {
  if (pixel >= resolution.x * resolution.y) return;
  Seen own = seen_in(pixel);
  vec3 velocity = vec3(0.0);
  float values[k_channels] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, float(own.cost));
  if (own.first != own.last) {
    vec3 from = drawn_vertex(own.first).xyz, to = drawn_vertex(own.last).xyz;
    vec2 middle = vec2(pixel % resolution.x, pixel / resolution.x) + 0.5;
    float share = share_at(world_to_clip, middle, vec2(resolution), from, to);
    vec3 tangent = normalize(mix(drawn_tangent(own.first).xyz, drawn_tangent(own.last).xyz, share));
    float reached = shadowed == 0u ? 1.0 : mix(transmitted(own.first), transmitted(own.last), share);
    if (moves != 0u) velocity = mix(texelFetch(velocities, int(own.first)).xyz, texelFetch(velocities, int(own.last)).xyz, share);
    values = float[]((world_to_clip * vec4(mix(from, to, share), 1.0)).w, tangent.x, tangent.y, tangent.z,
                     float(own.first / vertices_per_strand + 1u), own.coverage, reached, float(own.samples),
                     float(own.cost));
  }
  for (uint k = 0u; k < k_channels; ++k) aovs[pixel * k_channels + k] = values[k];
  if (moves == 0u) return;
  for (uint k = 0u; k < 3u; ++k) seen_velocities[3u * pixel + k] = velocity[k];
}
