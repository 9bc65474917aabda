#include "shadows/mean_fibre.h"

#include "shadows/detail/map_walk.h"
#include "shadows/fibres.glslh"

namespace cuticle::shadows {

FibreSums sums_of_fibre(const MapView& view, const strands::Groom& groom) {
  FibreSums sums{};
  for_each_index(groom.strand_count(), [&](std::size_t s) {
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v) {
      if (!is_sampled(v - std::uint32_t(s))) continue;
      const SegmentInMap segment = segment_in_map(view, groom, v);
      const std::uint32_t weight = piece_weight(segment.size());
      add_to(sums[0], weight);
      add_to(sums[1], weight * middle_coverage(segment.half_width));
    }
  });
  return sums;
}

float fibre_exponent(const FibreSums& sums, std::span<const std::uint32_t> table, float per_unit) {
  return per_unit * float(table[fibre_coverage(sums[0], sums[1])]);
}

}  // namespace cuticle::shadows
