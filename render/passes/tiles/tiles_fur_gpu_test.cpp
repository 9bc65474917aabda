// Coverage of fur: short strands that thin out to their tips and lie in all directions.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/device_bound.h"
#include "tests/support/tile_passes.h"

namespace cuticle::render::tiles_fur_gpu_test {
namespace {

using tests::device, tests::draw, tests::Drawing, tests::mean_difference;

/// Straight strands of two segments, so many pixels long and wide at the root, at random places.
Drawing fur(int strands, float length, float width, float tip_share, float most_turn) {
  Drawing drawing;
  RandomStream random(5);
  const float pixel = drawing.pixel();
  for (int k = 0; k < strands; ++k) {
    const glm::vec3 root(8 * float(random.next_unit()) - 4, 8 * float(random.next_unit()) - 4, -1e-4f * float(k));
    const float turn = most_turn * float(random.next_unit());
    const glm::vec3 along = 0.5f * length * pixel * glm::vec3(std::cos(turn), std::sin(turn), 0);
    drawing.strand({root, root + along, root + 2.0f * along}, 0.5f * width * pixel, glm::vec3(1, 0, 0));
    const std::size_t count = drawing.vertices.size();
    drawing.vertices[count - 2].w *= 0.5f * (1 + tip_share);
    drawing.vertices[count - 1].w *= tip_share;
  }
  return drawing;
}

double error_of(const Drawing& drawing) { return mean_difference(draw(drawing).color, drawing.truth(48), 3, 4); }

// A segment shorter than a tile has its own width in each pixel, not in all pixels that of its end which is nearer to
// the tile's middle.
TEST(TilesOfFur, StrandsThatThinOut_AreCoveredAsWellAsThoseOfOneWidth) {
  for (const std::int64_t rows : {0, 8}) {
    Drawing even = fur(500, 10, 0.3f, 1, 0.6f), thinning = fur(500, 10, 0.6f, 0, 0.6f);
    even.coverage_rows = thinning.coverage_rows = rows;
    const double error_even = error_of(even), error_thinning = error_of(thinning);
    std::printf("%d rows: one width %.5f, thinning %.5f\n", int(rows), error_even, error_thinning);
    EXPECT_LT(error_thinning, 1.4 * error_even) << rows;
  }
}

// Some lie along the rows of samples, whichever way these lie.
TEST(TilesOfFur, StrandsInAllDirections_AreCoveredWithinAHundredth) {
  for (const float width : {0.03f, 0.15f}) {
    const double error = error_of(fur(int(120 / width), 10, width, 0, 2 * std::numbers::pi_v<float>));
    std::printf("%g px wide: coverage error %.5f\n", double(width), error);
    EXPECT_LT(error, 0.01) << width;
  }
}

TEST(TilesOfFur, DrawnBySixtyFourInvocations_IsTheSamePicture) {
  Drawing drawing = fur(1500, 10, 0.2f, 0, 2 * std::numbers::pi_v<float>);
  const Image eight = draw(drawing).color;
  drawing.lanes = 64;
  const Image sixty_four = draw(drawing).color;
  double most = 0;
  for (std::size_t k = 0; k < eight.pixels.size(); ++k)
    most = std::max(most, double(std::abs(eight.pixels[k] - sixty_four.pixels[k])));
  EXPECT_LE(most, tests::bound_for(*device(), 0, 0.02));
}

}  // namespace
}  // namespace cuticle::render::tiles_fur_gpu_test
