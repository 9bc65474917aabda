// Push constants of both kernels (Push of strands_in_sight_gpu.cpp, word for word).
layout(push_constant) uniform Push {
  mat4 world_to_clip;
  vec2 side;         // of the picture with its margin, over half the picture
  vec2 per_radius;   // what a radius adds to it, over half the picture at a distance of 1
  uint strand_count, vertices_per_strand;
};
