#pragma once
// What pixels see, object by object: pictures of samples in depth, for compositing.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "core/image/image.h"

namespace cuticle {

/// What a pixel sees of one object: a share of the pixel (0 .. 1, behind whatever hides a part of it), and the light
/// that comes from there, times that share.
struct SeenShare {
  std::uint32_t pixel = 0;   ///< row by row, row 0 on top
  std::uint32_t object = 0;  ///< from 1; 0: none of those that are told apart
  float depth = 0;           ///< along the view, metres
  glm::vec4 light{0};        ///< red, green, blue, share
};

/// A sample of a pixel: premultiplied colour, opacity of its own.
struct DeepSample {
  float depth = 0;
  glm::vec4 color{0};
  std::uint32_t object = 0;
};
/// The samples of each pixel from near to far: those of pixel p are offsets[p] .. offsets[p + 1].
struct DeepImage {
  int width = 0, height = 0;
  std::vector<std::uint32_t> offsets;
  std::vector<DeepSample> samples;
};

/// Shares of one object in one pixel become one sample, at their mean depth. Each sample's opacity is its share of what
/// those before it leave, so that samples laid over each other from far to near give the sum of the shares; light that
/// is left where nothing is (rounding) goes to the last. Shares outside the picture or not finite are left out. Test:
/// deep_test.
DeepImage deep_image(glm::ivec2 size, std::vector<SeenShare> shares);

/// The shares, and as object 0 what the picture (R, G, B, A) holds in each pixel beside them: at the depth that
/// `behind` has for the pixel, at `farthest` where it has none or 0, and before all where the shares leave no room for
/// it.
std::vector<SeenShare> with_rest(std::vector<SeenShare> shares, const Image& color, std::span<const float> behind,
                                 double farthest);

/// All samples laid over each other: R, G, B (premultiplied), A.
Image flatten(const DeepImage& deep);

/// Deep scan lines (OpenEXR): R, G, B, A, Z as floats and `id`, the object, as whole numbers; ZIPS, string attributes.
/// Error: bad_input naming the file, as write_exr.
Result<void> write_deep_exr(const std::string& path, const DeepImage& deep,
                            const std::map<std::string, std::string>& attributes = {});

}  // namespace cuticle
