#version 460
#extension GL_GOOGLE_include_directive : require
// Diffuse with wrapped light: (wrap + N.L) / (1 + wrap). Light directions come in the mesh's rest frame. THIN: a sheet
// that is seen from both sides, and that lets a share of the light through. UNDER_SURFACES: what surfaces cast falls on it
// too; it is none of them.
#include "render/lights.glsl"
layout(std430, set = 0, binding = 3) readonly buffer Frame {
  vec4 albedo_0, albedo_1;  // w of the first: wrap; of the second: number of lights
  LightRow lights[k_max_lights];
  mat4 rest_to_map[k_max_lights];  // of surface_shadow
  float ambient;                    // share of the lights' sum that arrives from everywhere
  float through;                    // share of the light that comes through
  uint map_resolution, map_columns;  // 0: no hair casts
  float map_filter, bleed;
};
layout(set = 0, binding = 4) uniform usamplerBuffer hair_map;  // bits of depths, row by row
layout(set = 0, binding = 5) uniform sampler2D surface_map;
#include "render/passes/surface_shadow/map_lookup.glsl"
#define UNSHADOWED past_hair_in
#define MAP_DEPTH(x, y) uintBitsToFloat(texelFetch(hair_map, (y) * int(map_resolution * map_columns) + (x)).r)
#include "render/passes/surface_shadow/unshadowed.glsl"
#ifdef UNDER_SURFACES
#define UNSHADOWED past_surfaces_in
#define MAP_DEPTH(x, y) texelFetch(surface_map, ivec2(x, y), 0).r
#include "render/passes/surface_shadow/unshadowed.glsl"
#endif
#define CHANNEL_CONSTANT 0
#include "render/channels.glsl"

layout(location = 0) in vec3 rest_normal;
layout(location = 1) in float mixed;
layout(location = 2) in vec3 rest_position;
layout(location = 0) out vec4 color;

// `which`: of the opacities, whose maps lie one below the other.
float past_hair_of(vec3 at, uint light, uint which) {
  const uint rows = (uint(albedo_1.w) + map_columns - 1u) / map_columns;
  at.y += float(which * rows * map_resolution);
  return past_hair_in(at, light + which * rows * map_columns, map_resolution, map_columns, map_filter);
}

vec3 reached(uint light) {
  if (map_resolution == 0u) return vec3(1.0);
  vec3 at = place_in_light_map(rest_to_map[light] * vec4(rest_position, 1.0), 0.0);
  vec3 past_hair = vec3(past_hair_of(at, light, 0u));
  if (k_different > 1u) {
    float of[3] = float[](past_hair.x, past_hair_of(at, light, 1u), past_hair_of(at, light, k_different - 1u));
    past_hair = vec3(of[k_of_red], of[k_of_green], of[k_of_blue]);
  }
#ifdef UNDER_SURFACES
  past_hair *= past_surfaces_in(at, light, map_resolution, map_columns, map_filter);
#endif
  return past_hair;
}

vec3 wrapped(float cosine) {
  vec3 wrap = albedo_0.w * (1.0 + bleed * vec3(1.0, -0.4, -0.8));
  return max((wrap + cosine) / (1.0 + wrap), vec3(0.0));
}

void main() {
  vec3 normal = normalize(rest_normal);
#ifdef THIN
  if (!gl_FrontFacing) normal = -normal;
#endif
  vec3 received = vec3(0.0);
  for (uint k = 0u; k < uint(albedo_1.w); ++k) {
    Arriving light = arriving_at(rest_position, lights[k]);
    float cosine = dot(normal, light.to_light);
    vec3 share = wrapped(cosine);
#ifdef THIN
    share = mix(share, wrapped(-cosine), through);
#endif
    received += (ambient + (share.r > 0.0 ? share * reached(k) : vec3(0.0))) * light.irradiance;
  }
  color = vec4(held_by_halves(mix(albedo_0.rgb, albedo_1.rgb, mixed) * received * 0.31830989), 1.0);
}
