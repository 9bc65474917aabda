// Transparency by slices of the tile's depth, beside the definition with lists, the tile sort and brute force.
#include <algorithm>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include "tests/support/tile_passes.h"

namespace cuticle::render::tiles_sliced_gpu_test {
namespace {

using tests::bundle, tests::draw, tests::Drawing, tests::Drawn, tests::mean_difference;

const glm::vec3 k_red(1, 0, 0), k_green(0, 1, 0);

// Measured: colour error .0259 sorted; .146, .036, .0251, .0242 with 1, 8, 64 and 256 slices.
TEST(Slices, MoreOfThem_AreNearerToTheTruth) {
  Drawing drawing = bundle(300);
  const Image truth = drawing.truth();
  double last = 1;
  for (int slices : {1, 8, 64, 256}) {
    drawing.slices = slices;
    const double error = mean_difference(draw(drawing).color, truth, 0, 3);
    std::printf("%d slices: colour error %.5f\n", slices, error);
    EXPECT_LT(error, last) << slices;
    last = error;
  }
  drawing.slices = 0;
  std::printf("sorted: colour error %.5f\n", mean_difference(draw(drawing).color, truth, 0, 3));
}

/// Steep strands along x, each so wide that it covers every pixel of one tile.
Drawing sheets(int count) {
  Drawing drawing;
  drawing.size = 8;
  drawing.opacity = 0.4;
  RandomStream random(11);
  const auto number = [&](float least, float most) { return least + (most - least) * float(random.next_unit()); };
  for (int k = 0; k < count; ++k)
    drawing.strand({{-20, 0, number(-6, 2)}, {20, 0, number(-6, 2)}}, 40, {number(0, 1), number(0, 1), number(0, 1)});
  return drawing;
}

/// The definition, with lists: of a pixel column, fragments (1 / depth, strand) of each slice in the order of the
/// slice at the tile's middle and then of the vertices, blended, and the slices from near to far.
glm::dvec3 blend_of_lists(const Drawing& drawing, double x) {
  const glm::dmat4 to_clip = projection_matrix(drawing.camera()) * view_matrix(drawing.camera());
  const auto inverse_depth = [&](std::size_t strand, double at) {
    const glm::dvec4 a = to_clip * glm::dvec4(glm::dvec3(drawing.vertices[2 * strand]), 1),
                     b = to_clip * glm::dvec4(glm::dvec3(drawing.vertices[2 * strand + 1]), 1);
    const double from = (a.x / a.w + 1) * 0.5 * drawing.size, to = (b.x / b.w + 1) * 0.5 * drawing.size;
    return glm::mix(1 / a.w, 1 / b.w, (at - from) / (to - from));
  };
  std::vector<double> middles;
  for (std::size_t k = 0; k < drawing.vertices.size() / 2; ++k) middles.push_back(inverse_depth(k, 0.5 * drawing.size));
  const double nearest = *std::ranges::max_element(middles), farthest = *std::ranges::min_element(middles);
  const auto slice_of = [&](double depth) {
    return std::clamp(int((nearest - depth) / (nearest - farthest) * 0.99999 * double(drawing.slices)), 0,
                      int(drawing.slices) - 1);
  };
  std::vector<std::size_t> order(middles.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return slice_of(middles[k]); });
  std::vector<std::vector<std::size_t>> lists(std::size_t(drawing.slices));
  for (std::size_t k : order) lists[std::size_t(slice_of(inverse_depth(k, x)))].push_back(k);
  glm::dvec3 light(0);
  double transmittance = 1;
  for (const auto& list : lists)
    for (std::size_t k : list) {
      light += transmittance * drawing.opacity * glm::dvec3(drawing.colors[2 * k]);
      transmittance *= 1 - drawing.opacity;
    }
  return light;
}

TEST(Slices, AnyNumber_BlendsTheFragmentListsOfTheDefinition) {
  Drawing drawing = sheets(14);
  for (int slices : {1, 5, 40}) {  // more than sixteen are drawn in turns
    drawing.slices = slices;
    const Drawn drawn = draw(drawing);
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(drawn.color.at(x, 3, c), blend_of_lists(drawing, x + 0.5)[c], 1e-3) << slices << " " << x;
  }
}

// Fragments go by their own depth: the tile sort has one order for both halves of the tile.
TEST(Slices, StrandsThatCrossInDepthWithinATile_AreInOrderOnBothSides) {
  for (int slices : {0, 16}) {
    Drawing drawing;
    drawing.size = 8;
    drawing.slices = slices;
    drawing.strand({{-20, 0, -2}, {20, 0, 2}}, 40, k_red);
    drawing.strand({{-20, 0, 2}, {20, 0, -2}}, 40, k_green);
    drawing.strand({{-20, 0, -4}, {20, 0, -4}}, 40, {0, 0, 1});
    drawing.strand({{-9, 0, 1}, {9, 0, 1}}, 1e-6f, {0, 0, 1});  // as thin as to be unseen: widens the range
    const Image color = draw(drawing).color;
    const bool left_is_green = color.at(1, 3, 1) > 0.99f, right_is_red = color.at(6, 3, 0) > 0.99f;
    EXPECT_EQ(left_is_green && right_is_red, slices > 0);
  }
}

TEST(Slices, FragmentsOfOneSlice_AreBlendedInTheOrderOfTheirVertices) {
  Drawing drawing;
  drawing.slices = 1;
  const float middle = 0.5f * drawing.pixel(), wide = 3 * drawing.pixel();
  drawing.strand({{-3, middle, 0}, {3, middle, 0}}, wide, k_red);
  drawing.strand({{middle, -3, 1}, {middle, 3, 1}}, wide, k_green);  // nearer, and yet behind
  EXPECT_NEAR(draw(drawing).color.at(32, 31, 0), 1, 2e-3);
  drawing.slices = 2;
  EXPECT_NEAR(draw(drawing).color.at(32, 31, 1), 1, 2e-3);
}

}  // namespace
}  // namespace cuticle::render::tiles_sliced_gpu_test
