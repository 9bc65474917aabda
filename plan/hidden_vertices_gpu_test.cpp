// Vertices that do not show are not shaded by formulas, and nobody can tell from the picture.
#include "tests/support/small_frames.h"

#include <cstdio>
#include <string>

#include <fmt/core.h>
#include <gmock/gmock.h>

namespace cuticle::plan::hidden_vertices_gpu_test {
namespace {

using namespace tests;

constexpr std::string_view k_direct = R"("material": {"model": {"kajiya_kay": {}}, "evaluate": "direct"})",
                           k_many = R"("strand_count": 3000)", k_refused = R"("seen_vertices": {"wanted": false})";

std::string passes_of(std::string_view some, std::string_view more = "") {
  return fmt::format(R"("passes": {{{}{}{}}})", some, some.empty() || more.empty() ? "" : ", ", more);
}

struct Shaded {
  int count = -1, all = -1;
};
/// As the frame says.
Shaded shaded(const FrameResult& frame) {
  Shaded said;
  for (const std::string& note : frame.notes)
    std::sscanf(note.c_str(), "seen_vertices: %d of %d", &said.count, &said.all);
  return said;
}

struct Way {
  std::string name, passes;
};
class HiddenVertices : public testing::TestWithParam<Way> {};

TEST_P(HiddenVertices, LeftUnshaded_GiveTheSamePicture) {
  const std::string sparing = passes_of(GetParam().passes), whole = passes_of(GetParam().passes, k_refused);
  const auto a = runner({k_light, k_shadow, k_tiles, k_motion, k_many, k_direct, sparing}),
             b = runner({k_light, k_shadow, k_tiles, k_motion, k_many, k_direct, whole});
  for (int frame = 0; frame < 2; ++frame) {
    const FrameResult few = frame_of(*a, frame), all = frame_of(*b, frame);
    EXPECT_TRUE(few.color.pixels == all.color.pixels) << frame;
    const Shaded said = shaded(few);
    std::printf("%s: %d of %d vertices shaded\n", GetParam().name.c_str(), said.count, said.all);
    EXPECT_EQ(said.all, 3000 * 12);
    EXPECT_GT(said.count, 0.02 * said.all);
    EXPECT_LT(said.count, 0.8 * said.all);
    EXPECT_EQ(shaded(all).count, -1) << "nothing was looked for";
  }
}
INSTANTIATE_TEST_SUITE_P(Ways, HiddenVertices,
                         testing::Values(Way{"spans", ""}, Way{"areas", R"("tiles": {"coverage_rows": 0})"},
                                         Way{"translucent", R"("tiles": {"opacity": 0.5})"},
                                         Way{"lanes", R"("tile_lists": {"lanes": 64})"},
                                         Way{"points", R"("shade_strands": {"point_px": 8})"},
                                         Way{"chunks", R"("tiles": {"chunk_px": 24})"}),
                         [](const auto& tested) { return tested.param.name; });

std::string why_not(std::initializer_list<std::string_view> parts) {
  const auto made = runner(parts);
  for (const LeftOut& left : made->plan().left_out)
    if (left.entry->name == "seen_vertices") return left.reason;
  return "";
}

TEST(HiddenVerticesPlan, OnlyFormulas_AreWorthLooking) {
  EXPECT_EQ(why_not({k_light, k_tiles, k_direct}), "");
  EXPECT_THAT(why_not({k_light, k_tiles}), testing::HasSubstr("shading costs less"));
  EXPECT_THAT(why_not({k_light, k_direct, R"("render": {"method": "quads"})"}), testing::HasSubstr("other passes"));
  EXPECT_EQ(why_not({k_light, k_tiles, k_direct, passes_of(k_refused)}),
            "the scene wants vertices shaded that do not show");
  EXPECT_EQ(why_not({k_light, k_tiles, k_direct, passes_of(R"("tile_sort": {"slices": 8})")}),
            "strands are blended by slices");
}

}  // namespace
}  // namespace cuticle::plan::hidden_vertices_gpu_test
