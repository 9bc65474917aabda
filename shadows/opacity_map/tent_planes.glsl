// Tent weights of the sixteen planes that four four-channel targets hold.
#include "shadows/opacity_map/tent.glslh"

/// For depth z, in plane spacings; needs map_geometry.glsl.
vec4[4] tent_weights(float z) {
  const float limited = min(z, float(push.layers));
  vec4 weights[4];
  for (int i = 0; i < 16; ++i) weights[i / 4][i % 4] = tent_weight(limited, float(i + 1));
  return weights;
}
