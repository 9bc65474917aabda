#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Any model over a batch of points, in the order of bsdf::Point; model_of_kernel.glslh is written by CMake for each model
// and includes its formulas.
#include "gpu/groups.glsl"
#include "model_of_kernel.glslh"

layout(local_size_x = 64) in;
layout(scalar, binding = 0) readonly buffer Parameters { Prepared prepared; };
layout(std430, binding = 1) readonly buffer Points { float coordinates[]; };
layout(std430, binding = 2) writeonly buffer Results { float rgb[]; };
layout(push_constant) uniform Batch { uint count; int quantity; int lobe; } batch;

void main() {
  uint i = invocation();
  if (i >= batch.count) return;
  uint first = 6u * i;
  EvaluationPoint at = EvaluationPoint(coordinates[first], coordinates[first + 1u], coordinates[first + 2u],
                                       coordinates[first + 3u], coordinates[first + 4u], coordinates[first + 5u]);
  vec3 value = evaluate(prepared, batch.quantity, batch.lobe, at);
  rgb[3u * i] = value.x;
  rgb[3u * i + 1u] = value.y;
  rgb[3u * i + 2u] = value.z;
}
