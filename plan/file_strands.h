#pragma once
// The strands of a groom file as a scene's hair.
#include "plan/strand_set.h"

namespace cuticle::plan {

/// Of each of so many drawn strands, metres: a drawn strand shades, covers and shadows for several fibres side by side;
/// past a millimetre it would look like one itself.
float drawn_radius(const scene::Scene& scene, const strands::Groom& control, std::size_t strands);

/// Opacity of a crossing of each of so many drawn strands: the share of its width that opaque fibres side by side take,
/// as many as it stands for. 1, but where `fibre_count` is below the number of strands.
double crossing_opacity(const scene::Scene& scene, const strands::Groom& control, std::size_t strands);

/// Width of a fibre as a share of that of each of so many drawn strands, which stand for the scene's fibres.
float fibre_width(const scene::Scene& scene, const strands::Groom& control, std::size_t strands);

/// What every strand's own hair is: itself.
void draw_each_strand(StrandSet& set);

/// What of the control hairs is drawn as it is: they and follow hairs, in the scene's order, with their radii.
/// `has_radii`: the control hairs' radii are to be drawn as they are.
void place_strands(const scene::Scene& scene, std::span<const strands::FollowHairs> follow_hairs, bool has_radii,
                   StrandSet& set);

/// Reads the scene's groom file into `set`: control hairs, what is drawn of them, the head under them, colliders.
/// Error: bad_input from the readers, or naming the key that cannot be met.
Result<void> read_file_strands(const scene::Scene& scene, StrandSet& set);

}  // namespace cuticle::plan
