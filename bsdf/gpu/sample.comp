#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Directions drawn from any model for a batch of queries, in the order of bsdf::SampleQuery, with their density and weight;
// model_of_kernel.glslh is written by CMake for each model and includes its formulas.
#include "gpu/groups.glsl"
#include "model_of_kernel.glslh"

layout(local_size_x = 64) in;
layout(scalar, binding = 0) readonly buffer Parameters { Prepared prepared; };
layout(std430, binding = 1) readonly buffer Queries { float numbers[]; };
layout(std430, binding = 2) writeonly buffer Results { float drawn[]; };
layout(push_constant) uniform Batch { uint count; } batch;

const uint query_size = 11u;
const uint result_size = 7u;

SamplePoint query_at(uint i) {
  SamplePoint query;
  uint first = query_size * i;
  query.theta_o = numbers[first];
  query.phi_o = numbers[first + 1u];
  query.h = numbers[first + 2u];
  for (uint k = 0u; k < 8u; ++k) query.u[k] = numbers[first + 3u + k];
  return query;
}

void main() {
  uint i = invocation();
  if (i >= batch.count) return;
  SamplePoint query = query_at(i);
  SampledDirection direction = sample_direction(prepared, query);
  EvaluationPoint at = EvaluationPoint(direction.theta_i, query.theta_o, 0.0, direction.phi, query.h, query.phi_o);
  float pdf = evaluate(prepared, CUTICLE_QUANTITY_PDF, -1, at).x;
  vec3 weight = pdf > 0.0 ? evaluate(prepared, CUTICLE_QUANTITY_S, -1, at) / pdf : vec3(0.0);
  uint first = result_size * i;
  drawn[first] = direction.theta_i;
  drawn[first + 1u] = direction.phi;
  drawn[first + 2u] = pdf;
  drawn[first + 3u] = weight.x;
  drawn[first + 4u] = weight.y;
  drawn[first + 5u] = weight.z;
  drawn[first + 6u] = float(direction.lobe);
}
