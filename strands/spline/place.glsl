// A strand as it is given, or a follow hair beside one. Before this: `vec3 control_at(uint k)`.

struct Row {
  vec4 offset;      // from the guide's root in the rest pose; how much more of it there is at the tip
  vec3 direction;   // of the guide's first segment, there
  uint first, size; // vertices of the guide
  float thickness;  // times the guide's radii
  uint unused0, unused1;
};
layout(std430, binding = 0) readonly buffer Rows { Row rows[]; };
layout(push_constant) uniform Constants {
  vec4 turn[3];
  uint first_strand, strands, size;  // of this dispatch; vertices of each
  float since;
  uint parts;
};

// The vector turned as the shortest turn takes one unit vector to another; as it is where they are opposite.
vec3 turned(vec3 v, vec3 from, vec3 to) {
  const float cosine = dot(from, to);
  const vec3 axis = cross(from, to);
  return cosine > -0.999 ? v + cross(axis, v) + cross(axis, cross(axis, v)) / (1.0 + cosine) : v;
}

// The offset at the root, as the head and the guide's first segment have turned.
vec3 offset_now(Row row) {
  if (dot(row.offset.xyz, row.offset.xyz) == 0.0) return vec3(0.0);
  const mat3 head = mat3(turn[0].xyz, turn[1].xyz, turn[2].xyz);
  const vec3 from = head * row.direction, step = control_at(row.first + 1u) - control_at(row.first);
  return turned(head * row.offset.xyz, from, direction_or(step, from));
}

// Where a drawn vertex lies: between two vertices of the guide, of whose segment `parts` are drawn.
struct Place {
  uint k, next;
  float share;  // of the way to the next
};

uint last_vertex(Row row) { return (row.size - 1u) * parts; }

// Of drawn vertex i; past the tip: the tip.
Place place_of(Row row, uint i) {
  const uint at = min(i, last_vertex(row)), k = at / parts;
  return Place(k, min(k + 1u, row.size - 1u), float(at - k * parts) / float(parts));
}

vec3 beside_guide(Row row, vec3 offset, uint k) {
  return control_at(row.first + k) + offset * (1.0 + row.offset.w * float(k) / float(row.size));
}

vec3 placed_at(Row row, vec3 offset, uint i) {
  const Place at = place_of(row, i);
  const vec3 before = beside_guide(row, offset, at.k);
  return at.share == 0.0 ? before : mix(before, beside_guide(row, offset, at.next), at.share);
}
