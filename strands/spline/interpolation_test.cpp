// H7: other curves and their deviation, attributes, strands that follow one hair, frames along a strand.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include "strands/spline/frames.h"
#include "strands/spline/smooth.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::strands::interpolation_test {
namespace {

using tests::uniform;

glm::vec3 random_vector(std::mt19937_64& random) {
  return {2 * uniform(random) - 1, 2 * uniform(random) - 1, 2 * uniform(random) - 1};
}

/// Three hairs of 24 vertices that wander at random from the corners of a triangle 2 cm wide, with attributes.
struct ThreeHairs {
  Mesh scalp{{{0, 0, 0}, {0.02f, 0, 0}, {0, 0, 0.02f}}, {}, {}, {{0, 1, 2}}};
  Groom hairs;
  std::vector<std::uint32_t> own{0, 1, 2};
  ThreeHairs() {
    std::mt19937_64 random(4);
    for (const glm::vec3& root : scalp.positions) {
      glm::vec3 point = root;
      for (int i = 0; i < 24; ++i, point += 0.005f * (random_vector(random) + glm::vec3(0, 0.5f, 0)))
        hairs.positions.push_back(point);
      hairs.offsets.push_back(std::uint32_t(hairs.positions.size()));
    }
    hairs.radii.assign(hairs.positions.size(), 3e-5f);
    hairs.attributes["shade"] = {Attribute::Domain::strand, 2, {1, 10, 2, 20, 4, 40}};
    hairs.attributes["wet"] = {Attribute::Domain::vertex, 1, std::vector<float>(hairs.positions.size(), 0)};
    for (std::size_t v = 0; v < hairs.positions.size(); ++v) hairs.attributes["wet"].values[v] = float(v);
  }
};

std::vector<Root> some_roots() {
  return {{0, {0.5f, 0.25f, 0.25f}},
          {0, {0.1f, 0.7f, 0.2f}},
          {0, {0.2f, 0.2f, 0.6f}},
          {0, {1, 0, 0}},
          {0, {0.5f, 0.1f, 0.4f}}};
}

glm::dmat3 turn_about_axis(const glm::dvec3& axis, double angle) {
  const glm::dmat3 cross(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
  return glm::dmat3(1) + std::sin(angle) * cross + (1 - std::cos(angle)) * (cross * cross);
}

Groom moved(Groom groom, const glm::dmat3& linear, const glm::dvec3& shift) {
  for (glm::vec3& position : groom.positions) position = glm::vec3(linear * glm::dvec3(position) + shift);
  return groom;
}

double largest_distance(const Groom& a, const Groom& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.vertex_count(); ++v)
    largest = std::max(largest, double(glm::distance(a.positions[v], b.positions[v])));
  return largest;
}

TEST(Curves, CatmullRom_PassesThroughTheControls_BSplineThroughTheEnds) {
  const ThreeHairs s;
  const Groom through = smooth(s.hairs, 24 * 3 - 2, Curve::catmull_rom), beside = smooth(s.hairs, 70, Curve::b_spline);
  for (std::size_t i = 0; i < 24; ++i) EXPECT_LT(glm::distance(through.positions[3 * i], s.hairs.positions[i]), 1e-7f);
  EXPECT_LT(glm::distance(beside.positions[0], s.hairs.positions[0]), 1e-8f);
  EXPECT_LT(glm::distance(beside.positions[69], s.hairs.positions[23]), 1e-7f);
  EXPECT_GT(glm::distance(beside.positions[3], s.hairs.positions[1]), 1e-5f);
}

TEST(Curves, CubicPolynomial_CatmullRomAndBSplineAreOfTheirDegree) {
  // A parabola at even parameters: Catmull-Rom repeats it; a B-spline is above it by a third of its second difference.
  Groom control;
  for (int i = 0; i < 7; ++i) control.positions.emplace_back(i, i * i, 0);
  control.offsets.push_back(7);
  control.radii.assign(7, 0.1f);
  const Groom catmull = smooth(control, 61, Curve::catmull_rom), spline = smooth(control, 61, Curve::b_spline);
  for (std::size_t i = 10; i <= 50; ++i) {
    const double x = double(i) / 10;
    EXPECT_NEAR(double(catmull.positions[i].y), x * x, 1e-5);
    EXPECT_NEAR(double(spline.positions[i].y), x * x + 1.0 / 3, 1e-5);
  }
}

TEST(Curves, StraightHair_DoesNotDeviate_BSplineDeviatesMost) {
  Groom straight;
  tests::add_strand(straight, {{0, 0, 0}, {0, 1, 0}, {0, 3, 0}, {0, 3.5f, 0}}, 0.1f);
  EXPECT_LT(deviation_from_controls(straight, smooth(straight, 40)).largest, 1e-6);
  const ThreeHairs s;
  const auto of = [&](Curve curve) { return deviation_from_controls(s.hairs, smooth(s.hairs, 200, curve)); };
  EXPECT_GT(of(Curve::b_spline).mean, of(Curve::catmull_rom).mean);
  EXPECT_GT(of(Curve::bezier).largest, of(Curve::bezier).mean);
  EXPECT_GT(of(Curve::bezier).mean, 0);
}

TEST(Curves, ManyVertices_AreAllowed) { EXPECT_EQ(smooth(ThreeHairs().hairs, k_max_vertices).vertex_count(), 768u); }

TEST(Attributes, SmoothAndInterpolate_BlendThem) {
  const ThreeHairs s;
  const Groom smoothed = smooth(s.hairs, 47);
  ASSERT_TRUE(validate(smoothed).ok());
  EXPECT_EQ(smoothed.attributes.at("wet").values[1], 0.5f);
  EXPECT_EQ(smoothed.attributes.at("shade"), s.hairs.attributes.at("shade"));
  for (const auto blend : {interpolate, follow}) {
    const Groom drawn = blend(s.hairs, s.scalp, some_roots(), s.own);
    ASSERT_TRUE(validate(drawn).ok());
    EXPECT_EQ(drawn.attributes.at("shade").values[0], 2.0f);
    EXPECT_EQ(drawn.attributes.at("shade").values[1], 20.0f);
    EXPECT_EQ(drawn.attributes.at("wet").values[1], 0.5f * 1 + 0.25f * 25 + 0.25f * 49);
  }
}

TEST(Interpolation, AffineMotionOfTheHairs_IsExact) {
  const ThreeHairs s;
  const glm::dmat3 linear(0.7, 0.4, -1.1, 0.2, 1.6, 0.3, -0.9, 0.1, 0.5);
  const glm::dvec3 shift(0.3, -0.1, 0.2);
  const Groom before = moved(interpolate(s.hairs, s.scalp, some_roots(), s.own), linear, shift);
  const Groom after = interpolate(moved(s.hairs, linear, shift), s.scalp, some_roots(), s.own);
  EXPECT_LT(largest_distance(before, after), 1e-7);
}

TEST(Following, RigidMotionOfTheHairs_IsExact) {
  const ThreeHairs s;
  const glm::dmat3 turn = turn_about_axis(glm::normalize(glm::dvec3(1, 2, -1)), 1.1);
  const glm::dvec3 shift(0.3, -0.1, 0.2);
  const Groom before = moved(follow(s.hairs, s.scalp, some_roots(), s.own), turn, shift);
  const Groom after = follow(moved(s.hairs, turn, shift), s.scalp, some_roots(), s.own);
  EXPECT_LT(largest_distance(before, after), 3e-7);
}

TEST(Following, KeepsItsDistanceFromTheHair) {
  const ThreeHairs s;
  const Groom drawn = follow(s.hairs, s.scalp, some_roots(), s.own);
  for (std::size_t strand : {0u, 4u}) {  // both follow the first hair
    const double offset = glm::distance(drawn.strand(strand)[0], s.hairs.positions[0]);
    for (std::size_t i = 0; i < 24; ++i)
      EXPECT_NEAR(double(glm::distance(drawn.strand(strand)[i], s.hairs.positions[i])), offset, 1e-7);
  }
}

TEST(Following, OppositeHairs_DoNotCollapse) {
  // Hairs that run apart to both sides of a parting: a blend of them is short, a follower keeps the hair's length.
  Groom hairs;
  tests::add_strand(hairs, {{0, 0, 0}, {-0.1f, 0.01f, 0}, {-0.2f, 0, 0}}, 3e-5f);
  tests::add_strand(hairs, {{0.01f, 0, 0}, {0.11f, 0.01f, 0}, {0.21f, 0, 0}}, 3e-5f);
  tests::add_strand(hairs, {{0, 0, 0.01f}, {-0.1f, 0.01f, 0.01f}, {-0.2f, 0, 0.01f}}, 3e-5f);
  const Mesh scalp{{{0, 0, 0}, {0.01f, 0, 0}, {0, 0, 0.01f}}, {}, {}, {{0, 1, 2}}};
  const std::vector<Root> roots{{0, {0.45f, 0.5f, 0.05f}}};
  const std::vector<std::uint32_t> own{0, 1, 2};
  EXPECT_LT(strand_length(interpolate(hairs, scalp, roots, own), 0), 0.05);
  EXPECT_NEAR(strand_length(follow(hairs, scalp, roots, own), 0), strand_length(hairs, 1), 0.005);
}

double frame_error(const StrandFrames& frames) {
  double error = 0;
  for (std::size_t i = 0; i < frames.tangents.size(); ++i) {
    const glm::dvec3 t(frames.tangents[i]), n(frames.normals[i]), b(frames.binormals[i]);
    error = std::max({error, std::abs(glm::length(t) - 1), std::abs(glm::length(n) - 1),
                      glm::length(glm::cross(t, n) - b), std::abs(glm::dot(t, n))});
  }
  return error;
}

TEST(Frames, StraightStrand_KeepsOneFrame_AlongAnyAxis) {
  for (const glm::vec3& along :
       {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1), glm::vec3(0.6f, 0.8f, 0)}) {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 5; ++i) points.push_back(along * float(i));
    const StrandFrames frames = frames_along(points, along);  // a reference that says nothing
    EXPECT_LT(frame_error(frames), 1e-6);
    for (const glm::vec3& normal : frames.normals) EXPECT_LT(glm::distance(normal, frames.normals[0]), 1e-6f);
  }
}

