#ifndef CUTICLE_RENDER_VERTEX_COLORS_GLSL
#define CUTICLE_RENDER_VERTEX_COLORS_GLSL
layout(binding = 1) uniform samplerBuffer colors;  // per vertex
#endif
