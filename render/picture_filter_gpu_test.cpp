// Passes over the finished picture: what a lens and what hollows do to pictures whose depth is given.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "render/passes/pixel_depth/pixel_depth_gpu.h"
#include "render/picture_filter_gpu.h"
#include "tests/support/drawn_strands.h"

namespace cuticle::render::picture_filter_gpu_test {
namespace {

using tests::device, tests::upload;

constexpr int k_size = 96, k_middle = k_size / 2;

/// A picture with the distance of each pixel along the view, metres; 0: nothing there.
struct Scene {
  std::vector<float> colors = std::vector<float>(4 * k_size * k_size), distances = std::vector<float>(k_size * k_size);
  Camera camera{
      .position = {0, 0, 1}, .target = {0, 0, 0}, .vertical_field_of_view = 0.4, .resolution = {k_size, k_size}};

  template <class Color, class Distance>
  Scene(const Color& color, const Distance& distance) {
    for (int p = 0; p < k_size * k_size; ++p) {
      const int x = p % k_size - k_middle, y = p / k_size - k_middle;
      const float grey = color(x, y);
      for (int c = 0; c < 4; ++c) colors[std::size_t(4 * p + c)] = c == 3 ? 1 : grey;
      distances[std::size_t(p)] = distance(x, y);
    }
  }
  /// Metres that a pixel is wide at this distance.
  double pixel_at(double distance) const { return distance / pixels_per_slope(camera); }
};

/// The red of each pixel after a pass with these settings.
std::vector<float> filtered(std::string_view pass_name, const char* settings, const Scene& scene) {
  std::vector<float> inverse;
  for (const float distance : scene.distances) inverse.push_back(distance > 0 ? 1 / distance : 0);
  const gpu::Buffer depth = upload(inverse);
  const gpu::Texture output = tests::target({k_size, k_size}, gpu::TextureFormat::rgba32f);
  EXPECT_TRUE(device()->upload(output, scene.colors));
  Resources resources;
  resources.edit<FrameView>().camera = scene.camera;
  resources.put(pixel_depth::PixelDepth{&depth});
  resources.edit<Output>().picture = &output;
  for (const Pass* pass : passes())
    if (pass->entry.name == pass_name)
      resources.parameters.emplace(pass_name, *registry::parse_assignments(pass->entry.parameters, settings));
  for (const GpuPassEntry* entry : gpu_passes()) {
    if (entry->name != pass_name) continue;
    const auto pass = *entry->create(device(), resources);
    gpu::Commands commands = device()->record();
    EXPECT_TRUE(pass->record(commands, resources));
    const auto cost = device()->submit(std::move(commands));
    EXPECT_TRUE(cost) << cost.error().message;
  }
  const std::vector<float> all = *device()->download(output);
  std::vector<float> red;
  for (std::size_t p = 0; p < all.size(); p += 4) red.push_back(all[p]);
  return red;
}

float at(const std::vector<float>& picture, int x, int y) {
  return picture[std::size_t((y + k_middle) * k_size + x + k_middle)];
}

float stripes(int x, int) { return x % 3 == 0 ? 1.0f : 0.2f; }

TEST(DepthOfField, InThePlaneOfFocus_ThePictureStays) {
  const Scene scene(stripes, [](int, int) { return 1.0f; });
  const std::vector<float> sharp = filtered("depth_of_field", "lens_radius=50", scene);
  for (int p = 0; p < k_size * k_size; ++p) EXPECT_EQ(sharp[std::size_t(p)], scene.colors[std::size_t(4 * p)]);
}

// A point before the plane of focus becomes a disc of the thin lens's radius that holds the point's light.
TEST(DepthOfField, PointInFront_BecomesTheLensesDisc) {
  const auto is_point = [](int x, int y) { return x == 0 && y == 0; };
  const Scene scene([&](int x, int y) { return is_point(x, y) ? 1.0f : 0.0f; },
                    [&](int x, int y) { return is_point(x, y) ? 0.8f : 1.0f; });
  const double lens = 0.15, radius = lens * (1 / 0.8 - 1) * pixels_per_slope(scene.camera);
  ASSERT_GT(radius, 8);
  const std::vector<float> disc = filtered("depth_of_field", "lens_radius=150,samples=1024", scene);
  double light = 0, spread = 0;
  for (int y = -k_middle; y < k_middle; ++y)
    for (int x = -k_middle; x < k_middle; ++x) {
      light += double(at(disc, x, y));
      spread += double(at(disc, x, y)) * (x * x + y * y);
      if (std::hypot(x, y) > radius + 1) {
        EXPECT_EQ(at(disc, x, y), 0) << x << ", " << y;
      }
    }
  EXPECT_NEAR(light, 1, 0.1);
  EXPECT_NEAR(std::sqrt(2 * spread / light), radius, 0.05 * radius);
}

TEST(DepthOfField, SharpThingBeforeABrightBlur_KeepsItsEdge) {
  const Scene scene([](int x, int) { return x < 0 ? 0.1f : 5.0f; }, [](int x, int) { return x < 0 ? 1.0f : 3.0f; });
  const std::vector<float> picture = filtered("depth_of_field", "lens_radius=60", scene);
  for (int x = -20; x < 0; ++x) EXPECT_FLOAT_EQ(at(picture, x, 0), 0.1f);
  EXPECT_NEAR(at(picture, 1, 0), 5, 1e-4);
}

// Beside its edge a half plane covers the segment of the disc that lies beyond.
TEST(DepthOfField, BlurBeforeASharpThing_LiesOverIt) {
  const Scene scene([](int x, int) { return x < 0 ? 1.0f : 0.0f; }, [](int x, int) { return x < 0 ? 0.8f : 1.0f; });
  const std::vector<float> picture = filtered("depth_of_field", "lens_radius=150,samples=512", scene);
  const double radius = 0.15 * (1 / 0.8 - 1) * pixels_per_slope(scene.camera);
  for (const int x : {0, 2, 4, 6}) {
    const double away = (x + 0.5) / radius;
    const double segment = (std::acos(away) - away * std::sqrt(1 - away * away)) / std::numbers::pi;
    EXPECT_NEAR(at(picture, x, 0), segment, 0.03) << x;
  }
  EXPECT_EQ(at(picture, 40, 0), 0);
}

TEST(AmbientOcclusion, PlaneHoweverTurned_StaysLight) {
  const auto white = [](int, int) { return 1.0f; };
  const Scene facing(white, [](int, int) { return 1.0f; });
  const Scene turned(white, [&](int x, int) { return 1 + float(facing.pixel_at(1)) * float(x); });
  for (const Scene* scene : {&facing, &turned}) {
    const std::vector<float> picture = filtered("ambient_occlusion", "radius=20,strength=1", *scene);
    for (int x = -20; x < 20; ++x) EXPECT_NEAR(at(picture, x, 3), 1, 0.01);
  }
}

// In the edge of two walls that meet at a right angle a quarter of the sphere is open, half of what a plane leaves.
TEST(AmbientOcclusion, EdgeOfTwoWalls_IsHalfOpen) {
  const auto white = [](int, int) { return 1.0f; };
  const double pixel = Scene(white, [](int, int) { return 1.0f; }).pixel_at(1);
  const Scene valley(white, [&](int x, int) { return float(1 - pixel * std::abs(x)); });
  const std::vector<float> picture = filtered("ambient_occlusion", "radius=30,strength=1,samples=256", valley);
  EXPECT_NEAR(at(picture, 0, 0), 0.5, 0.02);
  EXPECT_NEAR(at(picture, 30, 0), 1, 0.02);
  const std::vector<float> half = filtered("ambient_occlusion", "radius=30,strength=0.5,samples=256", valley);
  EXPECT_NEAR(at(half, 0, 0), 0.75, 0.02);
}

TEST(AmbientOcclusion, ThingFarBefore_AndTheBackground_DarkenNothing) {
  const auto white = [](int, int) { return 1.0f; };
  const Scene scene(white, [](int x, int) { return x < -5 ? 0.3f : x > 5 ? 0.0f : 1.0f; });
  const std::vector<float> picture = filtered("ambient_occlusion", "radius=20,strength=1", scene);
  for (const float value : picture) EXPECT_NEAR(value, 1, 1e-5);
}

}  // namespace
}  // namespace cuticle::render::picture_filter_gpu_test
