// Brute force against closed forms: areas of bands in a pixel, the projected area of strands, compositing by hand.
#include "render/passes/supersampled/rasterise.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cuticle::render::supersampled::rasterise_test {
namespace {

constexpr int k_size = 8;

/// Sees the square -4 .. 4 at z = 0: pixels of one metre, the middle of pixel (x, y) at (x - 3.5, 3.5 - y).
Camera camera() {
  return {.position = {0, 0, 4},
          .target = {0, 0, 0},
          .vertical_field_of_view = std::numbers::pi / 2,
          .near_plane = 0.5,
          .far_plane = 50,
          .resolution = {k_size, k_size}};
}

struct Scene {
  std::vector<glm::vec4> vertices, colors;
  std::vector<std::uint32_t> segments;
  OpaqueScene opaque;
  Sampling sampling;

  Scene& strand(const std::vector<glm::vec3>& points, float radius, const glm::vec3& color) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k > 0) segments.push_back(std::uint32_t(vertices.size() - 1));
      vertices.emplace_back(points[k], radius);
      colors.emplace_back(color, 1);
    }
    return *this;
  }
  Scene& sampled(Sampling how) {
    sampling = how;
    return *this;
  }
  Image image() const { return rasterise(camera(), {vertices, colors, segments}, opaque, sampling); }
};

const glm::vec3 k_red(1, 0, 0), k_green(0, 1, 0);

TEST(Truth, StrandAlongARow_CoversTheShareOfThePixel) {
  const Image image = Scene().strand({{-5, 0.5, 0}, {5, 0.5, 0}}, 0.25f, k_red).image();
  for (int x = 0; x < k_size; ++x) EXPECT_EQ(image.at(x, 3, 3), 0.5f) << x;
  EXPECT_EQ(image.at(4, 2, 3), 0);
}

// The band |x - y| <= w sqrt(2) in a unit square: 1 - (1 - w sqrt(2))^2.
TEST(Truth, ObliqueStrand_CoversTheBandsArea) {
  for (float w : {0.05f, 0.2f, 0.5f}) {
    Scene scene = Scene().strand({{-6, -6, 0}, {6, 6, 0}}, w, k_red).sampled({.samples = 64});
    const double open = 1 - double(w) * std::sqrt(2.0);
    EXPECT_NEAR(scene.image().at(3, 4, 3), 1 - open * open, 0.02) << w;
  }
}

TEST(Truth, SumOverPixels_IsTheProjectedArea) {
  for (float w : {0.01f, 0.1f, 0.6f}) {
    const Image image = Scene().strand({{-2, -1, 0}, {2.2f, 1.3f, 0}}, w, k_red).sampled({.samples = 64}).image();
    double sum = 0;
    for (int y = 0; y < k_size; ++y)
      for (int x = 0; x < k_size; ++x) sum += double(image.at(x, y, 3));
    const double length = std::hypot(4.2, 2.3), radius = double(w);
    EXPECT_NEAR(sum / (2 * radius * length + std::numbers::pi * radius * radius), 1, 0.01) << w;
  }
}

TEST(Truth, CrossingStrands_TheNearerOneHidesTheOther) {
  for (float z : {-0.5f, 0.5f}) {
    const Image image = Scene()
                            .strand({{-3, 0.5f, 0}, {3, 0.5f, 0}}, 0.6f, k_red)
                            .strand({{0.5f, -3, z}, {0.5f, 3, z}}, 0.6f, k_green)
                            .image();
    EXPECT_EQ(image.at(4, 3, 0), z < 0 ? 1.0f : 0.0f);
    EXPECT_EQ(image.at(4, 3, 1), z < 0 ? 0.0f : 1.0f);
    EXPECT_EQ(image.at(4, 3, 3), 1.0f);
  }
}

TEST(Truth, TranslucentStrands_CompositeFromNearToFar) {
  const Image image = Scene()
                          .strand({{-3, 0.5f, 0}, {3, 0.5f, 0}}, 0.6f, k_red)
                          .strand({{0.5f, -3, 0.5f}, {0.5f, 3, 0.5f}}, 0.6f, k_green)
                          .sampled({.opacity = 0.4})
                          .image();
  EXPECT_NEAR(image.at(4, 3, 1), 0.4, 1e-6);
  EXPECT_NEAR(image.at(4, 3, 0), 0.6 * 0.4, 1e-6);
  EXPECT_NEAR(image.at(4, 3, 3), 1 - 0.6 * 0.6, 1e-6);
}

TEST(Truth, JointOfAStrand_CountsOnce) {
  const Image image =
      Scene().strand({{-3, 0.5f, 0}, {0.5f, 0.5f, 0}, {3, 0.5f, 0}}, 0.6f, k_red).sampled({.opacity = 0.4}).image();
  EXPECT_NEAR(image.at(4, 3, 3), 0.4, 1e-6);
}

TEST(Truth, Color_IsInterpolatedAsSeenInPerspective) {
  Scene scene = Scene().strand({{-2.5f, 0.5f, 0}, {5, 0.5f, -4}}, 2, k_red);
  scene.colors[1] = glm::vec4(k_green, 1);
  // The ray through the middle of pixel (4, 3) is (0.5, 0.5, -4): it passes x = z/8 + 0.5 behind the plane z = 0, where
  // the strand is at the share s with -2.5 + 7.5 s = 0.5 + 0.5 s.
  EXPECT_NEAR(scene.image().at(4, 3, 1), 3.0 / 7.0, 2e-3);
}

TEST(Truth, SceneInFront_Hides) {
  const std::vector<float> color(k_size * k_size * 4, 0.25f), near(k_size * k_size, 0.0f), far(k_size * k_size, 1.0f);
  Scene scene = Scene().strand({{-5, 0.5, 0}, {5, 0.5, 0}}, 0.6f, k_red);
  scene.opaque = {color, near, 1};
  EXPECT_EQ(scene.image().at(4, 3, 0), 0.25f);
  scene.opaque.depth = far;
  EXPECT_EQ(scene.image().at(4, 3, 0), 1.0f);
}

TEST(Truth, WhatCannotBeSeen_IsLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Scene scene = Scene()
                    .strand({{-3, 0.5f, 6}, {3, 0.5f, 6}}, 0.6f, k_red)        // behind the eye
                    .strand({{-3, 0.5f, 3.6f}, {3, 0.5f, 3.6f}}, 0.6f, k_red)  // before the near plane
                    .strand({{-3, 0.5f, 0}, {3, nan, 0}}, 0.6f, k_red)
                    .strand({{-3, 0.5f, 0}, {3, 0.5f, 0}}, 0, k_red);
  for (float value : scene.image().pixels) EXPECT_EQ(value, 0);
  scene.strand({{0.5f, 0.5f, 0}, {0.5f, 0.5f, 9}}, 0.8f, k_red);  // through the eye's plane
  EXPECT_EQ(scene.image().at(4, 3, 3), 1.0f);
}

}  // namespace
}  // namespace cuticle::render::supersampled::rasterise_test
