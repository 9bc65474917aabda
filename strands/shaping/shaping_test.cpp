// H9: each effect does what its name says, leaves roots in place, is seeded, and does not run unless it is named.
#include <cmath>

#include <gtest/gtest.h>

#include "strands/shaping/shaping.h"
#include "tests/support/synthetic_grooms.h"
#include <glm/geometric.hpp>

namespace cuticle::strands::shaping_test {
namespace {

/// `count` straight strands of 101 vertices and 0.2 m along +y, in a row 1 mm apart.
Groom row(int count) {
  Groom groom;
  for (int s = 0; s < count; ++s) {
    for (int v = 0; v <= 100; ++v) groom.positions.emplace_back(0.001f * float(s), 0.002f * float(v), 0);
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), 4e-5f);
  return groom;
}

struct Effect {
  const char *name, *settings;
};

Groom shaped(Groom groom, std::initializer_list<Effect> effects, std::uint64_t seed = 1) {
  ShapingBlocks blocks;
  for (const Effect& effect : effects)
    blocks[effect.name] =
        registry::parse_assignments((*find_shaping(effect.name))->entry.parameters, effect.settings).value();
  shape(groom, blocks, {}, seed);
  return groom;
}

/// Distance of a vertex of a row from where it stood, across the strand.
double off_line(const Groom& groom, std::size_t strand, std::size_t vertex) {
  const glm::vec3 p = groom.strand(strand)[vertex];
  return std::hypot(double(p.x) - 0.001 * double(strand), double(p.z));
}

TEST(Shaping, NothingNamed_NothingChanges) { EXPECT_EQ(shaped(row(3), {}), row(3)); }

TEST(Shaping, EveryEffect_KeepsRootsIsFiniteAndSeeded) {
  ASSERT_GE(shapings().size(), 7u);
  for (const Shaping* shaping : shapings()) {
    const Effect effect{shaping->entry.name.data(), ""};
    const Groom groom = shaped(row(60), {effect});
    ASSERT_TRUE(validate(groom).ok()) << effect.name;
    for (std::size_t s = 0; s < 60; ++s) ASSERT_EQ(groom.strand(s)[0], row(60).strand(s)[0]) << effect.name;
    EXPECT_NE(groom, row(60)) << effect.name;
    EXPECT_EQ(groom, shaped(row(60), {effect})) << effect.name;
    const bool is_seeded = shaping->entry.name != "volume";
    EXPECT_EQ(groom != shaped(row(60), {effect}, 2), is_seeded) << effect.name;
  }
}

TEST(Shaping, EveryEffect_DegenerateStrandsStayFinite) {
  Groom groom;
  tests::add_strand(groom, {{0, 0, 0}}, 1e-5f);
  tests::add_strand(groom, {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}, 1e-5f);
  tests::add_strand(groom, {{2, 0, 0}, {2, 1, 0}, {2, 0, 0}, {2, 2, 0}}, 1e-5f);
  for (const Shaping* shaping : shapings())
    EXPECT_TRUE(validate(shaped(groom, {{shaping->entry.name.data(), ""}})).ok()) << shaping->entry.name;
}

TEST(Shaping, UnknownName_IsRefusedWithTheNearest) {
  const auto found = find_shaping("wavyness");
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().hint.find("waviness"), std::string::npos);
}

TEST(Curl, Strand_WindsWithItsRadiusAndPitch) {
  const Groom groom = shaped(row(1), {{"curl", "radius=0.005,pitch=0.02,onset=0.01,variation=0,frizz=0"}});
  for (std::size_t v = 6; v <= 100; ++v) EXPECT_NEAR(off_line(groom, 0, v), 0.005, 1e-6) << v;
  // One pitch, ten vertices, further it stands over the same place.
  for (std::size_t v = 10; v <= 90; ++v) {
    const glm::vec3 apart = groom.strand(0)[v + 10] - groom.strand(0)[v];
    EXPECT_LT(glm::distance(apart, glm::vec3(0, 0.02f, 0)), 2e-6f) << v;
  }
  const double winding = std::hypot(1.0, 2 * std::acos(-1.0) * 0.005 / 0.02);
  EXPECT_NEAR(strand_length(groom, 0) / 0.2, winding, 0.1);
}

