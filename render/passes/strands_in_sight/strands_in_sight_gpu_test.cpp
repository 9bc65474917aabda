// The list of the strands in sight: which they are, and how much work kernels over it have.
#include <algorithm>
#include <limits>

#include <gmock/gmock.h>

#include "render/passes/strands_in_sight/strands_in_sight_gpu.h"
#include "strands/lod/strand_list_gpu.h"
#include "tests/support/drawn_strands.h"

namespace cuticle::render::strands_in_sight_gpu_test {
namespace {

using tests::Drawing, tests::device;

constexpr std::uint32_t k_vertices = 4;

struct Listed {
  std::vector<std::uint32_t> groups, strands;  ///< of vertices and of segments; ascending
  std::vector<std::string> notes;
};

Listed listed(const Drawing& drawing, double widening = 1) {
  const gpu::Buffer vertices = tests::upload(drawing.vertices);
  Resources resources;
  resources.edit<FrameView>().camera = drawing.camera();
  resources.edit<FrameView>().strand_widening = widening;
  resources.edit<DrawnHair>().strands = {&vertices, nullptr, std::uint32_t(drawing.vertices.size()), 0, {}};
  resources.edit<DrawnHair>().vertices_per_strand = k_vertices;
  resources.put(StrandDraw{});
  const auto entry = std::ranges::find(gpu_passes(), "strands_in_sight", &GpuPassEntry::name);
  const auto pass = *(*entry)->create(device(), resources);
  pass->publish(resources);
  gpu::Commands commands = device()->record();
  EXPECT_TRUE(pass->record(commands, resources));
  EXPECT_TRUE(device()->submit(std::move(commands)));
  const auto words = *gpu::read_buffer<std::uint32_t>(*device(), resources.get<strands_in_sight::StrandsInSight>().list,
                                                      strands::k_list_head + drawing.vertices.size() / k_vertices);
  EXPECT_EQ(words[1], k_vertices);
  const auto begin = words.begin() + strands::k_list_head;
  return {{words.begin() + 2, begin}, {begin, begin + words[0]}, pass->settle()->notes};
}

/// A short strand across a place on the plane z = 0, on which the view of Drawing is so wide as `half`.
void across(Drawing& drawing, glm::vec3 place, float radius = 1e-4f) {
  drawing.strand({place, place + glm::vec3(0.01, 0, 0), place + glm::vec3(0.02, 0, 0), place + glm::vec3(0.03, 0, 0)},
                 radius, {});
}

/// Half the side of what the camera sees on the plane z = 0.
float half_side(const Drawing& drawing) {
  const Camera camera = drawing.camera();
  return float(camera.position.z * std::tan(camera.vertical_field_of_view / 2));
}

TEST(StrandsInSight, StrandsBesideTheView_AreNotListed) {
  Drawing drawing;
  const float half = half_side(drawing), far = 2 * half;
  across(drawing, {0, 0, 0});
  across(drawing, {far, 0, 0});
  across(drawing, {-far, 0, 0});
  across(drawing, {0, far, 0});
  across(drawing, {0, -far, 0});
  across(drawing, {0, 0, 100});  // behind the camera
  drawing.strand({{-far, 0, 0}, {-1.9f * half, 0, 0}, {1.9f * half, 0, 0}, {far, 0, 0}}, 1e-4f, {});  // passes through
  across(drawing, {1.05f * half, 0, 0});  // within the margin
  const Listed found = listed(drawing);
  EXPECT_THAT(found.strands, testing::ElementsAre(0, 6, 7));
  EXPECT_THAT(found.groups, testing::ElementsAre(1, 1, 1, 1, 1, 1));
  EXPECT_THAT(found.notes, testing::ElementsAre(testing::HasSubstr("3 of 8 strands")));
}

TEST(StrandsInSight, WideStrandBesideTheView_IsListed) {
  Drawing drawing;
  const float half = half_side(drawing);
  across(drawing, {1.6f * half, 0, 0}, 0.3f * half);
  EXPECT_THAT(listed(drawing).strands, testing::IsEmpty());
  EXPECT_THAT(listed(drawing, 2).strands, testing::ElementsAre(0)) << "where it stands for two";
  Drawing wide;
  across(wide, {1.6f * half, 0, 0}, half);
  EXPECT_THAT(listed(wide).strands, testing::ElementsAre(0));
}

TEST(StrandsInSight, NumbersThatAreNone_CountAsSeen) {
  Drawing drawing;
  const float far = 2 * half_side(drawing);
  across(drawing, {far, 0, 0});
  across(drawing, {far, 0, 0});
  drawing.vertices[6].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(listed(drawing).strands, testing::ElementsAre(1));
}

TEST(StrandsInSight, ManyStrands_AreListedInTheirOrder) {
  Drawing drawing;
  const float far = 2 * half_side(drawing);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t s = 0; s < 20000; ++s) {
    const bool seen = (s * 2654435761u >> 16 & 3) == 0;
    across(drawing, {seen ? 0 : far, 0, 0});
    if (seen) expected.push_back(s);
  }
  const Listed found = listed(drawing);
  EXPECT_EQ(found.strands, expected);
  const auto groups = [&](std::size_t each) { return std::uint32_t((expected.size() * each + 63) / 64); };
  EXPECT_THAT(found.groups, testing::ElementsAre(groups(k_vertices), 1, 1, groups(k_vertices - 1), 1, 1));
}

}  // namespace
}  // namespace cuticle::render::strands_in_sight_gpu_test
