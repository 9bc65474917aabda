// The light that is left where a camera sees three grooms of CUTICLE_TEST_DATA, beside rays: within .01 of it by every
// method, in coarse and fine maps.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "strands/formats/formats.h"
#include "study/shadows/comparison.h"

namespace cuticle::study::light_of_grooms_test {
namespace {

struct SeenGroom {
  const char *name, *path;
  double radius;
  glm::dvec3 to_camera;
};
class LightOfGrooms : public testing::TestWithParam<SeenGroom> {};

/// With a filter of one texel, their default; volumes have a largest size of their own.
constexpr std::pair<const char*, const char*> k_settings[] = {{"opacity_map", "resolution=512,slices=32"},
                                                              {"opacity_map", "resolution=2048,slices=32"},
                                                              {"deep_opacity", "resolution=512"},
                                                              {"deep_opacity", "resolution=2048"},
                                                              {"deep_shadow", "resolution=512"},
                                                              {"deep_shadow", "resolution=2048"},
                                                              {"exact_list", "resolution=512"},
                                                              {"exact_list", "resolution=2048"},
                                                              {"moments", "resolution=512"},
                                                              {"moments", "resolution=2048"},
                                                              {"fourier", "resolution=512"},
                                                              {"fourier", "resolution=2048"},
                                                              {"shadow_map", "resolution=512"},
                                                              {"shadow_map", "resolution=2048"},
                                                              {"voxel", "resolution=512"}};

TEST_P(LightOfGrooms, SeenByACamera_EveryMethodLeavesItWithinAHundredth) {
  const std::string path = std::string(std::getenv("CUTICLE_TEST_DATA")) + "/strands/" + GetParam().path;
  const auto file = strands::read_groom(path, {.metres_per_unit = 0.01, .radius = GetParam().radius});
  ASSERT_TRUE(file) << file.error().message;
  ComparisonRequest request;
  request.groom = &file->groom;
  request.alpha = 1;
  request.to_light = glm::normalize(glm::dvec3(1, 1, 0.3));
  request.to_camera = glm::normalize(GetParam().to_camera);
  request.rays = 64;
  request.receivers = 20000;
  for (const auto& [name, settings] : k_settings) {
    const shadows::Method* method = shadows::find_method(name).value();
    request.candidates.push_back({method, registry::parse_assignments(method->entry.parameters, settings).value()});
  }
  const auto comparison = compare_with_truth(request, silent_progress());
  ASSERT_TRUE(comparison) << comparison.error().message;
  for (const ComparisonRow& row : comparison->rows) {
    const double more = row.light_left - comparison->light_left;
    std::printf("%s %s %s: light %+.4f of %.4f\n", GetParam().name, row.method.c_str(), row.settings.c_str(), more,
                comparison->light_left);
    EXPECT_NEAR(more, 0, 0.01) << row.method << " " << row.settings;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Seen, LightOfGrooms,
    testing::Values(SeenGroom{"sintel", "sintel/GEO-sintel_hair_emit.002-sintel_hair.tfx", 7e-4, {0.3, 0.2, 1}},
                    SeenGroom{"side", "tressfx/ponytail/side.tfx", 3e-4, {1, 0.3, 1}},
                    SeenGroom{"testhair1", "tressfx/testhair1/TestHair1.tfx", 7e-4, {1, 0.3, 1}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace cuticle::study::light_of_grooms_test
