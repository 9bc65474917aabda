#pragma once
#include <string_view>

#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::aovs {

/// What each pixel sees.
struct Layers;
constexpr std::string_view resource_name(const Layers*) { return "layers"; }

/// The registry's entry of the pass.
const Pass& entry();

/// What it writes per pixel, in this order, as EXR names them. Where no hair is seen all are 0 but the cost.
inline constexpr std::string_view k_channels[] = {
    "depth.Z",                                    // distance along the view, metres
    "tangent.X",       "tangent.Y", "tangent.Z",  // unit, world, root to tip
    "strand.id",                                  // from 1
    "coverage.Y",                                 // of the pixel by hair
    "transmittance.Y",                            // of the first light, where the strand is
    "samples.Y",                                  // segments (tiles) or strands (quads) that the colour was made of
    "cost.Y",                                     // segments looked at (tiles) or strands shaded (quads)
};
/// With the pass 'velocity': what the seen point's velocity is, m/s, world, as the solver hands it over.
inline constexpr std::string_view k_velocity_channels[] = {"world_velocity.X", "world_velocity.Y", "world_velocity.Z"};

}  // namespace cuticle::render::aovs
