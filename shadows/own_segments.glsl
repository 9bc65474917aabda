// The segments around a vertex that do not shadow it. The shader that includes this, after map_segment.glsl, defines
// visit_own_vertex() and visit_own_segment().
#include "shadows/lookup_place.glsl"

/// The walk goes on to vertex v: its distance from the receiver across the light, in the units of reach and slack.
float visit_own_vertex(uint v);
/// The walk begins again at the vertex that it visited first.
void return_to_own_vertex();
/// Segment s, between the last two vertices visited; it begins at the later of them where `backward`.
void visit_own_segment(uint s, bool backward, bool is_first, bool is_last);

const uint k_no_vertex = 0xffffffffu;
uint own_begin = 0u, own_end = 0u;  // segments

/// The first segment that begins at a vertex not before v. Every segment begins at least one vertex behind the one
/// before, so that a guess by equally long strands bounds where it lies.
uint segment_from(uint v) {
  const uint last = first_vertex(push.segment_count - 1u);
  if (v > last) return push.segment_count;
  const float share = float(v) / float(max(last, 1u));
  const uint guess = min(uint(share * float(push.segment_count - 1u)), push.segment_count - 1u);
  const uint there = first_vertex(guess);
  uint first = there < v ? guess + 1u : guess - min(guess, there - v);
  uint count = there < v ? min(guess + (v - there), push.segment_count) - first : guess - first;
  while (count > 0u) {
    const uint half_count = count / 2u;
    const bool is_before = first_vertex(first + half_count) < v;
    first = is_before ? first + half_count + 1u : first;
    count = is_before ? count - half_count - 1u : half_count;
  }
  return first;
}

bool begins_at(uint s, uint v) { return s < push.segment_count && first_vertex(s) == v; }
bool ends_at(uint s, uint v) { return s > 0u && first_vertex(s - 1u) + segment_parts() == v; }  // the one before s

/// Where a receiver at vertex v stands: on segment s from its first vertex on, `at`; or at v, `at`, where none holds it
/// before its end and s is the first that begins behind it.
struct OwnPlace {
  uint s, at;
};
OwnPlace own_place(uint v) {
  const uint s = segment_from(v);
  const bool is_within = s > 0u && first_vertex(s - 1u) + segment_parts() > v;
  return OwnPlace(is_within ? s - 1u : s, is_within ? first_vertex(s - 1u) : v);
}

/// A vector along the strand at vertex v: of segment s, which begins there, or of its last one; zero where v has none.
vec3 own_along(uint s, uint v) {
  const uint parts = segment_parts(), from = begins_at(s, v) ? v : ends_at(s, v) ? v - parts : k_no_vertex;
  if (from == k_no_vertex) return vec3(0.0);
  return drawn_vertex(from + parts).xyz - drawn_vertex(from).xyz;
}

/// At vertex v, where segment s begins or would.
LookupPlace lookup_place(vec3 on_axis, uint s, uint v) {
  return lookup_place(on_axis, own_along(s, v), drawn_vertex(v).w);
}

/// Segments from `s` on and before it, which begins at vertex v or is the first behind it, as long as they are joined and
/// still the receiver's own; the one that begins at v the receiver may lie on. One loop for both ways: neighbouring
/// invocations then wait for the longest of their walks, not for the longest of each way.
void find_own_segments(uint s, uint v, float reach, float slack) {
  const float away = visit_own_vertex(v);
  const bool has_after = begins_at(s, v), has_before = ends_at(s, v),
             goes_back = has_before && is_still_own(away, 0.0, reach, slack);
  own_begin = own_end = s;
  if (!has_after && !goes_back) return;
  bool backward = !has_after, goes_on;
  float furthest = backward ? away : 0.0;
  uint at = v;
  do {
    at = backward ? at - segment_parts() : at + segment_parts();
    own_begin -= backward ? 1u : 0u;
    const uint segment = backward ? own_begin : own_end;
    const float next = visit_own_vertex(at);
    const bool is_joined = backward ? ends_at(segment, at) : begins_at(segment + 1u, at);
    visit_own_segment(segment, backward, backward ? !is_joined : segment == s && !has_before,
                      backward ? segment + 1u == s && !has_after : !is_joined);
    own_end += backward ? 0u : 1u;
    goes_on = is_joined && is_still_own(next, furthest, reach, slack);
    furthest = max(furthest, next);
    if (!goes_on && !backward && goes_back) {
      goes_on = backward = true;
      furthest = away;
      at = v;
      return_to_own_vertex();
    }
  } while (goes_on);
}
