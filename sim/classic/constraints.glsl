// N8, H4 to H6 in the kernels: sweeps over a strand's constraints, and the end of a substep. After sim/strand_kernel.glsl.
#include "sim/classic/shape_sphere.glslh"
layout(constant_id = 0) const uint red_black = 0u;
layout(constant_id = 1) const uint long_range = 1u;
layout(constant_id = 2) const float sphere_root = 0;
layout(constant_id = 3) const float sphere_tip = 0;
bool has_spheres() { return sphere_root > 0 || sphere_tip > 0; }

void keep_reach(uint i, uint anchor) {
  vec3 before = direction_of(starts[i].xyz - starts[anchor].xyz);
  positions[i].xyz -= reach_excess(positions[i].xyz - positions[anchor].xyz, traits[i].z, before);
}

void keep_length(uint i) {
  float total = traits[i - 1u].x + traits[i].x;
  vec3 edge = positions[i].xyz - positions[i - 1u].xyz;
  vec3 before = direction_of(starts[i].xyz - starts[i - 1u].xyz);
  vec3 fallback = before;
  if (lacks_direction(edge, places[i].w)) fallback = rest_direction(i, rotation_end);
  vec3 excess = length_excess(edge, places[i].w, before, fallback) / total;
  positions[i - 1u].xyz += excess * traits[i - 1u].x;
  positions[i].xyz -= excess * traits[i].x;
}

void keep_in_sphere(uint i) {
  float radius = shape_radius(sphere_root, sphere_tip, traits[i].y);
  positions[i].xyz = kept_within(positions[i].xyz, target_of(i, rotation_end), radius);
}

void sweep_in_sequence(uint anchor, uint last) {
  for (uint i = anchor + 1u; i < last; ++i) {
    if (long_range != 0u) keep_reach(i, anchor);
    keep_length(i);
  }
}

void sweep_red_black(uint anchor, uint last) {
  for (uint i = anchor + 1u; long_range != 0u && i < last; ++i) keep_reach(i, anchor);
  for (uint i = anchor + 1u; i < last; i += 2u) keep_length(i);
  for (uint i = anchor + 2u; i < last; i += 2u) keep_length(i);
}

// One pass over the constraints of a strand, by one thread.
void sweep_lengths(uint anchor, uint last) {
  if (red_black != 0u) {
    sweep_red_black(anchor, last);
  } else {
    sweep_in_sequence(anchor, last);
  }
  for (uint i = anchor + 1u; has_spheres() && i < last; ++i) keep_in_sphere(i);
}

#include "sim/finite.glsl"

bool update_velocity(uint i) {
  vec3 moved = positions[i].xyz - starts[i].xyz + head_step;
  if (inverse_duration > 0) velocities[i] = vec4(moved * inverse_duration, 0);
  return finite(positions[i].xyz) && finite(velocities[i].xyz);
}

void reset(uint i) {
  vec3 next = target_of(i, rotation_end);
  positions[i] = vec4(next, 0);
  velocities[i] = vec4((next - target_of(i, rotation_begin) + head_step) * inverse_duration, 0);
}

void finish(uint strand, uint first, uint last) {
  bool good = true;
  for (uint i = first; i < last; ++i) good = update_velocity(i) && good;
  if (!good) {
    resets[strand] = 1u;
    for (uint i = first; i < last; ++i) reset(i);
  }
  for (uint i = first; i < last; ++i) world[i] = vec4(positions[i].xyz + translation, 1);
}
