// Segments with numbers that are none: counted, whatever else of their strand is seen.
#include <algorithm>
#include <limits>

#include <gmock/gmock.h>

#include "render/pass_gpu.h"
#include "render/passes/quads/quads.h"
#include "tests/support/drawn_strands.h"

namespace cuticle::render::cull_strands_gpu_test {
namespace {

using tests::Drawing, tests::device;

constexpr std::uint32_t k_vertices = 4;

/// The notes of a frame that culls the strands for `quads`.
std::vector<std::string> notes_of(const Drawing& drawing) {
  const gpu::Texture depth = *device()->make_texture(
      {drawing.camera().resolution, gpu::TextureFormat::depth32f, gpu::Filter::nearest, 1, true});
  const gpu::Buffer vertices = tests::upload(drawing.vertices), segments = tests::upload(drawing.segments);
  Resources resources;
  resources.edit<FrameView>().camera = drawing.camera();
  resources.edit<DrawnHair>().strands = {&vertices,
                                         &segments,
                                         std::uint32_t(drawing.vertices.size()),
                                         std::uint32_t(drawing.segments.size()),
                                         {glm::vec3(-3), glm::vec3(3)}};
  resources.edit<DrawnHair>().vertices_per_strand = k_vertices;
  resources.edit<Targets>().depth = &depth;
  resources.put(StrandDraw{.corners = 6, .width_factor = 1});
  const auto entry = std::ranges::find(gpu_passes(), "cull_strands", &GpuPassEntry::name);
  const auto pass = *(*entry)->create(device(), resources);
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(pass->record(commands, resources));
  EXPECT_TRUE(device()->submit(std::move(commands)));
  return pass->settle()->notes;
}

/// Three strands across the view, of three segments each.
Drawing three_strands() {
  Drawing drawing;
  for (float y : {-0.5f, 0.0f, 0.5f}) drawing.strand({{-3, y, 0}, {-1, y, 0}, {1, y, 0}, {3, y, 0}}, 0.05f, {});
  return drawing;
}

TEST(CullStrands, AllInView_SaysNothing) { EXPECT_THAT(notes_of(three_strands()), testing::IsEmpty()); }

TEST(CullStrands, NumbersThatAreNone_AreCountedBySegment) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  Drawing drawing = three_strands();
  drawing.vertices[3].x = nan;                                   // one segment, behind two that are seen
  for (int v = 4; v < 8; ++v) drawing.vertices[v].w = infinity;  // three
  drawing.vertices[9].z = -infinity;                             // two
  EXPECT_THAT(notes_of(drawing), testing::ElementsAre("cull_strands: 2 of 3 strands drawn, the others are not seen",
                                                      "cull_strands: 6 segments left out: not finite"));
}

}  // namespace
}  // namespace cuticle::render::cull_strands_gpu_test
