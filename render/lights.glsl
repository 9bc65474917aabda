#ifndef CUTICLE_RENDER_LIGHTS_GLSL
#define CUTICLE_RENDER_LIGHTS_GLSL
// Lights as shaders read them; lights_gpu.h holds the same fields.
const uint k_max_lights = 8u;

struct LightRow {
  vec4 place;  // w = 0: unit direction to a distant light; 1: where a point light stands, metres
  vec4 power;  // rgb: irradiance on a plane facing the distant light, or the point light's intensity, power per solid angle
  vec4 cone;   // of a point light: with the unit direction d away from it, clamp(xyz . d + w)^2 of its intensity goes there
};

struct Arriving {
  vec3 to_light;    // unit
  vec3 irradiance;  // on a plane facing the light, where nothing shadows
};

const float k_least_distance = 1e-3;  // metres: what lies nearer to a point light is lit as from there

Arriving arriving_at(vec3 point, LightRow light) {
  if (light.place.w == 0.0) return Arriving(light.place.xyz, light.power.rgb);
  const vec3 way = light.place.xyz - point;
  const float square = dot(way, way);
  const vec3 to_light = square > 0.0 ? way * inversesqrt(square) : vec3(0.0, 1.0, 0.0);
  const float share = clamp(light.cone.w - dot(light.cone.xyz, to_light), 0.0, 1.0);
  return Arriving(to_light, light.power.rgb * (share * share / max(square, k_least_distance * k_least_distance)));
}

// Radiance as the targets' halves hold it: beside a point light it passes the largest.
vec3 held_by_halves(vec3 radiance) { return min(radiance, vec3(65504.0)); }
#endif
