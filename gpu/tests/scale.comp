#version 460
#extension GL_GOOGLE_include_directive : require
// target[i] = source[i] * factor + offset.
#include "gpu/groups.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint k_offset = 0;
layout(std430, binding = 0) readonly buffer Source { float source[]; };
layout(std430, binding = 1) writeonly buffer Target { float target[]; };
layout(push_constant) uniform Constants { float factor; uint count; };

void main() {
  const uint i = invocation();
  if (i < count) target[i] = source[i] * factor + float(k_offset);
}
