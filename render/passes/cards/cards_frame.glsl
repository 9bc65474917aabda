// What a frame tells the shaders of cards (CardFrame of cards_gpu.cpp, word for word).
#include "render/lights.glsl"
#include "render/passes/cards/card_rows.glsl"

layout(std430, set = 0, binding = 0) readonly buffer Placed { PlacedRow placed[]; };
layout(std430, set = 0, binding = 1) readonly buffer Rests { CardRest rests[]; };
layout(std430, set = 0, binding = 2) readonly buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 3) readonly buffer Frame {
  mat4 world_to_clip;
  vec4 eye;
  vec4 atlas;      // first u of a kind's hair, its width, the step from kind to kind; w: alpha from which on it is opaque
  vec4 diffuse;    // times the base colour; w: number of lights
  vec4 primary;    // w: exponent
  vec4 secondary;  // w: exponent
  vec4 shifts;     // primary, secondary; z: what the base texture is multiplied by
  vec4 multiple;   // of light scattered many times, per irradiance
  uint vertex_count;  // of what transmittance.glsl calls vertices: here the rows of all cards
  LightRow lights[k_max_lights];
};
layout(std430, set = 0, binding = 4) buffer Shaded { uint shaded_count[]; };
layout(set = 0, binding = 7) uniform sampler2D atlas_texture;  // base, shift, mask, alpha
