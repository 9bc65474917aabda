// The strand that stands at a place among those to draw. Before this stand LISTED_CONSTANT, the number of a
// specialisation constant, and LISTED_BINDING, that of a buffer (cull_strands_gpu.h).
layout(constant_id = LISTED_CONSTANT) const uint k_listed = 0u;  // 1: those of the list only
layout(std430, set = 0, binding = LISTED_BINDING) readonly buffer List { uint list[]; };

uint strand_at(uint place) { return k_listed == 0u ? place : list[place]; }
