// Strands as they are given, on the device: bit by bit those of the groom; follow hairs against place() on the CPU.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "gpu/device.h"
#include "gpu/tests/test_device.h"
#include "strands/spline/place_gpu.h"
#include "tests/support/device_bound.h"

namespace cuticle::strands::place_gpu_test {
namespace {

gpu::Device& device() { return *tests::device(); }

/// Curls of different sizes, each vertex with a radius of its own.
Groom uneven() {
  Groom groom;
  for (const int size : {7, 2, 12, 64, 3}) {
    const float turn = 0.7f + 0.1f * float(groom.strand_count());
    for (int i = 0; i < size; ++i) {
      const float along = 0.004f * float(i), angle = turn * float(i);
      groom.positions.push_back({0.1f + along * std::cos(angle), 1.7f - along, along * std::sin(angle)});
      groom.radii.push_back(30e-6f + 1e-6f * std::fmod(float(groom.radii.size()) * 7.3f, 11.0f));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  return groom;
}

constexpr FollowHairs k_follow{.first = 1, .guides = 3, .per_guide = 4, .reach = 0.002, .tip_separation = 3};

std::vector<PlacedStrand> with_follow_hairs(const Groom& groom) {
  std::vector<PlacedStrand> placed = placed_strands(groom.strand_count());
  const std::vector<PlacedStrand> beside = follow_strands(groom, {&k_follow, 1});
  placed.insert(placed.end(), beside.begin(), beside.end());
  return placed;
}

struct Drawn {
  std::vector<glm::vec4> vertices, tangents, velocities;
  std::uint32_t row = 0;
  gpu::SubmitCost cost;
};

std::vector<glm::vec4> padded(std::span<const glm::vec3> points) {
  std::vector<glm::vec4> wide;
  for (const glm::vec3& point : points) wide.emplace_back(point, 0);
  return wide;
}

Drawn draw(const Groom& rest, std::span<const PlacedStrand> placed, std::span<const glm::vec3> now,
           const glm::mat3& turn, std::span<const glm::vec3> motion = {}, float since = 0, std::uint32_t parts = 1) {
  auto placer = *StrandPlacer::create(device().shared_from_this(), rest, placed, !motion.empty(), parts);
  const gpu::Buffer controls = *gpu::make_buffer_from<glm::vec4>(device(), padded(now)),
                    moving = *gpu::make_buffer_from<glm::vec4>(device(), padded(motion.empty() ? now : motion));
  gpu::Commands commands = device().record();
  EXPECT_TRUE(placer->record(commands, controls, turn));
  if (!motion.empty()) {
    EXPECT_TRUE(placer->record_velocities(commands, controls, {&moving, since}, turn));
  }
  auto cost = device().submit(std::move(commands));
  EXPECT_TRUE(cost) << (cost ? "" : cost.error().message);
  const auto of = [&](const gpu::Buffer& buffer) {
    return *gpu::read_buffer<glm::vec4>(device(), buffer, placer->vertex_count());
  };
  return {of(placer->vertices()), of(placer->tangents()),
          motion.empty() ? std::vector<glm::vec4>() : of(placer->velocities()), placer->vertices_per_strand(), *cost};
}

TEST(StrandPlacer, StrandsOfAGroom_AreItsOwnBitByBitWithTheirRadii) {
  const Groom groom = uneven();
  const Drawn drawn = draw(groom, placed_strands(groom.strand_count()), groom.positions, glm::mat3(1));
  ASSERT_EQ(drawn.row, 64u);
  const std::vector<glm::vec3> expected = tangents(groom);
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t k = 0; k < drawn.row; ++k) {
      const std::size_t own = groom.offsets[s] + std::min(k, groom.strand_size(s) - 1), vertex = s * drawn.row + k;
      EXPECT_EQ(drawn.vertices[vertex], glm::vec4(groom.positions[own], groom.radii[own])) << s << " " << k;
      EXPECT_LT(glm::distance(glm::vec3(drawn.tangents[vertex]), expected[own]), 1e-6f) << s << " " << k;
    }
}

/// Vertices of the cut strands of a groom, and the same moved through.
TEST(StrandPlacer, SegmentsCutIntoParts_KeepTheirVerticesAndLieOnThem) {
  constexpr std::uint32_t k_parts = 3;
  const Groom groom = uneven();
  const std::vector<PlacedStrand> placed = with_follow_hairs(groom);
  std::vector<glm::vec3> motion;
  for (const glm::vec3& position : groom.positions) motion.push_back({position.y, -position.x, 2 * position.z});
  const Drawn whole = draw(groom, placed, groom.positions, glm::mat3(1), motion),
              cut = draw(groom, placed, groom.positions, glm::mat3(1), motion, 0, k_parts);
  const Groom expected = place(groom, placed, k_parts);
  ASSERT_EQ(cut.row, cut_size(64, k_parts));
  const double bound = tests::bound_for(device(), 1e-7, 2e-7);  // metres; measured on an H200: 1.2e-7
  for (std::size_t s = 0; s < placed.size(); ++s) {
    const std::size_t size = groom.strand_size(placed[s].guide);
    ASSERT_EQ(expected.strand_size(s), cut_size(size, k_parts));
    for (std::size_t i = 0; i < cut.row; ++i) {
      const std::size_t own = std::min(i, expected.strand_size(s) - 1), vertex = s * cut.row + i;
      const glm::vec3 position = expected.positions[expected.offsets[s] + own];
      EXPECT_LT(glm::distance(glm::vec3(cut.vertices[vertex]), position), bound) << s << " " << i;
      EXPECT_NEAR(cut.vertices[vertex].w, expected.radii[expected.offsets[s] + own], 1e-11f) << s << " " << i;
      const std::size_t before = s * whole.row + own / k_parts, after = std::min(before + 1, s * whole.row + size - 1);
      const float share = float(own % k_parts) / float(k_parts);
      EXPECT_LT(
          glm::distance(cut.velocities[vertex], glm::mix(whole.velocities[before], whole.velocities[after], share)),
          1e-5f)
          << s << " " << i;
    }
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t vertex = s * cut.row + k * k_parts;
      EXPECT_EQ(cut.vertices[vertex], whole.vertices[s * whole.row + k]) << s << " " << k;
      EXPECT_NEAR(cut.tangents[vertex].w, whole.tangents[s * whole.row + k].w, 1e-6f) << s << " " << k;
    }
  }
}

TEST(StrandPlacer, Fractions_RunFromRootToTipByLength) {
  const Groom groom = uneven();
  const Drawn drawn = draw(groom, placed_strands(groom.strand_count()), groom.positions, glm::mat3(1));
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const double whole = strand_length(groom, s);
    double along = 0;
    for (std::size_t k = 0; k < drawn.row; ++k) {
      if (k > 0 && k < groom.strand_size(s)) along += double(glm::distance(groom.strand(s)[k], groom.strand(s)[k - 1]));
      EXPECT_NEAR(double(drawn.tangents[s * drawn.row + k].w), along / whole, 1e-5) << s << " " << k;
    }
  }
}

TEST(StrandPlacer, FollowHairsAtRest_AreThoseOfTheCpu) {
  const Groom groom = uneven();
  const std::vector<PlacedStrand> placed = with_follow_hairs(groom);
  ASSERT_EQ(placed.size(), 5u + 12u);
  const Groom expected = place(groom, placed);
  const Drawn drawn = draw(groom, placed, groom.positions, glm::mat3(1));
  for (std::size_t s = 0; s < placed.size(); ++s)
    for (std::size_t k = 0; k < expected.strand_size(s); ++k) {
      const glm::vec4 vertex = drawn.vertices[s * drawn.row + k];
      EXPECT_LT(glm::distance(glm::vec3(vertex), expected.strand(s)[k]), 1e-6f) << s << " " << k;
      EXPECT_EQ(vertex.w, expected.radii[expected.offsets[s] + k]);
    }
  EXPECT_GT(glm::distance(expected.strand(5)[0], expected.strand(1)[0]), 1e-5f) << "beside its guide";
}

TEST(StrandPlacer, FollowHairsOfATurnedHead_TurnWithIt) {
  const Groom groom = uneven();
  const std::vector<PlacedStrand> placed = with_follow_hairs(groom);
  const float c = std::cos(0.8f), s = std::sin(0.8f);
  const glm::mat3 turn(glm::vec3(c, 0, -s), glm::vec3(0, 1, 0), glm::vec3(s, 0, c));
  std::vector<glm::vec3> now;
  for (const glm::vec3& point : groom.positions) now.push_back(turn * point);
  const Groom expected = place(groom, placed);
  const Drawn drawn = draw(groom, placed, now, turn);
  for (std::size_t strand = 0; strand < placed.size(); ++strand)
    for (std::size_t k = 0; k < expected.strand_size(strand); ++k)
      EXPECT_LT(glm::distance(glm::vec3(drawn.vertices[strand * drawn.row + k]), turn * expected.strand(strand)[k]),
                2e-6f);
}

// Guides that turn at their roots by themselves: velocities against a difference of two frames.
TEST(StrandPlacer, Velocities_AreTheDifferenceOfPositionsByTime) {
  const Groom groom = uneven();
  const std::vector<PlacedStrand> placed = with_follow_hairs(groom);
  constexpr float k_since = 2e-3f;
  std::vector<glm::vec3> velocities, before, after;
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) {
    const float k = float(v);
    velocities.emplace_back(0.3f * std::sin(k), 0.5f * std::cos(2 * k), -0.4f + 0.2f * std::sin(3 * k));
    before.push_back(groom.positions[v] - 0.5f * k_since * velocities.back());
    after.push_back(groom.positions[v] + 0.5f * k_since * velocities.back());
  }
  const Drawn moving = draw(groom, placed, groom.positions, glm::mat3(1), velocities),
              a = draw(groom, placed, before, glm::mat3(1)), b = draw(groom, placed, after, glm::mat3(1));
  float off = 0;
  for (std::size_t v = 0; v < moving.velocities.size(); ++v)
    off = std::max(off,
                   glm::length(glm::vec3(moving.velocities[v]) - glm::vec3(b.vertices[v] - a.vertices[v]) / k_since));
  std::printf("off by %.4f m/s of up to .7\n", double(off));
  EXPECT_LT(off, 0.02f);
  EXPECT_EQ(draw(groom, placed_strands(5), groom.positions, glm::mat3(1), groom.positions, k_since).velocities[3],
            glm::vec4(0))
      << "positions before that are those of now";
}

