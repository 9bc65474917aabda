// Textures: what is uploaded, what is sampled.
#include <algorithm>
#include <cmath>

#include "gpu/tests/shared_device.h"

#include <sample_comp.spv.h>

namespace cuticle::gpu::gpu_texture_test {
namespace {

constexpr int k_width = 7, k_height = 5;

// Multiples of 1/255 that are no multiples of anything else.
std::vector<float> pattern(int components) {
  std::vector<float> values(std::size_t(k_width * k_height * components));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float((i * 37 + 11) % 256) / 255;
  return values;
}

Texture patterned(TextureFormat format, Filter filter, int components) {
  Texture texture =
      must(shared_device().make_texture({.size = {k_width, k_height}, .format = format, .filter = filter}));
  EXPECT_TRUE(shared_device().upload(texture, pattern(components)).ok());
  return texture;
}

std::vector<glm::vec4> sampled(const Texture& texture, const std::vector<glm::vec2>& places,
                               float level = 0) {
  Device& device = shared_device();
  const Kernel kernel = must(device.make_kernel(sample_comp, {.storage_buffers = 2, .textures = 1, .push_constant_bytes = 4}));
  const Buffer from = must(make_buffer_from<glm::vec2>(device, places));
  const Buffer to = must(device.make_buffer(places.size() * sizeof(glm::vec4)));
  Commands commands = device.record();
  commands.dispatch(kernel, {&from, &to}, {&texture}, std::as_bytes(std::span(&level, 1)), std::uint32_t(places.size() + 63) / 64);
  must(device.submit(std::move(commands)));
  return must(read_buffer<glm::vec4>(device, to, places.size()));
}

std::vector<glm::vec2> places() {
  std::vector<glm::vec2> all;
  for (int y = -2; y <= 22; ++y)
    for (int x = -2; x <= 22; ++x) all.push_back({float(x) / 20 + 0.013f, float(y) / 20 + 0.007f});
  return all;
}

double texel(const std::vector<float>& values, int x, int y, int component) {
  x = std::clamp(x, 0, k_width - 1), y = std::clamp(y, 0, k_height - 1);
  return double(values[std::size_t((y * k_width + x) * 4 + component)]);
}

double bilinear(const std::vector<float>& values, glm::vec2 place, int component) {
  const double x = double(place.x) * k_width - 0.5, y = double(place.y) * k_height - 0.5;
  const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
  const double s = x - x0, t = y - y0;
  return (1 - t) * ((1 - s) * texel(values, x0, y0, component) + s * texel(values, x0 + 1, y0, component)) +
         t * ((1 - s) * texel(values, x0, y0 + 1, component) + s * texel(values, x0 + 1, y0 + 1, component));
}

double largest_error(const Texture& texture) {
  const std::vector<float> values = pattern(4);
  const std::vector<glm::vec4> samples = sampled(texture, places());
  double error = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (int c = 0; c < 4; ++c)
      error = std::max(error, std::abs(double(samples[i][c]) - bilinear(values, places()[i], c)));
  return error;
}

// Vulkan promises only 8 bits of the weights (here 4 blends of values up to 1).
TEST(GpuTexture, TexelsCopiedFromABuffer_AreThere) {
  Device& device = shared_device();
  std::vector<float> data(3 + std::size_t(k_width * k_height) * 4 + 1, 0.0f);
  const std::vector<float> texels = pattern(4);
  std::copy(texels.begin(), texels.end(), data.begin() + 4);
  const Buffer buffer = must(make_buffer_from<float>(device, data));
  const Texture texture = must(device.make_texture({.size = {k_width, k_height}, .format = TextureFormat::rgba32f}));
  Commands commands = device.record();
  commands.copy(buffer, texture, 16);
  must(device.submit(std::move(commands)));
  EXPECT_EQ(must(device.download(texture)), texels);
}

TEST(GpuTexture, TexelsThatABufferDoesNotHold_AreRefusedAtSubmit) {
  Device& device = shared_device();
  const Buffer buffer = must(device.make_buffer(std::size_t(k_width * k_height) * 16));
  const Texture texture = must(device.make_texture({.size = {k_width, k_height}, .format = TextureFormat::rgba32f}));
  for (std::size_t offset : {16, 4}) {
    Commands commands = device.record();
    commands.copy(buffer, texture, offset);
    EXPECT_FALSE(device.submit(std::move(commands)).ok()) << offset;
  }
}

/// 4 x 4 texels whose red is their number in rows.
Texture counted(bool mip_levels) {
  Texture texture =
      must(shared_device().make_texture({.size = {4, 4}, .format = TextureFormat::rgba32f, .mip_levels = mip_levels}));
  std::vector<float> values(64);
  for (int i = 0; i < 16; ++i) values[std::size_t(4 * i)] = float(i);
  EXPECT_TRUE(shared_device().upload(texture, values).ok());
  return texture;
}

TEST(GpuTexture, MipLevels_AreMeansOfTheTexelsAbove) {
  const Texture texture = counted(true);
  const std::vector<glm::vec2> corners = {{0.25f, 0.25f}, {0.75f, 0.25f}, {0.25f, 0.75f}, {0.75f, 0.75f}};
  const std::vector<glm::vec4> halved = sampled(texture, corners, 1);
  const double expected[] = {2.5, 4.5, 10.5, 12.5};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(halved[std::size_t(i)].x, expected[i], 0.05) << i;
  EXPECT_NEAR(sampled(texture, {{0.3f, 0.9f}}, 2)[0].x, 7.5, 0.05);
  EXPECT_NEAR(sampled(texture, {{0.125f, 0.125f}}, 0)[0].x, 0, 0.05);
}

TEST(GpuTexture, NoMipLevels_EveryLevelIsTheTextureItself) {
  EXPECT_NEAR(sampled(counted(false), {{0.125f, 0.125f}}, 2)[0].x, 0, 0.05);
}

TEST(GpuTexture, LinearSamples_AreBilinearClampedToTheEdge) {
  EXPECT_LT(largest_error(patterned(TextureFormat::rgba32f, Filter::linear, 4)), 0.01);
}
TEST(GpuTexture, LinearSamplesOfHalf_AreBilinearClampedToTheEdge) {
  EXPECT_LT(largest_error(patterned(TextureFormat::rgba16f, Filter::linear, 4)), 0.01);
}

TEST(GpuTexture, NearestSamples_AreTheTexels) {
  const Texture texture = patterned(TextureFormat::rgba32f, Filter::nearest, 4);
  const std::vector<float> values = pattern(4);
  std::vector<glm::vec2> centres;
  for (int y = 0; y < k_height; ++y)
    for (int x = 0; x < k_width; ++x) centres.push_back({(float(x) + 0.3f) / k_width, (float(y) + 0.6f) / k_height});
  const auto samples = sampled(texture, centres);
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (int c = 0; c < 4; ++c) EXPECT_EQ(samples[i][c], values[i * 4 + std::size_t(c)]);
}

TEST(GpuTexture, EveryFormat_ComesBackToItsPrecision) {
  struct Case {
    TextureFormat format;
    int components;
    float tolerance;
  };
  for (const Case& each : {Case{TextureFormat::rgba8, 4, 1e-7f},
                           {TextureFormat::rgba16f, 4, 2.5e-4f},
                           {TextureFormat::rgba32f, 4, 0},
                           {TextureFormat::r32f, 1, 0},
                           {TextureFormat::depth32f, 1, 0}}) {
    const Texture texture = patterned(each.format, Filter::nearest, each.components);
    const auto back = must(shared_device().download(texture));
    const auto values = pattern(each.components);
    ASSERT_EQ(back.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(back[i], values[i], each.tolerance) << int(each.format);
  }
}

TEST(GpuTexture, TooLarge_IsRefusedNamingTheLimit) {
  const int limit = int(shared_device().info().max_image_size);
  const auto texture = shared_device().make_texture({.size = {limit + 1, 1}});
  ASSERT_FALSE(texture.ok());
  EXPECT_NE(texture.error().message.find(std::to_string(limit)), std::string::npos);
}

TEST(GpuTexture, NoPixels_AreRefused) { EXPECT_FALSE(shared_device().make_texture({.size = {0, 4}}).ok()); }
TEST(GpuTexture, SampleCountNotOffered_IsRefused) {
  EXPECT_FALSE(shared_device().make_texture({.size = {4, 4}, .samples = 3, .render_target = true}).ok());
}
TEST(GpuTexture, WrongNumberOfFloats_IsRefused) {
  const Texture texture = must(shared_device().make_texture({.size = {4, 4}}));
  EXPECT_FALSE(shared_device().upload(texture, std::vector<float>(63)).ok());
}

}  // namespace
}  // namespace cuticle::gpu::gpu_texture_test
