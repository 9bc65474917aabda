// N1, N2, N6: the procedural head, and control hairs planted on it, combed and kept outside.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include "strands/growing/bust.h"
#include "strands/growing/face_parts.h"
#include "strands/growing/growing.h"
#include "strands/growing/head_shape.h"
#include "strands/spline/smooth.h"

namespace cuticle::strands::growing_test {
namespace {

const Head& head() {
  static const Head instance = make_head();
  return instance;
}

Groom planted(const char* settings) {
  return plant_control_hairs(head(), registry::parse<Style>(settings).value()).value();
}

const Groom& planted_by_default() {
  static const Groom instance = planted("");
  return instance;
}

std::vector<std::uint32_t> own_hairs() {
  std::vector<std::uint32_t> hairs(head().scalp.positions.size());
  std::iota(hairs.begin(), hairs.end(), 0u);
  return hairs;
}

/// Distance of the deepest vertex inside the head, metres (0: none is), past the first `skipped` vertices of each
/// strand.
double deepest(const Groom& groom, std::size_t skipped) {
  double depth = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t i = skipped; i < groom.strand_size(s); ++i)
      depth = std::min(depth, head_distance(groom.strand(s)[i]));
  return -depth;
}

TEST(Head, Mesh_IsClosed) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : head().mesh.triangles)
    for (int i = 0; i < 3; ++i) ++edges[{t[std::size_t(i)], t[std::size_t(i + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

TEST(Head, Mesh_HasTheSizeOfAHead) {
  float crown = -1, chin = 1, nose = -1, width = 0;
  for (const glm::vec3& p : head().mesh.positions) {
    crown = std::max(crown, p.y);
    width = std::max(width, 2 * std::abs(p.x));
    nose = std::max(nose, p.z);
    if (p.z > 0.06f) chin = std::min(chin, p.y);
  }
  EXPECT_NEAR(double(crown - chin), 0.23, 0.02);
  EXPECT_NEAR(double(width), 0.165, 0.015);  // over the ears
  EXPECT_NEAR(double(nose), 0.11, 0.01);
}

TEST(Head, Normals_PointOutward) {
  for (std::size_t v = 0; v < head().scalp.positions.size(); ++v)
    ASSERT_GT(head_distance(glm::dvec3(head().scalp.positions[v]) + 0.01 * glm::dvec3(head().scalp.normals[v])), 0.003);
}

TEST(Head, Scalp_LiesOnTheMeshAndHasAboutTheVerticesAskedFor) {
  for (int wanted : {60, 1000}) EXPECT_NEAR(int(make_head(wanted).scalp.positions.size()), wanted, 0.25 * wanted);
  for (const glm::vec3& p : head().scalp.positions) ASSERT_NEAR(head_distance(p), 0, 1e-6);
}

TEST(Head, Colliders_LieInsideAndNearTheSkin) {
  EXPECT_GE(head().colliders.size(), 3u);
  for (const Sphere& sphere : head().colliders)
    for (int i = 0; i < 2000; ++i) {
      const double y = 1 - 2 * (i + 0.5) / 2000, r = std::sqrt(1 - y * y), turn = 2.399963 * i;
      const glm::dvec3 p = sphere.center + sphere.radius * glm::dvec3(r * std::cos(turn), y, r * std::sin(turn));
      if (p.y > -0.06) {
        ASSERT_LT(head_distance(p), 0);
      }
    }
  // Under 90 % of the scalp the skin is at most 12 mm above a sphere.
  std::size_t near = 0;
  for (const glm::vec3& p : head().scalp.positions)
    near += std::any_of(head().colliders.begin(), head().colliders.end(),
                        [&](const Sphere& s) { return glm::distance(glm::dvec3(p), s.center) < s.radius + 0.012; });
  EXPECT_GE(near, head().scalp.positions.size() * 9 / 10);
}

TEST(Bust, AddedParts_AreMirroredBelowAndBesideTheHead) {
  Mesh bust = head().mesh;
  add_bust(bust);
  ASSERT_GT(bust.positions.size(), head().mesh.positions.size());
  ASSERT_EQ(bust.normals.size(), bust.positions.size());
  glm::vec3 lower(1), upper(-1);
  for (const glm::vec3& point : bust.positions) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
  }
  EXPECT_NEAR(lower.x, -upper.x, 1e-4f);
  EXPECT_NEAR(upper.x, 0.212f, 0.005f);  // half the shoulders
  EXPECT_NEAR(lower.y, -0.3f, 1e-5f);
}

TEST(Bust, Ears_StandOffTheHeadByLessThanTwoCentimetres) {
  const Mesh ear = make_ear();
  const auto [from, to] = std::ranges::minmax(ear.positions, {}, [](const glm::vec3& point) { return point.y; });
  EXPECT_NEAR(to.y - from.y, 0.065f, 0.004f);
  double farthest = 0;
  for (const glm::vec3& point : ear.positions) farthest = std::max(farthest, head_distance(glm::dvec3(point)));
  EXPECT_GT(farthest, 0.006);
  EXPECT_LT(farthest, 0.02);
}

TEST(Bust, LidsAndLips_LieOnTheFace) {
  for (const Mesh& part : {make_eyelids(), make_lips()}) {
    double farthest = 0;
    for (const glm::vec3& point : part.positions) farthest = std::max(farthest, head_distance(glm::dvec3(point)));
    EXPECT_GT(farthest, 0);
    EXPECT_LT(farthest, 0.006);
  }
}

TEST(Planting, Defaults_OneHairPerScalpVertexRootedOnIt) {
  const Groom& groom = planted_by_default();
  ASSERT_TRUE(validate(groom).ok());
  ASSERT_EQ(groom.strand_count(), head().scalp.positions.size());
  for (std::size_t v = 0; v < groom.strand_count(); ++v) ASSERT_EQ(groom.strand(v)[0], head().scalp.positions[v]);
}

TEST(Planting, ControlHairs_AreAFewHundredOfSevenVertices) {
  const Groom& groom = planted_by_default();
  EXPECT_GT(groom.strand_count(), 200u);
  EXPECT_LT(groom.strand_count(), 500u);
  EXPECT_EQ(groom.vertex_count(), 7 * groom.strand_count());
}

TEST(Planting, Uncombed_HairsStandAlongTheNormals) {
  const Groom groom = planted("comb=0,droop=0,clump=0,length=0.05");
  for (std::size_t v = 0; v < groom.strand_count(); ++v) {
    const glm::vec3 direction = glm::normalize(groom.strand(v).back() - groom.strand(v).front());
    ASSERT_GT(glm::dot(direction, head().scalp.normals[v]), 0.9999f) << v;
  }
}

TEST(Planting, Combed_HairsStillLeaveTheScalpOutward) {
  const Groom& groom = planted_by_default();
  for (std::size_t v = 0; v < groom.strand_count(); ++v)
    ASSERT_GT(glm::dot(groom.strand(v)[1] - groom.strand(v)[0], head().scalp.normals[v]), 0) << v;
}

TEST(Planting, Segments_GrowByTheGivenRatio) {
  for (double ratio : {1.0, 1.6}) {
    const Groom groom = planted(("segment_growth=" + std::to_string(ratio)).c_str());
    for (std::size_t s = 0; s < groom.strand_count(); ++s) {
      const auto hair = groom.strand(s);
      for (std::size_t i = 2; i < hair.size(); ++i)
        ASSERT_NEAR(double(glm::distance(hair[i], hair[i - 1]) / glm::distance(hair[i - 1], hair[i - 2])), ratio, 1e-3);
    }
  }
}

TEST(Planting, Lengths_AreTheGivenLengthLessItsVariation) {
  const Groom groom = planted("length=0.2,length_variation=0.25");
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    ASSERT_LE(strand_length(groom, s), 0.2 + 1e-6);
    ASSERT_GE(strand_length(groom, s), 0.15 - 1e-6);
  }
}

TEST(Planting, Fringe_ShortensTheFrontOnly) {
  const Groom groom = planted("length=0.2,length_variation=0,fringe=0.3");
  std::size_t front = 0, back = 0;
  for (std::size_t v = 1; v < groom.strand_count(); ++v)
    (head().scalp.positions[v].z > head().scalp.positions[front].z ? front : back) = v;
  for (std::size_t v = 0; v < groom.strand_count(); ++v)
    if (head().scalp.positions[v].z < head().scalp.positions[back].z) back = v;
  EXPECT_NEAR(strand_length(groom, front), 0.06, 1e-5);
  EXPECT_NEAR(strand_length(groom, back), 0.2, 1e-5);
}

TEST(Planting, ControlHairs_AreOutsideTheHeadAndItsColliders) {
  for (const char* settings : {"", "parting=0", "length=0.1,clump=1", "volume=0.005", "droop=1,comb=0"}) {
    const Groom groom = planted(settings);
    EXPECT_LT(deepest(groom, 1), 1e-3) << settings;
    for (const Sphere& sphere : head().colliders)
      for (std::size_t v = 0; v < groom.vertex_count(); ++v)
        ASSERT_GT(glm::distance(glm::dvec3(groom.positions[v]), sphere.center), sphere.radius - 1e-3) << settings;
  }
}

TEST(Planting, DrawnHair_IsOutsideTheHead) {
  const Groom drawn =
      interpolate(smooth(planted_by_default(), 30), head().scalp, scatter_roots(head().scalp, 4095, 1), own_hairs());
  EXPECT_LT(deepest(drawn, 2), 2.5e-3);
}

TEST(Planting, DrawnHair_LeavesTheFaceFree) {
  const Groom drawn =
      interpolate(smooth(planted_by_default(), 30), head().scalp, scatter_roots(head().scalp, 4095, 1), own_hairs());
  const auto covers_face = [](const glm::vec3& p) {
    return p.z > 0.05f && std::abs(p.x) < 0.045f && p.y > 0.01f && p.y < 0.15f;
  };
  EXPECT_EQ(std::count_if(drawn.positions.begin(), drawn.positions.end(), covers_face), 0);
}

TEST(Planting, Parting_HairOfEachSideStaysOnItsSide) {
  const Groom groom = planted("clump=0");
  for (std::size_t v = 0; v < groom.strand_count(); ++v) {
    const glm::vec3 root = groom.strand(v)[0], tip = groom.strand(v).back();
    if (root.z > 0 && std::abs(root.x) > 0.005f) {
      ASSERT_GT(root.x * tip.x, 0) << v;
    }
  }
}

TEST(Planting, SameSeed_SameHair_OtherSeed_OtherHair) {
  EXPECT_EQ(planted("seed=1"), planted_by_default());
  EXPECT_NE(planted("seed=2"), planted_by_default());
}

TEST(Planting, ScalpWithoutVerticesOrNormals_IsRefused) {
  Head bare;
  EXPECT_FALSE(plant_control_hairs(bare, Style()).ok());
  bare.scalp.positions = {{0, 0, 0}};
  EXPECT_FALSE(plant_control_hairs(bare, Style()).ok());
}

}  // namespace
}  // namespace cuticle::strands::growing_test
