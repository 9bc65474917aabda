// Dual scattering in every way of drawing that shades from tables: beside brute force, which is shaded as `tiles` are.
#include "tests/support/small_frames.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace cuticle::plan::dual_scattering_gpu_test {
namespace {

using namespace tests;

constexpr std::string_view k_frame = R"("lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}],
    "shadow": {"method": {"opacity_map": {"resolution": 96}}, "fibre_alpha": 0.4}, "head": {"present": false})";

constexpr std::string_view k_without = R"("passes": {})", k_with = R"("passes": {"dual_scattering": {}})",
                           k_once = R"("passes": {"lines": {"ambient": 0}})",
                           k_with_no_others =
                               R"("passes": {"dual_scattering": {"forward_density": 0, "backward_density": 0}})";

/// Mean luminance of the picture.
double luminance(std::string_view way, std::string_view passes) {
  const scene::Scene scene = scene_of({k_frame, way, passes});
  auto made = FrameRunner::create(device(), scene, silent_progress());
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  const Image image = frame_of(**made, 0).color;
  double sum = 0;
  for (std::size_t p = 0; p < image.pixels.size(); p += 4)
    sum +=
        0.2126 * double(image.pixels[p]) + 0.7152 * double(image.pixels[p + 1]) + 0.0722 * double(image.pixels[p + 2]);
  return sum / double(image.pixels.size() / 4);
}

struct Way {
  const char* name;
  std::string_view render;
  double most_off;  ///< of the ratio to the truth, beside what the same method has without dual scattering
};
std::ostream& operator<<(std::ostream& out, const Way& way) { return out << way.name; }

class DualScattering : public testing::TestWithParam<Way> {};

TEST_P(DualScattering, OfAWayOfDrawing_ChangesItAsItChangesTheTruth) {
  static const double truth = luminance(k_supersampled, k_with) / luminance(k_supersampled, k_without);
  const double change = luminance(GetParam().render, k_with) / luminance(GetParam().render, k_without);
  std::printf("%s: %.4f times as bright, truth %.4f\n", GetParam().name, change, truth);
  EXPECT_GT(std::abs(truth - 1), 0.1);
  EXPECT_NEAR(change / truth, 1, GetParam().most_off);
}

TEST_P(DualScattering, WithoutLightOfOtherFibres_IsTheFibreAlone) {
  const double alone = luminance(GetParam().render, k_once), none = luminance(GetParam().render, k_with_no_others);
  std::printf("%s: %.6f, by dual scattering %.6f\n", GetParam().name, alone, none);
  EXPECT_NEAR(none / alone, 1, 1e-5);
}

// Lines are at least a pixel wide, so that more of the picture is hair in front, which other fibres send less to.
// Cards have other highlights, dim where the light is behind the eye, so that without it they are ambient alone.
INSTANTIATE_TEST_SUITE_P(Ways, DualScattering,
                         testing::Values(Way{"tiles", k_tiles, 0.02}, Way{"lines", k_lines, 0.15},
                                         Way{"quads", k_quads, 0.02}, Way{"cards", k_cards, 0.4}),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace cuticle::plan::dual_scattering_gpu_test
