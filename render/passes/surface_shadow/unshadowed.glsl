// How much of a square of a light's map lies no nearer to the light than a point. `at`: x, y in texels of the texture,
// z depth; the square's half side in texels is at least 1/2, so that the mean is continuous in the point's place.
// Before this: UNSHADOWED, the function's name, and MAP_DEPTH(x, y), the depth of a texel; undefined after it.
float UNSHADOWED(vec3 at, uint light, uint resolution, uint columns, float half_side) {
  // Both ends stay in the map: beside a point light's plane a place lies farther off than whole numbers reach.
  vec2 first_texel = vec2(light % columns, light / columns) * float(resolution);
  vec2 last_texel = first_texel + float(resolution);
  vec2 low = clamp(at.xy - half_side, first_texel, last_texel), high = clamp(at.xy + half_side, first_texel, last_texel);
  ivec2 from = ivec2(floor(low)), to = ivec2(ceil(high));
  float sum = 0.0, area = 0.0, depth = min(at.z, 1.0);  // beyond all that casts: as deep as an empty texel
  for (int y = from.y; y < to.y; ++y)
    for (int x = from.x; x < to.x; ++x) {
      vec2 inside = min(high, vec2(x, y) + 1.0) - max(low, vec2(x, y));
      float weight = inside.x * inside.y;
      sum += MAP_DEPTH(x, y) < depth ? 0.0 : weight;
      area += weight;
    }
  return area > 0.0 ? sum / area : 1.0;  // beside the map nothing casts
}
#undef UNSHADOWED
#undef MAP_DEPTH
