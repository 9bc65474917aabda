#version 460
// Buffers read as texels: a word, four halves, four words an item.
layout(local_size_x = 64) in;
layout(binding = 0) uniform usamplerBuffer words;
layout(binding = 1) uniform samplerBuffer halves;
layout(binding = 2) uniform usamplerBuffer quads;
layout(std430, binding = 3) writeonly buffer Items { vec4 items[]; };

void main() {
  const int i = int(gl_GlobalInvocationID.x);
  items[i] = vec4(texelFetch(words, i).r, texelFetch(halves, i).yw, texelFetch(quads, i).w);
}
