#version 460
#extension GL_GOOGLE_include_directive : require
// Each pixel that sees hair, or anything where pixel_depth is made: by its depth to the world, by the grid to where that
// was a frame ago, by the camera of then to the screen.
#include "render/passes/velocity/velocity.glsl"
layout(std430, binding = 1) readonly buffer Grid { vec4 grid[]; };
layout(std430, binding = 2) readonly buffer Aovs { float aovs[]; };  // the first of each pixel's: distance along the view
layout(std430, binding = 3) writeonly buffer Vectors { vec2 vectors[]; };  // pixels since the frame before
layout(std430, binding = 4) readonly buffer PixelDepth { float pixel_depth[]; };  // 1 / distance of hair or scene
layout(push_constant) uniform Push { uint aov_count; };

vec3 moved_at(vec3 place) {
  vec3 share;
  uvec3 below = node_below(place, share);
  vec4 sum = vec4(0.0);
  for (uint corner = 0u; corner < 8u; ++corner) {
    uint node;
    float weight = corner_of(below, share, corner, node);
    sum += weight * grid[node];
  }
  return sum.w > 0.0 ? sum.xyz / sum.w : vec3(0.0);
}

float scene_depth(uint pixel) {
  float inverse = has_scene == 1u ? pixel_depth[pixel] : 0.0;
  return inverse > 0.0 ? 1.0 / inverse : 0.0;
}

// What lies in the hair's box moves with it; the rest of the scene stands.
bool is_among_hair(vec3 place) {
  vec3 at = (place - lower.xyz) * nodes_per_metre.xyz;
  return all(greaterThanEqual(at, vec3(0.0))) && all(lessThanEqual(at, vec3(float(nodes - 1u))));
}

void main() {
  uint pixel = invocation();
  if (pixel >= resolution.x * resolution.y) return;
  bool hair = aovs[pixel * aov_count] > 0.0;
  float depth = hair ? aovs[pixel * aov_count] : scene_depth(pixel);
  vec2 middle = vec2(pixel % resolution.x, pixel / resolution.x) + 0.5 - pixel_shift;
  vec2 on_screen = 2.0 * middle / vec2(resolution) - 1.0;
  vec3 place = eye.xyz + depth * (forward.xyz + on_screen.x * right.xyz - on_screen.y * up.xyz);
  vec4 clip = world_to_clip_before * vec4(place - (hair || is_among_hair(place) ? moved_at(place) : vec3(0.0)), 1.0);
  vec2 then = (clip.xy / clip.w * 0.5 + 0.5) * vec2(resolution);
  vectors[pixel] = depth > 0.0 && clip.w > 0.0 ? middle - then : vec2(0.0);
}
