// The strands that the device generates, against smooth(), interpolate() and tangents() on the CPU.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "gpu/device.h"
#include "gpu/tests/test_device.h"
#include "strands/spline/smooth_gpu.h"
#include "tests/support/device_bound.h"

namespace cuticle::strands::strand_generator_test {
namespace {

constexpr int k_vertices = 36;

// Curls of different sizes with uneven segments; hair 3 is one vertex, hair 4 two, hair 5 has all its vertices in one
// place.
Groom control_hairs() {
  Groom groom;
  for (const int size : {7, 7, 12, 1, 2, 7, 3, 64}) {
    const float turn = 0.7f + 0.1f * float(groom.strand_count());
    for (int i = 0; i < size; ++i) {
      const float along = groom.strand_count() == 5 ? 0.0f : 0.004f * float(i * i + i), angle = turn * float(i);
      groom.positions.push_back({0.1f + along * std::cos(angle), 1.7f - along, along * std::sin(angle)});
      groom.radii.push_back(35e-6f);
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  return groom;
}

// Every triple of hairs as a triangle of a scalp whose vertex k grew hair k; three strands on each.
struct Drawn {
  Mesh scalp;
  std::vector<std::uint32_t> hair_of_vertex;
  std::vector<Root> roots;
  std::vector<std::array<std::uint32_t, 3>> hairs;
  std::vector<glm::vec3> weights;

  void add(std::array<std::uint32_t, 3> triangle, const glm::vec3& weight) {
    scalp.triangles.push_back(triangle);
    roots.push_back({std::uint32_t(scalp.triangles.size() - 1), weight});
    hairs.push_back(triangle);
    weights.push_back(weight);
  }
};

Drawn drawn_on(std::uint32_t hairs) {
  Drawn drawn;
  drawn.scalp.positions.resize(hairs);
  for (std::uint32_t a = 0; a < hairs; ++a) drawn.hair_of_vertex.push_back(a);
  for (std::uint32_t a = 0; a < hairs; ++a)
    for (std::uint32_t b = 0; b < hairs; ++b)
      for (const glm::vec3& weight : {glm::vec3(1, 0, 0), glm::vec3(0.2f, 0.5f, 0.3f)})
        drawn.add({a, b, (a + b) % hairs}, weight);
  return drawn;
}

std::vector<glm::vec4> padded(const Groom& groom) {
  std::vector<glm::vec4> positions;
  for (const glm::vec3& p : groom.positions) positions.emplace_back(p, 0);
  return positions;
}

struct Generated {
  std::vector<glm::vec4> vertices, tangents;
  std::vector<std::uint32_t> segments;
  gpu::SubmitCost cost;
};

gpu::Device& device() { return *tests::device(); }

Generated generate(const Groom& control, const Drawn& drawn, int vertices = k_vertices) {
  auto generator = *StrandGenerator::create(
      device().shared_from_this(),
      {.control = &control, .vertices_per_strand = vertices, .hairs = drawn.hairs, .weights = drawn.weights});
  const std::vector<glm::vec4> positions = padded(control);
  const gpu::Buffer controls = *gpu::make_buffer_from<glm::vec4>(device(), positions);
  gpu::Commands commands = device().record();
  EXPECT_TRUE(generator->record_smooth(commands, controls).ok());
  EXPECT_TRUE(generator->record_interpolate(commands).ok());
  auto cost = device().submit(std::move(commands));
  EXPECT_TRUE(cost.ok()) << (cost ? "" : cost.error().message);
  return {*gpu::read_buffer<glm::vec4>(device(), generator->vertices(), generator->vertex_count()),
          *gpu::read_buffer<glm::vec4>(device(), generator->tangents(), generator->vertex_count()),
          *gpu::read_buffer<std::uint32_t>(device(), generator->segments(), generator->segment_count()), *cost};
}

/// The larger of both; not-a-number counts as the largest.
float larger(float a, float b) { return b <= a ? a : b; }

struct Both {
  Groom cpu;
  Generated gpu;
};
const Both& both() {
  static const Both result = [] {
    const Groom control = control_hairs();
    const Drawn drawn = drawn_on(std::uint32_t(control.strand_count()));
    return Both{interpolate(smooth(control, k_vertices), drawn.scalp, drawn.roots, drawn.hair_of_vertex),
                generate(control, drawn)};
  }();
  return result;
}

TEST(StrandGenerator, Positions_AreTheCpusWithinRounding) {
  const auto& [cpu, gpu] = both();
  ASSERT_EQ(gpu.vertices.size(), cpu.vertex_count());
  float error = 0;
  for (std::size_t i = 0; i < gpu.vertices.size(); ++i)
    error = larger(error, glm::length(glm::vec3(gpu.vertices[i]) - cpu.positions[i]));
  RecordProperty("largest_error", fmt::format("{:.3g}", error));
  EXPECT_LT(error, 1e-5f);
}

TEST(StrandGenerator, Tangents_AreTheCpusWithinRounding) {
  const auto& [cpu, gpu] = both();
  const std::vector<glm::vec3> expected = tangents(cpu);
  float error = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    error = larger(error, glm::length(glm::vec3(gpu.tangents[i]) - expected[i]));
  RecordProperty("largest_error", fmt::format("{:.3g}", error));
  EXPECT_LT(error, tests::bound_for(device(), 1e-4, 1.2e-3));  // where neighbours are a thousand roundings apart
}

TEST(StrandGenerator, Fractions_RiseFromRootToTipAndSetTheRadius) {
  const auto& [cpu, gpu] = both();
  for (std::size_t s = 0; s < cpu.strand_count(); ++s) {
    EXPECT_EQ(gpu.tangents[cpu.offsets[s]].w, 0.0f) << s;
    EXPECT_NEAR(gpu.tangents[cpu.offsets[s + 1] - 1].w, 1.0f, 1e-6f) << s;
    for (std::size_t i = cpu.offsets[s]; i < cpu.offsets[s + 1]; ++i) {
      if (i > cpu.offsets[s]) {
        ASSERT_GT(gpu.tangents[i].w, gpu.tangents[i - 1].w) << s;
      }
      ASSERT_NEAR(double(gpu.vertices[i].w), 35e-6 * (1 - 0.5 * double(gpu.tangents[i].w)), 1e-10) << s;
    }
  }
}

// The fraction is that of the control polygon, not of the curve through it: by how much on strands of one hair alone,
// for the first three hairs (the longest one has more control vertices than drawn ones, which cut its corners).
TEST(StrandGenerator, Fractions_AreCloseToThoseOfTheLength) {
  const auto& [cpu, gpu] = both();
  double error = 0;
  for (std::size_t s = 0; s < 3 * 8 * 2; s += 2) {
    const double whole = strand_length(cpu, s);
    double before = 0;
    for (std::size_t i = cpu.offsets[s] + 1; i < cpu.offsets[s + 1]; ++i) {
      before += glm::length(glm::dvec3(cpu.positions[i]) - glm::dvec3(cpu.positions[i - 1]));
      error = std::max(error, std::abs(double(gpu.tangents[i].w) - before / whole));
    }
  }
  RecordProperty("largest_error", fmt::format("{:.3g}", error));
  EXPECT_LT(error, 0.01) << "largest difference of the fractions";
}

TEST(StrandGenerator, Segments_JoinNeighboursOfOneStrand) {
  const auto& segments = both().gpu.segments;
  ASSERT_EQ(segments.size(), both().cpu.strand_count() * (k_vertices - 1));
  for (std::size_t k = 0; k < segments.size(); ++k)
    ASSERT_EQ(segments[k], k / (k_vertices - 1) * k_vertices + k % (k_vertices - 1));
}

TEST(StrandGenerator, TwoPasses_AreOneDispatchEach) {
  const auto& passes = both().gpu.cost.passes;
  ASSERT_EQ(passes.size(), 2u);
  EXPECT_EQ(passes[0].name, "smooth_strands");
  EXPECT_EQ(passes[1].name, "interpolate_strands");
  EXPECT_EQ(passes[0].dispatches, 1u);
  EXPECT_EQ(passes[1].dispatches, 1u);
}

TEST(StrandGenerator, NoDrawnStrands_GenerateNothing) {
  const Generated none = generate(control_hairs(), {});
  EXPECT_TRUE(none.vertices.empty());
}

TEST(StrandGenerator, MoreVerticesThanOneRowOfWorkgroups_AreAllGenerated) {
  const Groom control = control_hairs();
  const std::uint32_t strands = 2120000;  // of two vertices, a thread each: past 32,768 groups of 64
  Drawn many;
  many.weights.assign(strands, {0.5f, 0.25f, 0.25f});
  for (std::uint32_t s = 0; s < strands; ++s) many.hairs.push_back({s % 3, (s + 1) % 3, 2});
  const Generated gpu = generate(control, many, 2);
  const std::size_t last = 2 * (strands - 1), same = 2 * ((strands - 1) % 3);
  for (std::size_t i = 0; i < 2; ++i) ASSERT_EQ(gpu.vertices[last + i], gpu.vertices[same + i]);
}

TEST(StrandGenerator, HairThatIsNotThere_IsRefusedNamingStrandAndRange) {
  const Groom control = control_hairs();
  Drawn drawn;
  drawn.add({0, 1, 8}, {1, 0, 0});
  const auto generator = StrandGenerator::create(device().shared_from_this(),
                                                 {.control = &control, .hairs = drawn.hairs, .weights = drawn.weights});
  ASSERT_FALSE(generator.ok());
  EXPECT_EQ(generator.error().message, "drawn strand 0: control hair 8 of 0..7");
}

/// Drawn vertices' velocities, from control vertices that move as told.
std::vector<glm::vec4> velocities_of(const Groom& control, const Drawn& drawn, const std::vector<glm::vec4>& motion,
                                     float since) {
  auto generator = *StrandGenerator::create(device().shared_from_this(), {.control = &control,
                                                                          .vertices_per_strand = k_vertices,
                                                                          .hairs = drawn.hairs,
                                                                          .weights = drawn.weights,
                                                                          .moves = true});
  const std::vector<glm::vec4> positions = padded(control);
  const gpu::Buffer controls = *gpu::make_buffer_from<glm::vec4>(device(), positions),
                    moving = *gpu::make_buffer_from<glm::vec4>(device(), motion);
  gpu::Commands commands = device().record();
  EXPECT_TRUE(generator->record_velocities(commands, controls, {&moving, since}).ok());
  const auto cost = device().submit(std::move(commands));
  EXPECT_TRUE(cost.ok()) << (cost ? "" : cost.error().message);
  return *gpu::read_buffer<glm::vec4>(device(), generator->velocities(), generator->vertex_count());
}

// Control vertices that move apart, so that curves bend; the hair in one place, whose curve has no direction, is left
// out.
TEST(StrandGenerator, Velocities_AreTheDifferenceOfPositionsByTime) {
  const Groom now = control_hairs();
  Groom before = now;
  std::vector<glm::vec4> velocities;
  constexpr float k_since = 2e-3f;
  for (std::size_t v = 0; v < now.vertex_count(); ++v) {
    const float k = float(v);
    velocities.emplace_back(0.3f * std::sin(k), 0.5f * std::cos(2 * k), -0.4f + 0.2f * std::sin(3 * k), 0);
    before.positions[v] -= k_since * glm::vec3(velocities.back());
  }
  const Drawn drawn = drawn_on(std::uint32_t(now.strand_count()));
  const Generated a = generate(before, drawn), b = generate(now, drawn);
  const std::vector<glm::vec4> handed_over = velocities_of(now, drawn, velocities, 0),
                               measured = velocities_of(now, drawn, padded(before), k_since);
  float off = 0, off_measured = 0;
  for (std::size_t v = 0; v < b.vertices.size(); ++v) {
    const auto& hairs = drawn.hairs[v / k_vertices];
    if (std::ranges::find(hairs, 5u) != hairs.end()) continue;
    const glm::vec3 expected = glm::vec3(b.vertices[v] - a.vertices[v]) / k_since;
    off = larger(off, glm::length(glm::vec3(handed_over[v]) - expected));
    off_measured = larger(off_measured, glm::length(glm::vec3(measured[v]) - expected));
  }
  fmt::print("off by {:.4f} m/s along velocities, {:.5f} since then, of up to .7\n", off, off_measured);
  EXPECT_LT(off, 7e-3f);
  EXPECT_LT(off_measured, 7e-4f);
}

TEST(StrandGenerator, ControlHairsWithNaN_AreRefused) {
  Groom control = control_hairs();
  const Drawn drawn = drawn_on(std::uint32_t(control.strand_count()));
  control.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  const auto generator = StrandGenerator::create(device().shared_from_this(),
                                                 {.control = &control, .hairs = drawn.hairs, .weights = drawn.weights});
  ASSERT_FALSE(generator.ok());
  EXPECT_EQ(generator.error().kind, ErrorKind::bad_input);
  EXPECT_NE(generator.error().message.find("control hairs: "), std::string::npos);
}

TEST(StrandGenerator, VerticesPastTheLargestBufferOfTexels_AreRefusedNamingTheLimit) {
  const Groom control = control_hairs();
  const std::uint64_t limit = device().info().max_texel_buffer_bytes;
  if (limit > std::uint64_t(1) << 32) GTEST_SKIP() << "the limit is too large to reach in a test";
  const std::size_t count = std::size_t(limit / (16 * 64)) + 1;
  const std::vector<std::array<std::uint32_t, 3>> hairs(count);
  const std::vector<glm::vec3> weights(count, glm::vec3(1, 0, 0));
  const auto generator =
      StrandGenerator::create(device().shared_from_this(),
                              {.control = &control, .vertices_per_strand = 64, .hairs = hairs, .weights = weights});
  ASSERT_FALSE(generator.ok());
  EXPECT_EQ(generator.error().kind, ErrorKind::out_of_memory);
  EXPECT_NE(generator.error().message.find(std::to_string(limit)), std::string::npos);
}

}  // namespace
}  // namespace cuticle::strands::strand_generator_test
