#pragma once
// How wide strands are as lines.
#include "render/visibility/drawn_part_gpu.h"

namespace cuticle::render::lines {

/// Line width in supersampled pixels: as given, or that of the widest strand where it may be nearest in this frame, up
/// to the next fourth root of 2, at least one supersample and at most `widest_px`.
float line_width(const Resources& resources);
/// What a radius is multiplied by, over its depth, for the opacity of its strand: its width over that of a line, which
/// is `width` supersamples. 0, all opaque, where the parameter `width_px` gives a width.
float opacity_of_radius(const Resources& resources, const visibility::DrawnPart& part, float width);
inline constexpr float k_max_line_width = 8;  ///< supersamples; devices with wide lines have 8 at least
/// A width times a factor of at least 1, up to k_max_line_width.
float widened(float width, double factor);

}  // namespace cuticle::render::lines
