#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "shadows/light_frame.glslh"
#include "shadows/light_frame.h"

namespace cuticle::shadows::light_frame_test {

namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();
MapPlacement<float> placement_of(std::vector<glm::vec3> points, glm::dvec3 to_light, std::uint32_t resolution = 68,
                                 float intervals = 15, float least_share = k_any_shape) {
  const LightBox box = light_box(light_axes(to_light), points);
  return map_placement(box.lower, box.upper, resolution, intervals, least_share);
}
glm::vec3 placed(const MapPlacement<float>& placement, glm::dvec3 to_light, glm::vec3 point) {
  return place_in_map(placement, view_point(light_axes(to_light), point));
}

}  // namespace

TEST(LightFrame, AnyDirection_AxesAreRightHandedAndUnit) {
  for (const glm::dvec3 light :
       {glm::dvec3(0, 1, 0), {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0.6, -0.8, 0}, {1e-9, 0, -1}}) {
    const glm::dvec3 direction = glm::normalize(light);
    const PlaneAxes axes = plane_axes(direction);
    EXPECT_NEAR(glm::length(glm::cross(axes.first, axes.second) - direction), 0, 1e-12);
    EXPECT_NEAR(glm::dot(axes.first, axes.second), 0, 1e-12);
    EXPECT_NEAR(glm::length(axes.first), 1, 1e-12);
  }
}

TEST(LightFrame, TwoPointsAlongTheLight_TouchTheFirstAndTheLastPlane) {
  const glm::dvec3 light(0, 1, 0);
  const auto placement = placement_of({{0, 5, 0}, {2, 2, 1}}, light);
  EXPECT_EQ(placed(placement, light, {0, 5, 0}).z, 0.0f);
  const float last = placed(placement, light, {2, 2, 1}).z;
  EXPECT_LT(last, 15.0f);
  EXPECT_GT(last, 14.99f);
}

TEST(LightFrame, LongestSide_FillsTheMapButForItsBorder) {
  const glm::dvec3 light(0, 0, 1);
  const auto placement = placement_of({{0, 0, 0}, {4, 1, 0}}, light, 68, 15, k_square_shape);
  const glm::vec3 a = placed(placement, light, {0, 0, 0}), b = placed(placement, light, {4, 1, 0});
  EXPECT_NEAR(std::abs(b.x - a.x), 64, 1e-3);
  EXPECT_NEAR(0.5f * (a.y + b.y), 34, 1e-3);
  EXPECT_EQ(placement.columns, 68u);
  EXPECT_EQ(placement.rows, 68u);
}

TEST(LightFrame, AMapOfAnyShape_FitsTheBoxWithItsTexels) {
  const glm::dvec3 light(0, 0, 1);
  for (const std::uint32_t resolution : {16u, 33u, 68u, 4096u})
    for (const float height : {0.0f, 0.3f, 1.0f, 4.0f, 9.0f, 1000.0f}) {
      const auto placement = placement_of({{0, 0, 0}, {4, height, 0}}, light, resolution);
      const glm::vec3 a = placed(placement, light, {0, 0, 0}), b = placed(placement, light, {4, height, 0});
      const double texels = double(placement.columns) * placement.rows, most = double(resolution) * resolution;
      EXPECT_LE(texels, most);
      EXPECT_GT(texels, 0.8 * most) << height << " at " << resolution;
      const float edge = 2 - 1e-5f * float(resolution);
      EXPECT_GE(std::min({a.x, b.x, a.y, b.y}), edge) << height << " at " << resolution;
      EXPECT_LE(std::max(a.x, b.x), float(placement.columns) - edge) << height << " at " << resolution;
      EXPECT_LE(std::max(a.y, b.y), float(placement.rows) - edge) << height << " at " << resolution;
      const double inner = double(placement.columns - 4) * double(placement.rows - 4);
      const double filled = std::abs(double(b.x - a.x) * double(b.y - a.y)) / inner;
      const bool in_range = height >= 0.3f && height < 64;  // sides of at most 16 : 1
      EXPECT_GT(filled, in_range ? 0.7 : -1.0) << height << " at " << resolution;
    }
}

TEST(LightFrame, OnePointOrNone_HasAnExtent) {
  for (const std::vector<glm::vec3>& points : {std::vector<glm::vec3>{{1, 1, 1}}, {}}) {
    const auto placement = placement_of(points, {0, 1, 0});
    EXPECT_TRUE(std::isfinite(placement.scale.x) && std::isfinite(placement.scale.z));
    EXPECT_GT(placement.scale.z, 0.0f);
  }
}

