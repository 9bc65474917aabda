#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/hard_cases/elementary.glslh"
#include "core/shared/philox.glslh"
// results[i] = function(arguments[i]); the function beyond the last one draws a random word instead.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Arguments { vec2 arguments[]; };
layout(std430, binding = 1) writeonly buffer Results { uint results[]; };
layout(push_constant) uniform Constants { uint function_index; uint count; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  if (function_index == 8u) {
    const PhiloxBlock block = philox(PhiloxBlock(i, 7u * i, 1u, 2u), 3u, i ^ 0x55u);
    results[i] = block.a ^ block.b ^ block.c ^ block.d;
    return;
  }
  results[i] = floatBitsToUint(elementary(function_index, arguments[i].x, arguments[i].y));
}
