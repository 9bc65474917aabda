#version 460
// One texture sample per thread, of one mip level.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Places { vec2 places[]; };
layout(std430, binding = 1) writeonly buffer Samples { vec4 samples[]; };
layout(binding = 2) uniform sampler2D image;
layout(push_constant) uniform Push { float level; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < places.length()) samples[i] = textureLod(image, places[i], level);
}