// Small steps to any side become steps of one length, so that a disc stays a disc.
TEST(LightFrame, PointLightsView_KeepsSmallDiscsRound) {
  const LightAxes axes = light_axes(LightSource{{}, glm::dvec3(0, 0, 2)}, {glm::vec3(-1), glm::vec3(1)}).value();
  for (const glm::vec3 point : {glm::vec3(0), {0.7f, 0, 0.5f}, {0.3f, -1, 1.9f}, {1, 1, 2.4f}}) {
    const glm::vec3 seen = view_point(axes, point);
    const glm::dvec3 away = glm::normalize(glm::dvec3(point) - glm::dvec3(0, 0, 2));
    const PlaneAxes across = plane_axes(away);
    EXPECT_NEAR(double(seen.z), glm::length(glm::dvec3(point) - glm::dvec3(0, 0, 2)), 1e-6);
    for (const glm::dvec3& side : {across.first, across.second, glm::normalize(across.first + across.second)}) {
      const glm::dvec2 step = glm::dvec2(view_point(axes, point + glm::vec3(0.005 * side))) -
                              glm::dvec2(view_point(axes, point - glm::vec3(0.005 * side)));
      EXPECT_NEAR(glm::length(step) / 0.01, double(view_scale(seen, axes.reach)), 1e-3) << point.x << point.y;
    }
  }
}

TEST(LightFrame, FarPointLightsView_IsThatOfADistantLight) {
  const glm::dvec3 to_light = glm::normalize(glm::dvec3(1, 2, -0.5));
  const strands::Bounds bounds{glm::vec3(-0.1f), glm::vec3(0.1f)};
  const LightAxes point_light = light_axes(LightSource{{}, 100.0 * to_light}, bounds).value(),
                  distant = light_axes(to_light);
  for (const glm::vec3 point : {glm::vec3(0), {0.1f, 0.1f, -0.1f}, {-0.1f, 0.05f, 0.1f}}) {
    const glm::vec3 apart = view_point(point_light, point) - view_point(distant, point);
    EXPECT_LT(glm::length(apart - glm::vec3(0, 0, 100)), 2e-4f);
    EXPECT_NEAR(view_scale(view_point(point_light, point), point_light.reach), 1, 2e-3);
  }
}

TEST(LightFrame, AtThePointLightAndBehindIt_IsFiniteAndUnseen) {
  const strands::Bounds bounds{glm::vec3(-1), glm::vec3(1)};
  const LightAxes axes = light_axes(LightSource{{}, glm::dvec3(0, 0, 0.5)}, bounds).value();
  for (const glm::vec3 point : {glm::vec3(0, 0, 0.5f), {0, 0, 1}, {0, 0.1f, 0.8f}, {0, 1e-7f, 0.5f}}) {
    const glm::vec3 seen = view_point(axes, point);
    EXPECT_TRUE(std::isfinite(seen.x) && std::isfinite(seen.y) && std::isfinite(seen.z));
    EXPECT_TRUE(std::isfinite(view_scale(seen, axes.reach)));
  }
  EXPECT_FALSE(is_seen_by_light(view_point(axes, {0, 0, 1}), axes.reach));
  EXPECT_TRUE(is_seen_by_light(view_point(axes, {0, 1, 0.5f}), axes.reach));
  EXPECT_FALSE(light_axes(LightSource{{}, glm::dvec3(0, 0, 2e6)}, bounds));
  EXPECT_TRUE(light_axes(LightSource{{}, glm::dvec3(0)}, {}));
}

TEST(LightFrame, ZeroOrNotFiniteDirection_IsRefused) {
  EXPECT_FALSE(unit_to_light({0, 0, 0}));
  EXPECT_FALSE(unit_to_light({0, std::numeric_limits<double>::quiet_NaN(), 0}));
  EXPECT_FALSE(unit_to_light({0, double(k_infinity), 0}));
}

TEST(OrderedBits, Floats_KeepTheirOrderAndComeBack) {
  const float values[] = {-k_infinity, -3.5f, -1e-20f, -0.0f, 1e-20f, 0.1f, 2.0f, k_infinity};
  for (std::size_t i = 0; i < std::size(values); ++i) {
    EXPECT_EQ(from_ordered_bits(ordered_bits(values[i])), values[i]);
  }
  for (std::size_t i = 1; i < std::size(values); ++i) EXPECT_LT(ordered_bits(values[i - 1]), ordered_bits(values[i]));
}

}  // namespace cuticle::shadows::light_frame_test
