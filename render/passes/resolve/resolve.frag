#version 460
// Mean of the supersamples of a pixel, then the background behind what they left uncovered.
layout(set = 0, binding = 0) uniform sampler2D supersampled;
layout(push_constant) uniform Push {
  vec4 background;  // a: 1 where it is opaque
  int supersampling;
};
layout(location = 0) out vec4 color;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * supersampling, at = ivec2(0);
  vec4 sum = vec4(0.0);
  do {  // loops that ask before their first turn run their body once more on lavapipe, masked
    sum += texelFetch(supersampled, first + at, 0);
    at = at.x + 1 < supersampling ? ivec2(at.x + 1, at.y) : ivec2(0, at.y + 1);
  } while (at.y < supersampling);
  vec4 mean = sum / float(supersampling * supersampling);
  color = vec4(mean.rgb + (1.0 - mean.a) * background.rgb, mix(mean.a, 1.0, background.a));
}
