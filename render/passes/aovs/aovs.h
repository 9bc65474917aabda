#pragma once
#include <string_view>

#include <cuticle/render/pass.h>

namespace cuticle::render::aovs {

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

}  // namespace cuticle::render::aovs
