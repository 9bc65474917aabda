#pragma once
// Light from all around, as a few distant lights.
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/result.h"
#include "core/view.h"

namespace cuticle::scene {

/// How a picture of the surroundings becomes lights.
struct Environment {
  int lights = 6;           ///< at most; fewer where fewer texels shine
  double turn_degrees = 0;  ///< about the vertical: what the middle column shows goes from +z towards +x
  double scale = 1;         ///< of the radiance
};

/// The surroundings where no picture is given: a clear sky in the afternoon over grey ground, a low sun in front to the
/// right (+x). 64 x 32 texels; as a surface that faces up receives it, the irradiance is about 2.
Image built_in_sky();
/// The picture of a file, values of -0.001 .. 0 as 0, or, where the name is empty, the built-in sky. Error: as read_image.
Result<Image> surroundings_of(const std::string& file);

/// Distant lights of a picture in latitude and longitude (twice as wide as high; linear radiance in its first three
/// channels; top row up, middle column at +z, its right at -x): the sphere is cut into regions of like luminance, the
/// brightest across its longer side until there are enough, and each region shines from its mean direction with all its
/// light (Debevec, A Median Cut Algorithm for Light Probe Sampling, 2005). `irradiance` of all lights together is the
/// integral of radiance over the sphere, within float rounding (environment_test). A black picture gives no lights. They
/// are named `environment 1`, `environment 2`, ..; a single one `environment`.
/// Errors: bad_input names the shape, or the first texel that is negative or not finite.
Result<std::vector<Light>> environment_lights(const Image& picture, const Environment& environment);

}  // namespace cuticle::scene
