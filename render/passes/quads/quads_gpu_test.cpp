// Strips that face the camera: coverage beside brute force on the CPU, and whose light a pixel holds.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "lut/bake_gpu.h"
#include "render/pass_gpu.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/passes/quads/quads.h"
#include "tests/support/drawn_strands.h"

namespace cuticle::render::quads_gpu_test {
namespace {

using tests::bundle, tests::Drawing, tests::device, tests::mean_difference, tests::target, tests::upload;

const lut::TableSet& tables() {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  static const lut::TableSet set = *lut::bake(model, registry::default_values(model.entry.parameters),
                                              **lut::find_layout("nalu"), 32, silent_progress());
  return set;
}

struct Settings {
  int samples = 4;
  std::uint32_t vertices_per_strand = 8;
  double tip_width = 1, full_px = 0, far = 1;
  bool lit = false;
};

registry::ParameterValues changed(const Pass& pass, std::initializer_list<std::pair<std::string_view, double>> values) {
  registry::ParameterValues all = registry::default_values(pass.entry.parameters);
  for (const auto& [name, value] : values) all.set(name, value);
  return all;
}

/// Unit tangent, and the share of the strand's vertices.
std::vector<glm::vec4> tangents_of(const Drawing& drawing, std::uint32_t size) {
  std::vector<glm::vec4> tangents;
  for (std::size_t v = 0; v < drawing.vertices.size(); ++v) {
    const std::size_t k = v % size, from = k == 0 ? v : v - 1, to = k + 1 == size ? v : v + 1;
    tangents.emplace_back(glm::normalize(glm::vec3(drawing.vertices[to] - drawing.vertices[from])),
                          float(k) / float(size - 1));
  }
  return tangents;
}

/// The picture as resolved; `far` moves the camera away.
Image draw(const Drawing& drawing, const Settings& settings = {}) {
  const glm::ivec2 size = drawing.camera().resolution;
  using gpu::TextureFormat;
  const auto make = [&](TextureFormat format, int samples) {
    return std::move(*device()->make_texture({size, format, gpu::Filter::nearest, samples, true}));
  };
  const gpu::Texture color = make(TextureFormat::rgba32f, settings.samples),
                     depth = make(TextureFormat::depth32f, settings.samples),
                     resolved = make(TextureFormat::rgba32f, 1);
  const gpu::Buffer vertices = upload(drawing.vertices), segments = upload(drawing.segments),
                    tangents = upload(tangents_of(drawing, settings.vertices_per_strand));
  const std::vector<gpu::Texture> textures = *lut::upload(*device(), tables());
  Resources resources;
  resources.edit<FrameView>().camera = drawing.camera();
  resources.edit<FrameView>().camera.position *= settings.far;
  resources.edit<DrawnHair>().strands = {&vertices,
                                         &segments,
                                         std::uint32_t(drawing.vertices.size()),
                                         std::uint32_t(drawing.segments.size()),
                                         {glm::vec3(-3), glm::vec3(3)}};
  resources.edit<DrawnHair>().tangents = &tangents;
  resources.edit<DrawnHair>().vertices_per_strand = settings.vertices_per_strand;
  resources.edit<Targets>().color = &color;
  resources.edit<Targets>().resolved = settings.samples > 1 ? &resolved : &color;
  resources.edit<Targets>().depth = &depth;
  resources.edit<Targets>().supersampling = 1;
  if (settings.lit) {
    resources.edit<Lights>().all = {
        {.name = "", .to_light = glm::normalize(glm::dvec3(1, 0.5, 0.6)), .irradiance = {1, 2, 3}}};
    resources.edit<bake_tables::Tables>().set = &tables();
    for (const gpu::Texture& texture : textures) resources.edit<bake_tables::Tables>().textures.push_back(&texture);
  }
  resources.parameters["lines"] = changed(lines::entry(), {{"tip_variation", 0}, {"variation", 0}});
  resources.parameters["quads"] =
      changed(quads::entry(), {{"tip_width", settings.tip_width}, {"full_px", settings.full_px}});
  const auto entry = std::ranges::find(gpu_passes(), "quads", &GpuPassEntry::name);
  const auto pass = (*entry)->create(device(), resources);
  EXPECT_TRUE(pass) << (pass ? "" : pass.error().message);
  gpu::Commands commands = device()->record();
  EXPECT_TRUE((*pass)->record(commands, resources));
  const auto cost = device()->submit(std::move(commands));
  EXPECT_TRUE(cost) << (cost ? "" : cost.error().message);
  Image image = make_image(size.x, size.y, {"R", "G", "B", "A"});
  image.pixels = *device()->download(*resources.get<Targets>().resolved);
  return image;
}

/// Strands 1.5 to 3 pixels wide that bend gently through the whole picture, so that no end is seen, some near and some
/// far.
Drawing wide_strands() {
  Drawing drawing;
  for (int k = 0; k < 12; ++k) {
    const float slope = 0.13f * float(k) - 0.7f, z = 0.3f * float(k % 5) - 0.6f;
    std::vector<glm::vec3> points;
    for (int v = 0; v < 8; ++v) {
      const float along = 2 * float(v) - 7;
      points.push_back({along, slope * along + 0.04f * along * along + 0.9f * float(k % 7) - 3, z + 0.1f * along});
    }
    drawing.strand(points, (0.75f + 0.07f * float(k)) * drawing.pixel(), {});
  }
  return drawing;
}

double covered(const Image& image) {
  return mean_difference(image, make_image(image.width, image.height, image.channel_names), 3, 4);
}

// Measured: 0.071 with one sample, 0.026 with four.
TEST(Quads, Coverage_NearsTheTruthWithTheSamples) {
  const Drawing drawing = wide_strands();
  const Image truth = drawing.truth();
  double last = 1;
  for (int samples : device()->info().sample_counts) {
    if (samples > 16) break;
    const double error = mean_difference(draw(drawing, {.samples = samples}), truth, 3, 4);
    std::printf("%d samples: coverage error %.5f of %.5f\n", samples, error, covered(truth));
    EXPECT_LT(error, last);
    last = error;
  }
  EXPECT_LT(last, 0.035);
}

TEST(Quads, Taper_NarrowsStrandsFromRootToTip) {
  Drawing drawing = wide_strands();
  const Image drawn = draw(drawing, {.tip_width = 0.2});
  for (std::size_t v = 0; v < drawing.vertices.size(); ++v) drawing.vertices[v].w *= 1 - 0.8f * float(v % 8) / 7;
  const Image truth = drawing.truth();
  const double error = mean_difference(drawn, truth, 3, 4);
  std::printf("tapered: coverage error %.5f of %.5f\n", error, covered(truth));
  EXPECT_LT(error, 0.04);
}

/// Two strands across the picture's middle at depths `z`, the first along x, the second along y.
Drawing cross(float z_along_x, float z_along_y) {
  Drawing drawing;
  drawing.strand({{-3, 0, z_along_x}, {3, 0, z_along_x}}, 4 * drawing.pixel(), {});
  drawing.strand({{0, -3, z_along_y}, {0, 3, z_along_y}}, 4 * drawing.pixel(), {});
  return drawing;
}

glm::vec4 pixel(const Image& image, int x, int y) {
  return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2), image.at(x, y, 3)};
}

