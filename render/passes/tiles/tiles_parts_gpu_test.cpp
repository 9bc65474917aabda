// Segments that have vertices between their ends, drawn whole, beside the same strands drawn part by part.
#include <gtest/gtest.h>

#include "tests/support/tile_passes.h"

namespace cuticle::render::tiles_parts_gpu_test {
namespace {

using tests::draw, tests::Drawing, tests::Drawn, tests::mean_difference;

constexpr std::uint32_t k_parts = 8;

struct Way {
  std::string_view name;
  double opacity = 1;
  std::int64_t slices = 0, coverage_rows = 8, lanes = 0;
};

Drawing empty(const Way& way) {
  Drawing drawing;
  drawing.opacity = way.opacity;
  drawing.slices = way.slices;
  drawing.coverage_rows = way.coverage_rows;
  drawing.lanes = way.lanes;
  return drawing;
}

/// Straight segments between the points, each in parts, along which colours rise and fall.
void add_strand(Drawing& drawing, const std::vector<glm::vec3>& points, float radius) {
  std::vector<glm::vec3> cut;
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    for (std::uint32_t p = 0; p < k_parts; ++p)
      cut.push_back(glm::mix(points[k], points[k + 1], float(p) / float(k_parts)));
  cut.push_back(points.back());
  const std::size_t first = drawing.colors.size();
  drawing.strand(cut, radius, glm::vec3(0));
  for (std::size_t v = first; v < drawing.colors.size(); ++v) {
    const float turn = 2 * std::numbers::pi_v<float> * float(v - first) / float(k_parts);
    drawing.colors[v] =
        glm::vec4(0.5f + 0.5f * std::cos(turn), 0.5f + 0.5f * std::sin(turn), 0.5f - 0.5f * std::cos(turn), 1);
  }
}

class TilesParts : public testing::TestWithParam<Way> {};

// Strands that run away from the eye, through the near plane and out of the view.
TEST_P(TilesParts, SegmentDrawnWhole_HasTheColorsOfItsVertices) {
  Drawing drawing = empty(GetParam());
  const float wide = 2 * drawing.pixel();
  add_strand(drawing, {{-3, -2, 1}, {3, -1, -4}, {9, 6, -9}}, wide);
  add_strand(drawing, {{-2, 3, 5}, {1, 1, -2}, {3, 3, -3}}, wide);
  add_strand(drawing, {{-14, 0.3f, 0}, {14, 0.9f, 0}}, wide);
  const Drawn parts = draw(drawing);
  drawing.segment_parts = k_parts;
  const Drawn whole = draw(drawing);
  const double coverage = mean_difference(whole.color, parts.color, 3, 4),
               color = mean_difference(whole.color, parts.color, 0, 3),
               light = mean_difference(parts.color, make_image(drawing.size, drawing.size, {"R", "G", "B", "A"}), 0, 3);
  std::printf("%s: coverage %.5f, colour %.5f of %.4f\n", GetParam().name.data(), coverage, color, light);
  EXPECT_GT(light, 0.02);
  EXPECT_LT(coverage, 0.0035);
  EXPECT_LT(color, 0.035 * light);
}
INSTANTIATE_TEST_SUITE_P(Ways, TilesParts,
                         testing::Values(Way{"spans"}, Way{.name = "areas", .coverage_rows = 0},
                                         Way{.name = "translucent", .opacity = 0.4},
                                         Way{.name = "slices", .slices = 16}, Way{.name = "lanes", .lanes = 64}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(TilesPartsLists, SegmentInView_HasAllItsVerticesSeen) {
  Drawing drawing = empty({});
  add_strand(drawing, {{-1, 0, 0}, {1, 0, 0}, {9, 3, 0}, {12, 3, 0}}, drawing.pixel());
  drawing.segment_parts = k_parts;
  const std::vector<bool> seen = draw(drawing).seen;
  for (std::size_t v = 0; v < seen.size(); ++v) EXPECT_EQ(seen[v], v <= 2 * k_parts) << v;
}

}  // namespace
}  // namespace cuticle::render::tiles_parts_gpu_test
