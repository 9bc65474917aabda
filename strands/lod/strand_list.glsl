// A list of strands that a kernel made, for kernels that are dispatched over the listed alone (strand_list_gpu.h has the
// same words). Before this stands STRAND_LIST_BINDING, the number of its binding.
layout(std430, set = 0, binding = STRAND_LIST_BINDING) readonly buffer StrandList {
  uint listed_strands;
  uint listed_row;  // vertices of a strand; 0: there is no list, all strands count
  uint listed_groups[6];
  uint listed[];
};
const uint k_not_listed = 0xffffffffu;

uint listed_item(uint place, uint per_strand) {
  if (listed_row == 0u) return place;
  const uint strand = place / per_strand;
  return strand < listed_strands ? listed[strand] * per_strand + place % per_strand : k_not_listed;
}
/// The vertex, or segment of so many parts, with this number among those of the listed strands; past the last k_not_listed.
uint listed_vertex(uint place) { return listed_item(place, listed_row); }
uint listed_segment(uint place, uint parts) { return listed_item(place, (listed_row - 1u) / parts); }
