// Triangles and lines, depth, blending, multisampling.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "gpu/tests/shared_device.h"

#include <flat_color_frag.spv.h>
#include <pulled_vert.spv.h>

namespace cuticle::gpu::gpu_draw_test {
namespace {

constexpr int k_size = 16;
const glm::vec4 k_red{1, 0, 0, 1}, k_green{0, 1, 0, 1};

struct Vertex {
  glm::vec4 position, color;
};

// A triangle that covers the whole picture at one depth.
std::vector<Vertex> cover(float depth, glm::vec4 color) {
  return {{{-1, -1, depth, 1}, color}, {{3, -1, depth, 1}, color}, {{-1, 3, depth, 1}, color}};
}

struct Draw {
  std::vector<Vertex> vertices;
  GraphicsDescription description;
};

GraphicsDescription plain(int samples = 1) {
  GraphicsDescription description;
  description.vertex_spirv = pulled_vert;
  description.fragment_spirv = flat_color_frag;
  description.interface.storage_buffers = 1;
  description.color_formats = {TextureFormat::rgba32f};
  description.samples = samples;
  return description;
}

GraphicsDescription with_depth() {
  GraphicsDescription description = plain();
  description.depth_test = description.depth_write = true;
  return description;
}

Texture target(TextureFormat format, int samples = 1) {
  return must(shared_device().make_texture({.size = {k_size, k_size},
                                            .format = format,
                                            .filter = Filter::nearest,
                                            .samples = samples,
                                            .render_target = true}));
}

struct Picture {
  std::vector<float> pixels;
  SubmitCost cost;
  glm::vec4 at(int x, int y) const {
    const float* p = &pixels[std::size_t(y * k_size + x) * 4];
    return {p[0], p[1], p[2], p[3]};
  }
};

void record(Commands& commands, const std::vector<Draw>& draws) {
  for (const Draw& each : draws) {
    const Buffer vertices = must(make_buffer_from<Vertex>(shared_device(), each.vertices));
    const GraphicsPipeline pipeline = must(shared_device().make_graphics(each.description));
    commands.draw(pipeline, {&vertices}, {}, {}, std::uint32_t(each.vertices.size()));
  }
}

Picture drawn(const std::vector<Draw>& draws, bool depth = false, int samples = 1, glm::vec4 clear = glm::vec4(0)) {
  Device& device = shared_device();
  const Texture color = target(TextureFormat::rgba32f), depths = target(TextureFormat::depth32f);
  const Texture multisampled = target(TextureFormat::rgba32f, samples);
  Commands commands = device.record();
  commands.begin_pass("draw");
  const Commands::Target to{samples > 1 ? &multisampled : &color, samples > 1 ? &color : nullptr, clear};
  commands.begin_rendering({&to, 1}, depth ? &depths : nullptr);
  record(commands, draws);
  commands.end_rendering();
  commands.end_pass();
  SubmitCost cost = must(device.submit(std::move(commands)));
  return {must(device.download(color)), cost};
}

TEST(GpuDraw, Triangle_CoversItsPixelsAndCountsAsOneDraw) {
  const Picture picture = drawn({{{{{-1, -1, 0, 1}, k_red}, {{1, -1, 0, 1}, k_red}, {{-1, 1, 0, 1}, k_red}}, plain()}});
  EXPECT_EQ(picture.at(1, 1), k_red);
  EXPECT_EQ(picture.at(k_size - 2, k_size - 2), glm::vec4(0));
  EXPECT_EQ(picture.cost.passes[0].draws, 1u);
  EXPECT_EQ(picture.cost.passes[0].dispatches, 0u);
}

TEST(GpuDraw, NumbersThatTheDeviceHolds_SayHowMuchIsDrawn) {
  Device& device = shared_device();
  const Texture color = target(TextureFormat::rgba32f);
  std::vector<Vertex> both = cover(0.5f, k_red);
  const auto first = std::uint32_t(both.size());
  std::ranges::copy(cover(0.5f, k_green), std::back_inserter(both));
  const Buffer vertices = must(make_buffer_from<Vertex>(device, both));
  const GraphicsPipeline pipeline = must(device.make_graphics(plain()));
  for (const bool all : {false, true}) {
    const std::uint32_t numbers[] = {all ? 2 * first : first, 1, 0, 0};
    const Buffer held = must(make_buffer_from<std::uint32_t>(device, numbers));
    Commands commands = device.record();
    const Commands::Target to{&color};
    commands.begin_pass("draw");
    commands.begin_rendering({&to, 1}, nullptr);
    commands.draw_counted(pipeline, {&vertices}, {}, {}, held);
    commands.end_rendering();
    commands.end_pass();
    EXPECT_EQ(must(device.submit(std::move(commands))).passes[0].draws, 1u);
    const std::vector<float> pixels = must(device.download(color));
    EXPECT_EQ(pixels[0], all ? k_green.x : k_red.x);
    EXPECT_EQ(pixels[1], all ? k_green.y : k_red.y);
  }
}

TEST(GpuDraw, NearTriangleDrawnFirst_HidesTheFarOne) {
  const Picture picture = drawn({{cover(0.2f, k_red), with_depth()}, {cover(0.7f, k_green), with_depth()}}, true);
  EXPECT_EQ(picture.at(8, 8), k_red);
}

TEST(GpuDraw, NearTriangleDrawnLast_HidesTheFarOne) {
  const Picture picture = drawn({{cover(0.7f, k_green), with_depth()}, {cover(0.2f, k_red), with_depth()}}, true);
  EXPECT_EQ(picture.at(8, 8), k_red);
}

TEST(GpuDraw, DepthComparedForEquality_DrawsOnlyWhereItWasPrimed) {
  GraphicsDescription equal = with_depth();
  equal.depth_write = false;
  equal.depth_compare = DepthCompare::equal;
  EXPECT_EQ(drawn({{cover(0.5f, k_red), with_depth()}, {cover(0.5f, k_green), equal}}, true).at(8, 8), k_green);
  EXPECT_EQ(drawn({{cover(0.5f, k_red), with_depth()}, {cover(0.4f, k_green), equal}}, true).at(8, 8), k_red);
  equal.depth_compare = DepthCompare::less;
  EXPECT_EQ(drawn({{cover(0.5f, k_red), with_depth()}, {cover(0.5f, k_green), equal}}, true).at(8, 8), k_red);
  EXPECT_EQ(drawn({{cover(0.5f, k_red), with_depth()}, {cover(0.4f, k_green), equal}}, true).at(8, 8), k_green);
}

TEST(GpuDraw, PipelinesThatDifferInOneThing_AreNotShared) {
  Device& device = shared_device();
  std::vector<GraphicsDescription> different(10, with_depth());
  different[1].topology = Topology::lines;
  different[2].blend = BlendMode::alpha;
  different[3].depth_compare = DepthCompare::equal;
  different[4].depth_write = false;
  different[5].cull_back_faces = true;
  different[6].cull_front_faces = true;
  different[7].color_formats = {TextureFormat::rgba16f};
  different[8].fragment_spirv = {};
  different[8].color_formats = {};
  different[9].samples = device.info().sample_counts.back();
  for (const GraphicsDescription& each : different) must(device.make_graphics(each));
  const std::size_t before = device.pipelines_made();
  for (const GraphicsDescription& each : different) must(device.make_graphics(each));
  EXPECT_EQ(device.pipelines_made(), before) << "made again, shared";
  for (GraphicsDescription each : different) {
    each.interface.push_constant_bytes = 64;
    must(device.make_graphics(each));
  }
  EXPECT_EQ(device.pipelines_made(), before + different.size()) << "each its own";
}

TEST(GpuDraw, CulledFaces_AreNotDrawn) {
  GraphicsDescription description = plain();
  description.cull_back_faces = true;
  const glm::vec4 without_back = drawn({{cover(0.5f, k_red), description}}).at(8, 8);
  description.cull_back_faces = false;
  description.cull_front_faces = true;
  const glm::vec4 without_front = drawn({{cover(0.5f, k_red), description}}).at(8, 8);
  EXPECT_NE(without_back, without_front);
  EXPECT_EQ(without_back + without_front, k_red);
}

TEST(GpuDraw, Count_HoldsThePixelsOfItsRenderingsOnly) {
  Device& device = shared_device();
  if (!device.info().fragment_counts) GTEST_SKIP() << "the device counts no fragments";
  const Texture color = target(TextureFormat::rgba32f);
  const Commands::Target to{&color};
  Commands commands = device.record();
  for (const char* name : {"one", "two"}) {
    commands.begin_count(name);
    commands.begin_rendering({&to, 1}, nullptr);
    record(commands, std::vector<Draw>(name[0] == 'o' ? 1 : 2, {cover(0, k_red), plain()}));
    commands.end_rendering();
    commands.end_count();
  }
  const SubmitCost cost = must(device.submit(std::move(commands)));
  ASSERT_EQ(cost.fragments.size(), 2u);
  EXPECT_GE(cost.fragments[0].invocations, std::uint64_t(k_size * k_size));
  EXPECT_EQ(cost.fragments[1].invocations, 2 * cost.fragments[0].invocations);
}

TEST(GpuDraw, Line_IsDrawnInItsRowOnlyAndHiddenByWhatIsNearer) {
  GraphicsDescription lines = with_depth();
  lines.topology = Topology::lines;
  const float row = (4 + 0.5f) / k_size * 2 - 1;
  const std::vector<Vertex> line{{{-1, row, 0.5f, 1}, k_green}, {{1, row, 0.5f, 1}, k_green}};
  // Covers the left half, nearer than the line.
  const std::vector<Vertex> cover_left{
      {{-1, -1, 0.1f, 1}, k_red}, {{0, -1, 0.1f, 1}, k_red}, {{-1, 3, 0.1f, 1}, k_red}};
  const Picture picture = drawn({{cover_left, with_depth()}, {line, lines}}, true);
  EXPECT_EQ(picture.at(2, 4), k_red);
  EXPECT_EQ(picture.at(12, 4), k_green);
  EXPECT_EQ(picture.at(12, 3), glm::vec4(0));
  EXPECT_EQ(picture.at(12, 5), glm::vec4(0));
}

TEST(GpuDraw, AlphaBlending_MixesByTheSourcesAlpha) {
  GraphicsDescription blended = plain();
  blended.blend = BlendMode::alpha;
  const Picture picture = drawn({{cover(0, {1, 0, 0, 0.25f}), blended}}, false, 1, {0, 1, 0, 1});
  EXPECT_EQ(picture.at(8, 8), glm::vec4(0.25f, 0.75f, 0, 1));
}

TEST(GpuDraw, AdditiveBlending_Sums) {
  GraphicsDescription blended = plain();
  blended.blend = BlendMode::additive;
  const std::vector<Vertex> light = cover(0, {0.5f, 0.25f, 2, 1});
  EXPECT_EQ(drawn({{light, blended}, {light, blended}, {light, blended}}).at(8, 8), glm::vec4(1.5f, 0.75f, 6, 3));
}

TEST(GpuDraw, MultisampledEdge_ResolvesToPartialCoverage) {
  const int samples = shared_device().info().sample_counts.back();
  if (samples < 2) GTEST_SKIP() << "no multisampling offered";
  // A vertical edge through the middle of column 8.
  const float edge = 8.5f / k_size * 2 - 1;
  const std::vector<Vertex> left{{{-1, -1, 0, 1}, k_red},   {{edge, -1, 0, 1}, k_red}, {{-1, 1, 0, 1}, k_red},
                                 {{edge, -1, 0, 1}, k_red}, {{edge, 1, 0, 1}, k_red},  {{-1, 1, 0, 1}, k_red}};
  const Picture picture = drawn({{left, plain(samples)}}, false, samples);
  EXPECT_EQ(picture.at(7, 8).r, 1.0f);
  EXPECT_EQ(picture.at(9, 8).r, 0.0f);
  EXPECT_NEAR(picture.at(8, 8).r, 0.5f, 0.26f);
  EXPECT_GT(picture.at(8, 8).r, 0.0f);
}

TEST(GpuDraw, DepthOnly_WritesDepthWithoutAFragmentShader) {
  Device& device = shared_device();
  const Texture depths = target(TextureFormat::depth32f);
  GraphicsDescription only_depth = with_depth();
  only_depth.fragment_spirv = {};
  only_depth.color_formats.clear();
  Commands commands = device.record();
  commands.begin_rendering({}, &depths);
  record(commands, {{cover(0.25f, k_red), only_depth}});
  commands.end_rendering();
  must(device.submit(std::move(commands)));
  EXPECT_EQ(must(device.download(depths))[40], 0.25f);
}

TEST(GpuDraw, KeptTarget_IsNotCleared) {
  Device& device = shared_device();
  const Texture color = target(TextureFormat::rgba32f);
  Commands commands = device.record();
  for (const bool keep : {false, true}) {
    const Commands::Target to{&color, nullptr, keep ? k_red : k_green, keep};
    commands.begin_rendering({&to, 1}, nullptr);
    commands.end_rendering();
  }
  must(device.submit(std::move(commands)));
  EXPECT_EQ(must(device.download(color))[1], 1.0f);
}

TEST(GpuDraw, OutsideARendering_IsRefused) {
  Device& device = shared_device();
  Commands commands = device.record();
  commands.draw(must(device.make_graphics(plain())), {}, {}, {}, 3);
  EXPECT_FALSE(device.submit(std::move(commands)).ok());
}

TEST(GpuDraw, TargetsOfDifferentSizes_AreRefused) {
  Device& device = shared_device();
  const Texture color = target(TextureFormat::rgba32f);
  const Texture small = must(device.make_texture(
      {.size = {4, 4}, .format = TextureFormat::depth32f, .filter = Filter::nearest, .render_target = true}));
  Commands commands = device.record();
  const Commands::Target to{&color, nullptr};
  commands.begin_rendering({&to, 1}, &small);
  EXPECT_FALSE(device.submit(std::move(commands)).ok());
}

}  // namespace
}  // namespace cuticle::gpu::gpu_draw_test
