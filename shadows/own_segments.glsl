// The segments around a vertex that do not shadow it. The shader that includes this, after
// map_segment.glsl, defines distance_across().
#include "shadows/own_fibre.glslh"

/// Distance of a vertex from the receiver across the light, in the units of reach and slack.
float distance_across(uint v);

uint own_begin = 0u, own_end = 0u;  // segments

/// The first segment that begins at a vertex not before v.
uint segment_from(uint v) {
  uint first = 0u;
  for (uint count = push.segment_count; count > 0u;) {
    const uint half_count = count / 2u;
    const bool is_before = first_vertex(first + half_count) < v;
    first = is_before ? first + half_count + 1u : first;
    count = is_before ? count - half_count - 1u : half_count;
  }
  return first;
}

/// Segments before and from `s`, which begins at vertex v or is the first behind it, as long as they are joined and still
/// the receiver's own.
void find_own_segments(uint s, uint v, float reach, float slack) {
  own_begin = own_end = s;
  if (s < push.segment_count && first_vertex(s) == v) ++own_end;  // the receiver may lie on it
  float furthest = 0.0;
  while (own_end < push.segment_count && first_vertex(own_end) == v + (own_end - s)) {
    const float away = distance_across(v + (own_end - s));
    if (!is_still_own(away, furthest, reach, slack)) break;
    furthest = max(furthest, away);
    ++own_end;
  }
  furthest = 0.0;
  while (own_begin > 0u && first_vertex(own_begin - 1u) + 1u == v - (s - own_begin)) {
    const float away = distance_across(v - (s - own_begin));
    if (!is_still_own(away, furthest, reach, slack)) break;
    furthest = max(furthest, away);
    --own_begin;
  }
}
