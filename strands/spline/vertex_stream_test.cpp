// The per-frame vertex buffer against smoothing, interpolating and taking tangents one after the other.
#include "strands/spline/vertex_stream.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "strands/growing/growing.h"
#include "strands/spline/smooth.h"

namespace cuticle::strands::vertex_stream_test {
namespace {

struct Hair {
  Head head = make_head(60);
  Groom control = plant_control_hairs(head, Style()).value();
  std::vector<Root> roots = scatter_roots(head.scalp, 700, 5);
  std::vector<std::array<std::uint32_t, 3>> hairs;
  std::vector<glm::vec3> weights;
  Hair() {
    for (const Root& root : roots) {
      hairs.push_back(head.scalp.triangles[root.triangle]);
      weights.push_back(root.weights);
    }
  }
};

TEST(VertexStream, EveryFrame_IsSmoothingThenInterpolating) {
  Hair hair;
  auto stream = VertexStream::create(hair.control, 17, hair.hairs, hair.weights, 4e-5f);
  ASSERT_TRUE(stream);
  std::vector<std::uint32_t> same(hair.control.strand_count());
  for (std::uint32_t v = 0; v < same.size(); ++v) same[v] = v;
  for (int frame = 0; frame < 2; ++frame) {
    for (glm::vec3& p : hair.control.positions) p += glm::vec3(0.1f * p.y, 0.02f, 0.3f * p.x * p.y);
    stream->update(hair.control.positions);
    const Groom expected = interpolate(smooth(hair.control, 17), hair.head.scalp, hair.roots, same);
    const std::vector<glm::vec3> along = tangents(expected);
    for (std::size_t v = 0; v < expected.vertex_count(); ++v) {
      ASSERT_LT(glm::distance(glm::vec3(stream->vertices()[v]), expected.positions[v]), 1e-7f);
      ASSERT_LT(glm::distance(glm::vec3(stream->tangents()[v]), along[v]), 1e-4f);
      const float fraction = stream->tangents()[v].w;
      ASSERT_FLOAT_EQ(stream->vertices()[v].w, 4e-5f * (1 - 0.5f * fraction));
      if (v % 17 == 0 || v % 17 == 16) {
        ASSERT_NEAR(fraction, v % 17 / 16, 1e-6);
      }
    }
  }
}

TEST(VertexStream, HairsOfOneVertexOrPlaceAndReversedOnes_AreThoseOfSmoothing) {
  Groom control;
  const std::vector<std::vector<glm::vec3>> hairs{{{0, 1, 0}},
                                                  {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
                                                  {{0, 0, 0}, {0, 1, 0}, {0, 0, 0}},
                                                  {{0, 0, 0}, {0.2f, 0.1f, 0}, {0.5f, 0.1f, 0.1f}, {0.6f, 0, 0}}};
  for (const auto& hair : hairs) {
    control.positions.insert(control.positions.end(), hair.begin(), hair.end());
    control.offsets.push_back(std::uint32_t(control.positions.size()));
  }
  control.radii.assign(control.vertex_count(), 1e-4f);
  const std::vector<std::array<std::uint32_t, 3>> corners{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 2, 0}};
  const std::vector<glm::vec3> weights{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0.5f, 0.25f, 0.25f}};
  auto stream = VertexStream::create(control, k_max_vertices, corners, weights, 4e-5f);
  ASSERT_TRUE(stream);
  stream->update(control.positions);
  const Mesh scalp{std::vector<glm::vec3>(4), {}, {}, corners};
  const std::vector<Root> roots{{0, weights[0]}, {1, weights[1]}, {2, weights[2]}, {3, weights[3]}};
  const std::vector<std::uint32_t> own{0, 1, 2, 3};
  const Groom expected = interpolate(smooth(control, k_max_vertices), scalp, roots, own);
  const std::vector<glm::vec3> along = tangents(expected);
  for (std::size_t v = 0; v < expected.vertex_count(); ++v) {
    ASSERT_LT(glm::distance(glm::vec3(stream->vertices()[v]), expected.positions[v]), 1e-6f) << v;
    ASSERT_LT(glm::distance(glm::vec3(stream->tangents()[v]), along[v]), 1e-3f) << v;
  }
}

TEST(VertexStream, HeldBytes_AreLittleMoreThanTheOutput) {
  const Hair hair;
  std::vector<std::array<std::uint32_t, 3>> many;
  std::vector<glm::vec3> weights;
  for (int k = 0; k < 10; ++k) {
    many.insert(many.end(), hair.hairs.begin(), hair.hairs.end());
    weights.insert(weights.end(), hair.weights.begin(), hair.weights.end());
  }
  const auto stream = VertexStream::create(hair.control, 36, many, weights, 4e-5f);
  ASSERT_TRUE(stream);
  EXPECT_LT(double(stream->bytes()), 1.2 * double(stream->vertices().size() * 2 * sizeof(glm::vec4)));
}

TEST(VertexStream, WrongInput_IsNamed) {
  const Hair hair;
  EXPECT_FALSE(VertexStream::create(hair.control, 1, hair.hairs, hair.weights, 1e-5f).ok());
  EXPECT_FALSE(VertexStream::create(hair.control, 8, hair.hairs, {}, 1e-5f).ok());
  auto wrong = hair.hairs;
  wrong[3][1] = 1000000;
  const auto refused = VertexStream::create(hair.control, 8, wrong, hair.weights, 1e-5f);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("drawn strand 3"), std::string::npos);
}

}  // namespace
}  // namespace cuticle::strands::vertex_stream_test
