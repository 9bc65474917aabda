// What each pixel sees of each segment, one record for each, as they come (tiles_shares_gpu.cpp).
struct ShareRecord {
  uint texel, vertex;
  float depth, share;
  vec4 light;  // times the share; w is not used
};

layout(std430, binding = 8) buffer Shares {
  uint told, first_texel, end_texel, unused;  // of the texels from the first to before the end
  ShareRecord shares[];
};

uvec2 shares_block;

void begin_shares(uvec2 block) { shares_block = block; }

void tell_share(int k, uint vertex, float weight, vec3 color, float inverse_depth) {
  uvec2 at = shares_block + in_block(k);
  uint texel = at.y * push.part.x + at.x;
  bool wanted = weight > 0.0 && at.x < push.part.x && at.y < push.part.y && texel >= first_texel && texel < end_texel;
  if (!wanted) return;
  uint slot = atomicAdd(told, 1u);
  if (slot < uint(shares.length())) shares[slot] = ShareRecord(texel, vertex, 1.0 / inverse_depth, weight, vec4(weight * color, 0.0));
}
