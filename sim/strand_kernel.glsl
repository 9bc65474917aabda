// Storage and constants that the strand kernels share: sim/rest_pose.h, sim/classic/kernel_gpu.h. One thread per strand, or
// the group that a kernel defines.
#ifndef STRAND_THREADS
#define STRAND_THREADS 64
#define POSITIONS buffer
#endif
#ifndef PLACES
#define PLACES readonly buffer
#endif
layout(local_size_x = STRAND_THREADS) in;

layout(binding = 0) readonly buffer Offsets { uint offsets[]; };
layout(binding = 1) PLACES Places { vec4 places[]; };               // rest position, segment length
layout(binding = 2) readonly buffer Traits { vec4 traits[]; };      // inverse mass, fraction of length, reach, longest segment
layout(binding = 3) POSITIONS Positions { vec4 positions[]; };         // relative to the head's translation
layout(binding = 4) buffer Starts { vec4 starts[]; };               // the same at the substep's begin
layout(binding = 5) buffer Velocities { vec4 velocities[]; };
layout(binding = 6) buffer Resets { uint resets[]; };               // per strand: whether the guard fired in this frame
layout(binding = 7) writeonly buffer World { vec4 world[]; };
layout(binding = 8) readonly buffer Spheres { vec4 spheres[]; };    // centre in rest space, radius: SubstepSpheres
layout(binding = 9) readonly buffer Reach { uint reach[]; };        // per strand: whether a sphere may touch it; then those

layout(push_constant) uniform Constants {
  vec4 carry, rotation_begin, rotation_end;
  vec3 head_step;
  float velocity_to_step;
  vec3 fall;
  float shape_rate;
  float shape_tip;
  float inverse_duration;
  uint strand_count;
  uint clamped_vertices;
  vec3 translation;
  uint iterations;
  uint part;           // substep, low 16 bits, of how many in the frame
  uint ends_substep;   // of the constraints: whether they end it for all; of contacts: how many strands they meet
  float pearl_radius;
  uint contacts;       // number of spheres; the highest bit: pearls are fitted; the next: some move by themselves
};

bool is_reached(uint strand) { return reach[strand] != 0u; }
uint reached_strand(uint place) { return reach[strand_count + place]; }

uint part_index() { return part & 0xffffu; }
uint part_count() { return part >> 16; }
vec3 target_of(uint i, vec4 rotation) { return turned(places[i].xyz, rotation.xyz, rotation.w); }
vec3 rest_direction(uint i, vec4 rotation) { return direction_of(target_of(i, rotation) - target_of(i - 1u, rotation)); }
// Last vertex that the head carries, of the strand [first, last).
uint anchor_of(uint first, uint last) { return first + min(clamped_vertices, last - first) - 1u; }
