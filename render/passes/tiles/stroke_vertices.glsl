// Segments from their vertices.
#include "render/passes/tiles/stroke.glsl"

layout(binding = 0) uniform samplerBuffer vertices;
layout(binding = 1) uniform samplerBuffer colors;

Stroke stroke_from(uint vertex) {
  return projected_stroke(texelFetch(vertices, int(vertex)), texelFetch(vertices, int(vertex + 1u)),
                          texelFetch(colors, int(vertex)).rgb, texelFetch(colors, int(vertex + 1u)).rgb);
}
