// Share of the way from end to end of a segment, as seen in perspective, at which it is nearest to a point on the
// screen (pixels).
float share_at(mat4 world_to_clip, vec2 point, vec2 size, vec3 from, vec3 to) {
  vec4 a = world_to_clip * vec4(from, 1.0), b = world_to_clip * vec4(to, 1.0);
  if (min(a.w, b.w) <= 0.0) return a.w > b.w ? 0.0 : 1.0;
  vec2 start = (a.xy / a.w * 0.5 + 0.5) * size, along = (b.xy / b.w * 0.5 + 0.5) * size - start;
  float share = clamp(dot(point - start, along) / max(dot(along, along), 1e-12), 0.0, 1.0);
  return share * a.w / mix(b.w, a.w, share);
}
