// Hair that is lit from one side: how light the other side is, by cards and by tiles.
#include <cuticle/tests/support/small_frames.h>

#include <cstdio>

namespace cuticle::plan::card_light_gpu_test {
namespace {

using namespace tests;

constexpr std::string_view k_bald = R"("head": {"present": false})",
                           k_side = R"("lights": [{"to_light": [1, 0.2, 0], "irradiance": [6, 6, 6]}])";

/// Mean luminance of the hair in the columns first to last, of the pixels' part that is hair.
double luminance(const Image& picture, int first, int last) {
  double sum = 0, covered = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = first; x <= last; ++x) {
      sum += 0.2126 * double(picture.at(x, y, 0)) + 0.7152 * double(picture.at(x, y, 1)) +
             0.0722 * double(picture.at(x, y, 2));
      covered += double(picture.at(x, y, 3));
    }
  return sum / covered;
}

// Cards have no light but what arrives at them straight; tiles scatter some of it on.
TEST(CardLight, OnTheSideAwayFromTheLight_IsAFractionOfThatByTiles) {
  double lit[2], shaded[2];
  for (int k = 0; k < 2; ++k) {
    const Image picture = frame_of(*runner({k_side, k_shadow, k_bald, k == 0 ? k_tiles : k_cards}), 0).color;
    lit[k] = luminance(picture, 36, 63);
    shaded[k] = luminance(picture, 0, 27);
  }
  std::printf("luminance towards the light: tiles %.4f, cards %.4f; away: tiles %.4f, cards %.4f\n", lit[0], lit[1],
              shaded[0], shaded[1]);
  EXPECT_GT(shaded[1], shaded[0] / 6);  // measured: a fifth
  EXPECT_LT(shaded[1], shaded[0] / 4);
  EXPECT_GT(lit[1], 0.5 * lit[0]);  // measured: .64
}

}  // namespace
}  // namespace cuticle::plan::card_light_gpu_test
