// Where colliders stand in the world, and how far places are from them.
#include <numbers>

#include <gtest/gtest.h>
#include <glm/ext/matrix_transform.hpp>

#include "sim/colliders/placed.h"
#include "sim/colliders/test_meshes.h"

namespace cuticle::sim::placed_test {
namespace {

double to(const std::variant<Sphere, RoundedBox, FieldPointer>& shape, const glm::dvec3& place) {
  return distance({shape, {}}, place);
}

TEST(PlacedCollider, Box_IsAsFarAsItsFacesEdgesAndMiddle) {
  const RoundedBox box{.half_size = {0.1, 0.2, 0.3}, .radius = 0.01};
  EXPECT_NEAR(to(box, {0.2, 0, 0}), 0.09, 1e-12);
  EXPECT_NEAR(to(box, {0.4, 0.6, 0}), 0.49, 1e-12);
  EXPECT_NEAR(to(box, {0, 0, 0}), -0.11, 1e-12);
  EXPECT_NEAR(to(make_capsule({0, 0, 0}, {0, 1, 0}, 0.1), {0.3, 1.4, 0}), 0.4, 1e-12);
}

TEST(PlacedCollider, Field_OfABall_IsTheBallsDistance) {
  const DistanceField field = bake_distance_field(testing::ball_mesh(0.1, 32), 0.01, "ball").value();
  const FieldPointer ball = std::make_shared<const DistanceField>(field);
  for (const double x : {0.05, 0.09, 0.11, 0.115, 0.5}) EXPECT_NEAR(to(ball, {x, 0, 0}), x - 0.1, 1.5e-3) << x;
}

TEST(PlacedColliders, OfAFrame_StandWhereHeadAndKeysTakeThem) {
  const Sphere still{{0.1, 0, 0}, 0.02};
  const KeyedMotion motion{{{0, {}}, {1, {.position = {0, 0.4, 0}}}}};
  const MovingCollider moving[] = {{Sphere{{0, 0, 0}, 0.01}, motion}, {Sphere{{0, 0, 0}, 0.01}, motion, true}};
  const glm::dmat4 head = glm::rotate(glm::translate(glm::dmat4(1), {1.0, 0, 0}), std::numbers::pi / 2, {0.0, 0, 1});
  const FrameInput input{.head_end = head, .colliders = {&still, 1}, .moving = moving, .clock_end = 0.5};
  const auto placed = placed_colliders(input);
  ASSERT_EQ(placed.size(), 3u);
  EXPECT_NEAR(distance(placed[0], {1, 0.1, 0}), -0.02, 1e-12) << "turned and moved by the head";
  EXPECT_NEAR(distance(placed[1], {0, 0.2, 0}), -0.01, 1e-12) << "by its keys alone";
  EXPECT_NEAR(distance(placed[2], {0.8, 0, 0}), -0.01, 1e-12) << "by its keys on the head";
  EXPECT_NEAR(distances(placed, {{glm::vec3(0, 0.21F, 0)}})[0], 0, 1e-7);
  EXPECT_TRUE(distances({}, {{glm::vec3(0)}}).empty());
}

}  // namespace
}  // namespace cuticle::sim::placed_test
