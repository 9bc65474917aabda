#include "render/visibility/drawn_part_gpu.h"

#include <algorithm>
#include <cmath>

#include "strands/lod/lod.glslh"
#include "strands/lod/lod.h"

namespace cuticle::render::visibility {

DrawnPart drawn_part(const Resources& resources, double full_px, bool whole_segments) {
  const DrawnHair& hair = resources.get<DrawnHair>();
  constexpr double k_least_share = 0.01;
  const std::uint32_t size = hair.vertices_per_strand;
  const std::uint32_t on_a_line = whole_segments ? hair.segment_parts : 1;
  DrawnPart part{hair.strands.vertex_count / std::max(1u, size), (std::max(1u, size) - 1) / on_a_line};
  if (full_px == 0 || part.strands == 0) return part;
  const double covered_px = strands::covered_pixels(hair.strands.bounds, resources.get<FrameView>().camera);
  const double share = strands::drawn_share<double>(covered_px, full_px, k_least_share);
  const double steps = std::floor(4 * std::log2(1 / share));
  part.width = std::exp2(steps / 4);
  part.opacity = strands::level_opacity<double>(1 / part.width);
  part.strands = strands::drawn_strands(part.strands, float(1 / part.width));
  part.segments = std::uint32_t(strands::drawn_vertices<double>(size, 1 / part.width)) - 1;
  return part;
}

}  // namespace cuticle::render::visibility
