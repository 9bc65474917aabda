#version 460
// Vertices pulled from a buffer: clip position and colour.
struct Vertex { vec4 position, color; };
layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
layout(location = 0) out vec4 color;

void main() {
  gl_Position = vertices[gl_VertexIndex].position;
  color = vertices[gl_VertexIndex].color;
}