TEST(Quads, CrossingStrands_TheNearerOnesLightIsSeen) {
  const Settings settings{.vertices_per_strand = 2, .lit = true};
  const Image along_x = draw(cross(0, 60), settings),
              along_y = draw(cross(60, 0), settings);  // the other behind the eye
  ASSERT_GT(glm::distance(pixel(along_x, 32, 32), pixel(along_y, 32, 32)), 0.05f * pixel(along_x, 32, 32).x);
  EXPECT_EQ(pixel(draw(cross(0, -0.5f), settings), 32, 32), pixel(along_x, 32, 32));
  EXPECT_EQ(pixel(draw(cross(-0.5f, 0), settings), 32, 32), pixel(along_y, 32, 32));
}

// The pixels along the edge of the strand in front: each sample counts as much for whom it sees.
TEST(Quads, PixelOfTwoStrands_HoldsEachByItsSamples) {
  const Settings settings{.vertices_per_strand = 2, .lit = true};
  const auto tilted = [](bool first, bool second) {
    Drawing drawing;
    const float wide = 8 * drawing.pixel();
    drawing.strand({{-3, -0.5f, first ? 0.0f : 60.0f}, {3, 0.7f, first ? 0.0f : 60.0f}}, wide, {});
    drawing.strand({{0, -3, second ? -0.01f : 60.0f}, {0, 3, second ? -0.01f : 60.0f}}, 2 * wide, {});
    return drawing;
  };
  const Image front = draw(tilted(true, false), settings), back = draw(tilted(false, true), settings),
              both = draw(tilted(true, true), settings);
  int shared = 0;
  for (int y = 0; y < both.height; ++y) {
    const float share = front.at(32, y, 3);
    if (share <= 0 || share >= 1 || back.at(32, y, 3) < 1) continue;
    ++shared;
    const glm::vec4 expected = pixel(front, 32, y) + (1 - share) * pixel(back, 32, y);
    EXPECT_LT(glm::distance(pixel(both, 32, y), expected), 1e-3f * expected.y)
        << y << " " << share << " " << back.at(32, y, 3);
  }
  EXPECT_GT(shared, 0);
}

