#version 460
// The hair's picture over the scene's, texel by texel of the supersampled targets: blended, depth tested and written.
layout(std430, set = 0, binding = 0) readonly buffer Picture { uvec2 picture[]; };
layout(std430, set = 0, binding = 1) readonly buffer Depth { float mean_depth[]; };
layout(push_constant) uniform Push {
  uint width, supersampling;
  float inverse_near, inverse_far;
};
layout(location = 0) out vec4 color;

void main() {
  uvec2 at = uvec2(gl_FragCoord.xy) / supersampling;
  uint pixel = at.y * width + at.x;
  vec4 hair = vec4(unpackHalf2x16(picture[pixel].x), unpackHalf2x16(picture[pixel].y));
  if (hair.a <= 0.0) discard;
  color = vec4(hair.rgb / hair.a, hair.a);
  gl_FragDepth = clamp((inverse_near - mean_depth[pixel]) / (inverse_near - inverse_far), 0.0, 1.0);
}
