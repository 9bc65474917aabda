#version 460
// The hair's picture over the scene's, texel by texel of the supersampled targets: blended, depth tested and written.
layout(set = 0, binding = 0) uniform samplerBuffer picture;  // radiance times alpha, alpha
layout(set = 0, binding = 1) uniform samplerBuffer mean_depth;
layout(push_constant) uniform Push {
  uvec2 part;        // pixels that are drawn
  float per_sample;  // 1 / supersampling
  float inverse_near, inverse_far;
};
layout(location = 0) out vec4 color;

void main() {
  uvec2 at = uvec2(gl_FragCoord.xy * per_sample);
  int pixel = int(at.y * part.x + at.x);
  vec4 hair = texelFetch(picture, pixel);
  if (hair.a <= 0.0) discard;
  color = vec4(hair.rgb / hair.a, hair.a);
  gl_FragDepth = clamp((inverse_near - texelFetch(mean_depth, pixel).r) / (inverse_near - inverse_far), 0.0, 1.0);
}
