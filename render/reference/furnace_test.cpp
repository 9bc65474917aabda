// Hair that absorbs nothing, in even surroundings.
#include <numeric>

#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::furnace_test {
namespace {

struct Furnace {
  std::string_view model, settings;
  int fibres;
  int pixels = 24, samples = 16;  ///< fewer of models whose points are quadratures
};
void PrintTo(const Furnace& of, std::ostream* out) { *out << of.model << " " << of.fibres; }
class Furnaces : public testing::TestWithParam<Furnace> {};

// Hair that absorbs nothing cannot be told from the surroundings.
TEST_P(Furnaces, DenseBall_IsInvisibleWithinThreeStandardErrors) {
  TracedScene scene = scene_of(GetParam().model, GetParam().settings);
  scene.hair = ball(GetParam().fibres, 4e-4f);
  scene.surroundings = white();
  scene.camera.vertical_field_of_view = 0.08;
  scene.camera.resolution = glm::ivec2(GetParam().pixels);
  const Mean mean = mean_where_covered(picture_of(scene, {}, {.samples = GetParam().samples}));
  EXPECT_GT(mean.error.y, 0);
  EXPECT_NEAR(mean.color.y, 1, 3 * mean.error.y) << "standard error " << mean.error.y;
  std::printf("%s, %d fibres: %.4f +- %.4f, coverage %.2f\n", GetParam().model.data(), GetParam().fibres, mean.color.y,
              mean.error.y, mean.coverage / (GetParam().pixels * GetParam().pixels));
}

INSTANTIATE_TEST_SUITE_P(Densities, Furnaces,
                         testing::Values(Furnace{"chiang", k_clear, 100}, Furnace{"chiang", k_clear, 1000},
                                         Furnace{"chiang", k_clear, 6000},
                                         Furnace{"chiang", "sigma_a=0,beta_m=0.15,beta_n=0.2,alpha=-0.05", 1000}));

// Of the others that `cuticle check model` finds to keep energy.
constexpr const char *k_far = "sigma_a=0,beta_m=0.3,beta_n=0.3,alpha=0,field=far",
                     *k_rough = "sigma_a=0,roughness=0.3,samples=64";
INSTANTIATE_TEST_SUITE_P(Models, Furnaces,
                         testing::Values(Furnace{"chiang", k_far, 100}, Furnace{"chiang", k_far, 1000},
                                         Furnace{"chiang", k_far, 3000, 16, 16}, Furnace{"deon", k_clear, 100, 16, 16},
                                         Furnace{"deon", k_clear, 300, 16, 16}, Furnace{"deon", k_clear, 1000, 12, 16},
                                         Furnace{"huang", k_rough, 100, 16, 16}, Furnace{"huang", k_rough, 200, 16, 16},
                                         Furnace{"huang", k_rough, 300, 16, 8},
                                         Furnace{"yan_fur", "sigma_a=0,sigma_ma=0", 100},
                                         Furnace{"yan_fur", "sigma_a=0,sigma_ma=0", 300},
                                         Furnace{"yan_fur", "sigma_a=0,sigma_ma=0", 1000}));

/// Without the last of each strand's five vertices, as many as a Bezier curve has.
strands::Groom ball_of_fours(int count, float radius) {
  const strands::Groom whole = ball(count, radius);
  strands::Groom hair;
  for (std::size_t s = 0; s < whole.strand_count(); ++s) {
    const auto points = whole.strand(s).first(4);
    hair.positions.insert(hair.positions.end(), points.begin(), points.end());
    hair.offsets.push_back(std::uint32_t(hair.positions.size()));
  }
  hair.radii.assign(hair.positions.size(), radius);
  return hair;
}

TEST(Furnaces, BallOfEveryKindOfCurve_IsInvisibleWithinThreeStandardErrors) {
  for (const std::string_view name : strands::curve_kind_names()) {
    TracedScene scene = scene_of("chiang", k_clear);
    scene.hair = ball_of_fours(300, 4e-4f);
    scene.surroundings = white();
    scene.camera.vertical_field_of_view = 0.08;
    const Mean mean = mean_where_covered(picture_of(scene, {.curves = strands::curve_kind(name)}, {.samples = 8}));
    EXPECT_GT(mean.coverage, 50) << name;
    EXPECT_NEAR(mean.color.y, 1, 3 * mean.error.y) << name << ", standard error " << mean.error.y;
  }
}

double sum_of(const Image& layers, const std::string& name) {
  const auto found = std::ranges::find(layers.channel_names, name + ".G");
  EXPECT_NE(found, layers.channel_names.end()) << name;
  const auto channel = int(found - layers.channel_names.begin());
  double sum = 0;
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x) sum += double(layers.at(x, y, channel));
  return sum;
}

// What every number of scatterings brings is positive, and all of it is what came in.
TEST(Furnaces, EnergyByScatterings_SumsToOne) {
  TracedScene scene = scene_of("chiang", k_clear);
  scene.hair = ball(1000, 4e-4f);
  scene.surroundings = white();
  scene.camera.vertical_field_of_view = 0.08;
  const Picture picture = picture_of(scene, {.layers = true}, {.samples = 16});
  const Mean mean = mean_where_covered(picture);
  double sum = 0;
  for (const char* name : {"scatterings_1", "scatterings_2", "scatterings_3", "scatterings_4_7", "scatterings_8_15",
                           "scatterings_16_on"}) {
    const double part = sum_of(picture.layers, name) / mean.coverage;
    EXPECT_GT(part, 0.01) << name;
    sum += part;
  }
  EXPECT_NEAR(sum, 1, 3 * mean.error.y);
}

}  // namespace
}  // namespace cuticle::render::reference::furnace_test