TEST(Waviness, Strand_StaysInOnePlaneAndWithinItsAmplitude) {
  const Groom groom = shaped(row(1), {{"waviness", "amplitude=0.004,wavelength=0.05,onset=0,variation=0"}});
  const glm::vec3 across = groom.strand(0)[7] - row(1).strand(0)[7];
  double highest = 0;
  for (std::size_t v = 1; v <= 100; ++v) {
    const glm::vec3 offset = groom.strand(0)[v] - row(1).strand(0)[v];
    EXPECT_LT(glm::length(glm::cross(offset, across)), 1e-9f) << v;
    highest = std::max(highest, double(glm::length(offset)));
  }
  EXPECT_NEAR(highest, 0.004, 4e-5);
}

TEST(Clumping, FullStrength_TipsMeetTheirLeaders) {
  const Groom groom = shaped(row(200), {{"clumping", "strands_per_lock=20,strength=1"}});
  std::size_t groups = 1;
  for (std::size_t s = 1; s < 200; ++s) groups += groom.strand(s).back() != groom.strand(s - 1).back();
  EXPECT_NEAR(double(groups), 10, 8);  // leaders are drawn by chance: about one in twenty
  EXPECT_LT(glm::distance(groom.strand(0)[1], row(200).strand(0)[1]), 0.001f);
}

TEST(Clumping, CurlOfALock_MovesAllItsStrandsAlike) {
  const Groom groom = shaped(row(50), {{"clumping", "strands_per_lock=1000,strength=0"}, {"curl", "frizz=0"}});
  // Without a leader by chance every strand leads itself; with one, all of the lock share a helix.
  const Groom locks = shaped(row(400), {{"clumping", "strands_per_lock=100,strength=0"}, {"curl", "frizz=0"}});
  std::size_t alike = 0;
  for (std::size_t s = 1; s < 400; ++s) {
    const glm::vec3 a = locks.strand(s)[60] - row(400).strand(s)[60],
                    b = locks.strand(s - 1)[60] - row(400).strand(s - 1)[60];
    alike += glm::distance(a, b) < 1e-6f;
  }
  EXPECT_GT(alike, 380u);
  EXPECT_TRUE(validate(groom).ok());
}

TEST(Volume, LiftsAlongTheRootNormal) {
  Groom groom = row(1);
  ShapingBlocks blocks;
  blocks["volume"] =
      registry::parse_assignments((*find_shaping("volume"))->entry.parameters, "lift=0.01,onset=0.02").value();
  const std::vector<glm::vec3> normals{{0, 0, 1}};
  shape(groom, blocks, normals, 1);
  EXPECT_NEAR(double(groom.strand(0)[50].z), 0.01, 1e-7);
  EXPECT_LT(groom.strand(0)[2].z, 0.002f);
}

TEST(Stray, Share_OfTheStrandsLeaves) {
  const Groom groom = shaped(row(1000), {{"stray", "share=0.2,reach=0.05"}});
  int strayed = 0;
  for (std::size_t s = 0; s < 1000; ++s) {
    strayed += off_line(groom, s, 100) > 1e-7;
    EXPECT_LE(off_line(groom, s, 100), 0.05 + 1e-6);
  }
  EXPECT_NEAR(strayed, 200, 4 * std::sqrt(1000 * 0.2 * 0.8));
}

TEST(Texture, EachStrandOnItsOwn_WithinItsAmplitude) {
  const Groom groom = shaped(row(2), {{"texture", "amplitude=0.001"}});
  double apart = 0;
  for (std::size_t v = 1; v <= 100; ++v) {
    EXPECT_LE(off_line(groom, 0, v), 0.001 * std::sqrt(2.0) + 1e-7);
    apart = std::max(apart, std::abs(off_line(groom, 0, v) - off_line(groom, 1, v)));
  }
  EXPECT_GT(apart, 2e-4);
}

TEST(Cut, LengthsSpreadOverTheVariation) {
  const Groom groom = shaped(row(500), {{"cut", "variation=0.5"}});
  double mean = 0, least = 1;
  for (std::size_t s = 0; s < 500; ++s) {
    mean += strand_length(groom, s) / 500;
    least = std::min(least, strand_length(groom, s));
  }
  EXPECT_NEAR(mean, 0.15, 4 * 0.1 / std::sqrt(12.0 * 500));
  EXPECT_GE(least, 0.1 - 1e-6);
  EXPECT_LT(least, 0.102);
}

}  // namespace
}  // namespace cuticle::strands::shaping_test