// Upright strands four times as many as pixels across them: 16 of 64 at twice the distance, as wide as all.
TEST(Quads, LevelOfDetail_CoversTheSameArea) {
  Drawing drawing;
  for (int k = 0; k < 64; ++k) {
    const float x = 0.08f * float(k * 27 % 64 - 32);
    std::vector<glm::vec3> points;
    for (int v = 0; v < 8; ++v) points.push_back({x, 0.5f * float(v) - 1.75f, 0});
    drawing.strand(points, 0.01f, {});
  }
  const double whole = covered(draw(drawing, {.far = 2})),
               level = covered(draw(drawing, {.full_px = 64 * 64, .far = 2}));
  EXPECT_GT(whole, 0.01);
  EXPECT_NEAR(level / whole, 1, 0.1);
}

TEST(Quads, NumbersThatAreNone_AreLeftOut) {
  Drawing drawing = wide_strands();
  const Image clean = draw(drawing);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<glm::vec3> points(8, glm::vec3(nan));
  drawing.strand(points, 0.1f, {});
  EXPECT_EQ(draw(drawing).pixels, clean.pixels);
}

TEST(Quads, CameraInsideTheHair_SeesWhatIsBeforeIt) {
  const Drawing drawing = tests::around_the_camera();
  const Image drawn = draw(drawing);
  const double error = mean_difference(drawn, drawing.truth(), 3, 4);
  std::printf("camera inside: error %.5f\n", error);
  for (float value : drawn.pixels) ASSERT_TRUE(std::isfinite(value));
  EXPECT_LT(error, 0.04);
}

TEST(Quads, StrandsWithoutWidthOrWiderThanTheScreen_DrawNothingOrAll) {
  Drawing drawing;
  drawing.strand({{-30, 0, 0}, {30, 0, 0}}, 0, {});
  EXPECT_EQ(covered(draw(drawing, {.vertices_per_strand = 2})), 0);
  drawing.vertices[0].w = drawing.vertices[1].w = 40;
  EXPECT_EQ(covered(draw(drawing, {.vertices_per_strand = 2})), 1);
}

TEST(Quads, EveryRepeat_HasTheSameBits) {
  const Drawing drawing = bundle(100);
  EXPECT_EQ(draw(drawing, {.lit = true}).pixels, draw(drawing, {.lit = true}).pixels);
}

TEST(Quads, SamplesNotOffered_AreRefused) {
  const auto texture = device()->make_texture({{4, 4}, gpu::TextureFormat::r32u, gpu::Filter::nearest, 3, true, true});
  ASSERT_FALSE(texture.ok());
  EXPECT_NE(texture.error().message.find("3 samples"), std::string::npos);
}

}  // namespace
}  // namespace cuticle::render::quads_gpu_test
