#version 460
// A mesh of the scene: vertices pulled from buffers. position.w: which of two albedos; on the head 1 where hair grows.
layout(std430, set = 0, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, set = 0, binding = 1) readonly buffer Normals { vec4 normals[]; };
layout(std430, set = 0, binding = 2) readonly buffer Indices { uint indices[]; };
layout(push_constant) uniform Push {
  mat4 rest_to_clip;
};

layout(location = 0) out vec3 rest_normal;
layout(location = 1) out float mixed;
layout(location = 2) out vec3 rest_position;

void main() {
  uint vertex = indices[gl_VertexIndex];
  rest_normal = normals[vertex].xyz;
  mixed = positions[vertex].w;
  rest_position = positions[vertex].xyz;
  gl_Position = rest_to_clip * vec4(positions[vertex].xyz, 1.0);
}
