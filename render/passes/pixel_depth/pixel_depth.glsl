// The nearest of a pixel's texels and samples, and of the hair that `aovs` found there, as 1 / distance along the view:
// that is linear in the stored depth, finite where nothing is seen (0), and what blur goes by.
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#include "gpu/groups.glsl"

layout(std430, binding = 0) readonly buffer Aovs { float aovs[]; };  // the first of each pixel's: distance along the view
layout(std430, binding = 1) writeonly buffer PixelDepth { float pixel_depth[]; };
layout(push_constant) uniform Push {
  uvec2 resolution;
  float inverse_near, inverse_far;
  uint supersampling;
  uint aov_count;  // 0: hair is in the depth target
};

/// The least depth that is stored in a texel; 1: nothing drawn.
float texel_depth(ivec2 texel);

void main() {
  const uint pixel = invocation();
  if (pixel >= resolution.x * resolution.y) return;
  const ivec2 first = ivec2(uvec2(pixel % resolution.x, pixel / resolution.x) * supersampling);
  float nearest = 1.0;
  for (int y = 0; y < int(supersampling); ++y)
    for (int x = 0; x < int(supersampling); ++x) nearest = min(nearest, texel_depth(first + ivec2(x, y)));
  const float hair = aov_count > 0u ? aovs[pixel * aov_count] : 0.0;
  const float scene = nearest < 1.0 ? mix(inverse_near, inverse_far, nearest) : 0.0;
  pixel_depth[pixel] = max(scene, hair > 0.0 ? 1.0 / hair : 0.0);
}
