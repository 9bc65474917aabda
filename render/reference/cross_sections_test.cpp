// How flat cross-sections are turned, and that a path tracer of one turn per strand and tables of the mean over turns
// agree.
#include "render/reference/cross_sections.h"

#include <numbers>

#include <fmt/core.h>

#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::cross_sections_test {
namespace {

/// Strands that hang down with a wave, 10 cm long.
strands::Groom curtain(int count) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> even(-1, 1);
  strands::Groom hair;
  for (int s = 0; s < count; ++s) {
    const float x = 0.05f * even(random), z = 0.02f * even(random), lean = 0.3f * even(random),
                wave = 6.0f * even(random);
    for (int k = 0; k <= 16; ++k) {
      const float down = 0.1f * float(k) / 16;
      hair.positions.push_back({x + lean * down + 0.004f * std::sin(60 * down + wave), 0.05f - down,
                                z + 0.004f * std::cos(60 * down + wave)});
    }
    hair.offsets.push_back(std::uint32_t(hair.positions.size()));
  }
  hair.radii.assign(hair.positions.size(), 2e-4f);
  return hair;
}

FibrePoint turned(const CrossSections& sections, const strands::Groom& hair, std::uint32_t vertex, double share,
                  std::uint32_t strand = 0) {
  FibrePoint point;
  point.x = glm::normalize(glm::dvec3(hair.positions[vertex + 1]) - glm::dvec3(hair.positions[vertex]));
  point.y = glm::normalize(glm::cross(point.x, glm::dvec3(0.3, 0.4, 0.5)));
  point.z = glm::cross(point.x, point.y);
  point.share = share;
  point.from = {strand, vertex};
  sections.turn(point, 0);
  return point;
}

TEST(CrossSections, AlongAWavyStrand_AxesAreAtRightAnglesAndContinuous) {
  const strands::Groom hair = curtain(1);
  const CrossSections sections(hair, {}, {});
  glm::dvec3 before(0);
  for (std::uint32_t v = 0; v < 16; ++v)
    for (double share : {0.01, 0.5, 0.99}) {
      const FibrePoint point = turned(sections, hair, v, share);
      EXPECT_NEAR(glm::dot(point.x, point.y), 0, 1e-12);
      EXPECT_NEAR(glm::length(point.y), 1, 1e-12);
      EXPECT_NEAR(glm::distance(point.z, glm::cross(point.x, point.y)), 0, 1e-12);
      EXPECT_TRUE(glm::length(before) == 0 || glm::dot(before, point.y) > 0.9) << v << " " << share;
      before = point.y;
    }
}

TEST(CrossSections, Twist_TurnsByItsLengthOfStrand) {
  strands::Groom hair;
  hair.positions = {{0, 0, 0}, {0, 0, 0.01f}, {0, 0, 0.05f}};
  hair.radii.assign(3, 1e-4f);
  hair.offsets = {0, 3};
  const glm::dvec3 still = turned(CrossSections(hair, {}, {}), hair, 1, 0.5).y;
  const glm::dvec3 y = turned(CrossSections(hair, {}, {.twist = 5}), hair, 1, 0.5).y;
  const double angle = 2 * std::numbers::pi * 5 * 0.03;
  EXPECT_NEAR(glm::dot(still, y), std::cos(angle), 1e-6);
  EXPECT_NEAR(glm::cross(still, y).z, std::sin(angle), 1e-6);
}

TEST(CrossSections, OfManyStrands_AreTurnedEvenly) {
  strands::Groom hair;
  hair.offsets = {0};
  for (int s = 0; s < 4000; ++s) {
    for (const float z : {0.0f, 0.1f}) hair.positions.push_back({0, 0, z});
    hair.offsets.push_back(std::uint32_t(hair.positions.size()));
  }
  const CrossSections sections(hair, {}, {});
  glm::dvec3 mean(0);
  double twice = 0;
  for (std::uint32_t s = 0; s < 4000; ++s) {
    const glm::dvec3 y = turned(sections, hair, 2 * s, 0.5, s).y;
    mean += y / 4000.0;
    twice += (y.x * y.x - y.y * y.y) / 4000;
  }
  EXPECT_LT(glm::length(mean), 0.04);
  EXPECT_NEAR(twice, 0, 0.04);
}

TracedScene lit_curtain(double aspect, int count) {
  TracedScene scene = scene_of("marschner", fmt::format("sigma_a=0.1257/0.2091/0.411,aspect={}", aspect));
  scene.hair = curtain(count);
  scene.camera.vertical_field_of_view = 0.08;
  scene.lights = {{.name = "key", .to_light = glm::normalize(glm::dvec3(0.1, 0.2, 1)), .irradiance = {1, 1, 1}},
                  {.name = "rim", .to_light = glm::normalize(glm::dvec3(-0.8, 0.3, 0.6)), .irradiance = {1, 1, 1}}};
  return scene;
}

glm::dvec3 direct_light(const TracedScene& scene, const TraceOptions& options) {
  const Picture picture = picture_of(scene, options, {.samples = 16});
  glm::dvec3 sum(0);
  for (std::size_t p = 0; p < picture.color.pixels.size(); ++p)
    if (p % 4 < 3) sum[int(p % 4)] += double(picture.color.pixels[p]);
  return sum;
}

struct Flatness {
  double aspect, bound;
};
/// Direct light by the model's formulas, each strand with its own turn, over that by tables, which hold the mean over
/// turns.
class TurnsAndTables : public testing::TestWithParam<Flatness> {};
// The turns of 3,000 strands leave a deviation of 2 % with .85 and 1 % with .95; the mean of 8 seeds is .990 and 1.005.
INSTANTIATE_TEST_SUITE_P(Aspects, TurnsAndTables,
                         testing::Values(Flatness{0.85, 0.03}, Flatness{0.95, 0.02}, Flatness{1, 0.004}));
TEST_P(TurnsAndTables, DirectLightOfManyStrands_IsTheSame) {
  const TracedScene scene = lit_curtain(GetParam().aspect, 3000);
  const TraceOptions tables{.scatterings = 1, .tables = TablesInstead{"nalu_theta", 64}};
  glm::dvec3 sum(0);
  for (const std::uint64_t seed : {0, 1, 2, 3})
    sum += direct_light(scene, {.scatterings = 1, .turning = {.twist = 30, .seed = seed}}) / 4.0;
  const glm::dvec3 ratio = sum / direct_light(scene, tables);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1, GetParam().bound) << c;
}

TEST(CrossSections, RoundFibre_HasNoTurn) {
  const TracedScene round = lit_curtain(1, 100), flat = lit_curtain(0.85, 100);
  const auto pixels = [](const TracedScene& scene, std::uint64_t seed) {
    return picture_of(scene, {.scatterings = 1, .turning = {.twist = 30, .seed = seed}}, {.samples = 2}).color.pixels;
  };
  EXPECT_EQ(pixels(round, 0), pixels(round, 1));
  EXPECT_NE(pixels(flat, 0), pixels(flat, 1));
}

}  // namespace
}  // namespace cuticle::render::reference::cross_sections_test