TEST(StrandPlacer, ADispatch_IsOneAFrame) {
  const Groom groom = uneven();
  const Drawn drawn = draw(groom, placed_strands(5), groom.positions, glm::mat3(1));
  ASSERT_EQ(drawn.cost.passes.size(), 1u);
  EXPECT_EQ(drawn.cost.passes[0].name, "place_strands");
  EXPECT_EQ(drawn.cost.passes[0].dispatches, 1u);
}

TEST(StrandPlacer, GuideThatIsNotThere_IsRefusedNamingIt) {
  const Groom groom = uneven();
  const std::vector<PlacedStrand> placed = {{.guide = 5}};
  const auto placer = StrandPlacer::create(device().shared_from_this(), groom, placed, false);
  ASSERT_FALSE(placer.ok());
  EXPECT_EQ(placer.error().message, "drawn strand 0: guide 5 of 5");
}

TEST(StrandPlacer, ControlHairsWithNaN_AreRefused) {
  Groom groom = uneven();
  groom.positions.back().x = std::numeric_limits<float>::quiet_NaN();
  const auto placer = StrandPlacer::create(device().shared_from_this(), groom, placed_strands(5), false);
  ASSERT_FALSE(placer.ok());
  EXPECT_EQ(placer.error().kind, ErrorKind::bad_input);
}

TEST(FollowStrands, OfAGroom_LieWithinTheReachAcrossTheFirstSegmentAndAreTheSameAgain) {
  const Groom groom = uneven();
  const std::vector<PlacedStrand> beside = follow_strands(groom, {&k_follow, 1});
  ASSERT_EQ(beside.size(), 12u);
  for (const PlacedStrand& placed : beside) {
    const auto guide = groom.strand(placed.guide);
    EXPECT_LE(glm::length(placed.offset), 0.002f * std::sqrt(2.0f));
    EXPECT_NEAR(glm::dot(placed.offset, glm::normalize(guide[1] - guide[0])), 0, 1e-8);
  }
  EXPECT_EQ(beside, follow_strands(groom, {&k_follow, 1}));
}

}  // namespace
}  // namespace cuticle::strands::place_gpu_test
