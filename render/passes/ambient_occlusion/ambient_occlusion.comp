#version 460
#extension GL_GOOGLE_include_directive : require
// How much of a sphere around each pixel's point lies before the depth that the picture sees, by lines along the view
// through it. A plane leaves one half open, however it is turned: that counts as all. No normal is needed, which hair
// has none of.
#include "render/picture_filter.glsl"
layout(binding = 2) uniform sampler2D picture;
layout(push_constant) uniform Push {
  uvec2 resolution;
  float radius;            // of the sphere, metres
  float pixels_per_slope;
  float largest;           // radius of the sphere in pixels
  float strength;
  uint samples;            // pairs
};

// The open part of the line through a pixel. A thing farther before the line than the sphere's radius hides what is
// behind it and says nothing: half.
float open_length(ivec2 pixel, float middle, float half_length, float sphere) {
  const float inverse = pixel_depth[index_of(pixel, resolution)];
  const float begin = middle - half_length, distance = inverse > 0.0 ? 1.0 / inverse : middle + half_length;
  return distance < begin - sphere ? half_length : clamp(distance - begin, 0.0, 2.0 * half_length);
}

float accessibility(uint index, vec2 place) {
  const float middle = 1.0 / pixel_depth[index], across = min(radius / middle * pixels_per_slope, largest);
  const float sphere = across * middle / pixels_per_slope, turn = turn_of(index);
  float open = 0.0, whole = 0.0;
  for (uint k = 0u; k < samples; ++k) {
    const vec2 point = disc_point(k, samples, turn);
    const float half_length = sphere * sqrt(max(1.0 - dot(point, point), 0.0));
    open += open_length(pixel_at(place + across * point, resolution), middle, half_length, sphere) +
            open_length(pixel_at(place - across * point, resolution), middle, half_length, sphere);
    whole += 4.0 * half_length;
  }
  return min(2.0 * open / whole, 1.0);
}

void main() {
  const uint index = invocation();
  if (index >= resolution.x * resolution.y) return;
  const ivec2 pixel = ivec2(index % resolution.x, index / resolution.x);
  const vec4 color = texelFetch(picture, pixel, 0);
  const float light = pixel_depth[index] > 0.0 ? mix(1.0, accessibility(index, vec2(pixel) + 0.5), strength) : 1.0;
  filtered[index] = vec4(light * color.rgb, color.a);
}