TEST(Frames, ReversingStrand_KeepsItsNormal) {
  const std::vector<glm::vec3> points{{0, 0, 0}, {0, 2, 0}, {0, 1, 0}, {0, 0.5f, 0}, {0, 3, 0}, {0, 3, 0}, {0, 3, 0}};
  const StrandFrames frames = frames_along(points, {1, 0, 0});
  EXPECT_LT(frame_error(frames), 1e-6);
  for (const glm::vec3& normal : frames.normals) EXPECT_LT(glm::distance(normal, glm::vec3(1, 0, 0)), 1e-6f);
}

TEST(Frames, SharpTurn_CarriesTheNormalAlong) {
  // Tangents turn by 150 degrees in a plane, and so must a normal that lies in it.
  const std::vector<glm::vec3> points{{0, 0, 0}, {0, 2, 0}, {0.5f, -0.8660254f, 0}};
  const StrandFrames frames = frames_along(points, {1, 0, 0});
  EXPECT_LT(glm::distance(frames.normals[1], glm::vec3(-0.8660254f, -0.5f, 0)), 1e-6f);
}

TEST(Frames, PlanarStrand_NormalAcrossThePlaneStays) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 60; ++i) points.emplace_back(std::cos(0.2f * float(i)), std::sin(0.2f * float(i)), 0);
  const StrandFrames frames = frames_along(points, {0, 0, 1});
  EXPECT_LT(frame_error(frames), 1e-6);
  for (const glm::vec3& normal : frames.normals) EXPECT_LT(glm::distance(normal, glm::vec3(0, 0, 1)), 1e-5f);
}

TEST(Frames, HelixOfOneTurn_TurnsByTheSolidAngleOfItsTangents) {
  // Tangents of a helix run round a circle of the sphere; transport turns by 2 pi (1 - cos) of its opening.
  constexpr int steps = 2000;
  const double slope = 1.0;  // rise over radius and radian
  std::vector<glm::vec3> points;
  for (int i = 0; i <= steps + 4; ++i) {
    const double turn = 2 * std::acos(-1.0) * (i - 2) / steps;
    points.emplace_back(std::cos(turn), slope * turn, std::sin(turn));
  }
  const StrandFrames frames = frames_along(points, {0, 1, 0});
  const double opening = 2 * std::acos(-1.0) * (1 - slope / std::sqrt(1 + slope * slope));
  EXPECT_NEAR(double(glm::dot(frames.normals[2], frames.normals[2 + steps])), std::cos(opening), 1e-3);
}

}  // namespace
}  // namespace cuticle::strands::interpolation_test
