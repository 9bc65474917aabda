// Where shadow methods are compared: vertices of strands, and what a camera sees.
#include "study/shadows/probes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "study/shadows/slices_study.h"

namespace cuticle::study::probes_test {
namespace {

TEST(Probes, MoreThanThereAre_AreAllVerticesWithTheirStrands) {
  const strands::Groom groom = study_coat(3);
  const Probes probes = spread_probes(groom, 1000);
  ASSERT_EQ(probes.points.size(), 24u);
  EXPECT_EQ(probes.strands[7], 0u);
  EXPECT_EQ(probes.strands[8], 1u);
  EXPECT_EQ(probes.strands[23], 2u);
}

TEST(Probes, Camera_SeesTheNearestFibreOfEachPixel) {
  strands::Groom groom;
  for (int i = 0; i < 100; ++i)
    for (const float height : {0.0f, 0.1f}) {
      const float x = 0.01f * float(i % 10), z = 0.01f * float(i / 10) + 0.1f * height;
      groom.positions.insert(groom.positions.end(), {{x, height, z}, {x + 0.008f, height, z}});
      groom.offsets.push_back(std::uint32_t(groom.positions.size()));
    }
  groom.radii.assign(groom.positions.size(), 1e-3f);
  const Probes above = visible_probes(groom, {0, 1, 0}, 50), below = visible_probes(groom, {0, -1, 0}, 50);
  ASSERT_EQ(above.points.size(), 50u);
  double upper = 0, lower = 0;
  for (std::size_t i = 0; i < 50; ++i) {
    upper += above.points[i].y > 0.05f ? 1 : 0;
    lower += below.points[i].y < 0.05f ? 1 : 0;
    const glm::vec3 a = groom.positions[above.vertices[i]], b = groom.positions[above.vertices[i] + 1];
    EXPECT_NEAR(above.points[i].x, double(a.x) + double(above.fractions[i]) * double(b.x - a.x), 1e-6);
    EXPECT_EQ(above.strands[i], above.vertices[i] / 2);
  }
  EXPECT_GT(upper, 25) << "one row of the lower fibres lies free";
  EXPECT_GT(lower, 25);
  EXPECT_EQ(visible_probes(groom, {0, 1, 0}, 50).points, above.points);
}

// A pixel's ray meets a fibre beside its middle as often as there.
TEST(Probes, Camera_MeetsSurfacesOverTheWholeWidth) {
  constexpr float k_radius = 2e-3f;
  const glm::vec3 leaning = glm::normalize(glm::vec3(1, 0.6f, 0));  // towards the camera above
  strands::Groom groom;
  groom.positions = {glm::vec3(0), 0.1f * leaning};
  groom.offsets = {0, 2};
  groom.radii = {k_radius, k_radius};
  const Probes seen = visible_probes(groom, {0, 1, 0}, 2000);
  ASSERT_EQ(seen.met.size(), seen.points.size());
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < seen.met.size(); ++i) {
    if (seen.fractions[i] < 0.1f || seen.fractions[i] > 0.9f) continue;  // round ends
    const glm::vec3 away = seen.met[i] - seen.points[i];
    EXPECT_NEAR(glm::length(away), k_radius, 1e-5);
    EXPECT_NEAR(glm::dot(away, leaning), 0, 1e-5);
    EXPECT_GT(away.y, 0);
    squares += double(away.z) * double(away.z) / (double(k_radius) * double(k_radius));
    ++count;
  }
  EXPECT_NEAR(squares / count, 1.0 / 3, 0.02) << "offsets are even over the width";
}

/// Thin fibres on one another: a ray meets each as often as its width says, so that most of what it sees lies deeper
/// than the fibre that is nearest in its pixel.
TEST(Probes, Camera_SeesFibresAsOftenAsTheirWidthSays) {
  strands::Groom groom;
  for (int i = 0; i < 400; ++i) {
    const float x = 0.00025f * float(i) + 1e-5f * float(i % 7), height = 0.0001f * float((i * 37) % 400);
    groom.positions.insert(groom.positions.end(), {{x, height, 0}, {x, height, 0.1f}});
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), 2.5e-5f);  // a fifth of the width is covered
  const Probes seen = visible_probes(groom, {0, 1, 0}, 1000);
  ASSERT_EQ(seen.points.size(), 1000u);
  double height = 0;
  for (const glm::vec3& point : seen.points) height += double(point.y) / 1000;
  EXPECT_NEAR(height, 0.02, 0.002) << "the mean of all: fibres do not hide each other";
}

}  // namespace
}  // namespace cuticle::study::probes_test
