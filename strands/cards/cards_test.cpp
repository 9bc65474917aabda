// Cards of small grooms with a known answer, their textures beside random points, their order beside brute force.
#include "strands/cards/hair_cards.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "core/random.h"
#include "strands/cards/k_means.h"
#include "strands/cards/occlusion.h"
#include "strands/formats/formats.h"
#include "tests/support/temporary_folder.h"

namespace cuticle::strands::cards_test {
namespace {

CardParameters settings(std::initializer_list<std::pair<const char*, registry::Value>> changes) {
  registry::ParameterValues values = registry::to_values(CardParameters());
  values.set("texture_width", std::int64_t(32));
  values.set("texture_height", std::int64_t(64));
  for (const auto& [name, value] : changes) values.set(name, value);
  return registry::from_values<CardParameters>(values);
}

void add_strand(Groom& groom, std::span<const glm::vec3> points, float radius) {
  groom.positions.insert(groom.positions.end(), points.begin(), points.end());
  groom.radii.resize(groom.positions.size(), radius);
  groom.offsets.push_back(std::uint32_t(groom.positions.size()));
}

float number(RandomStream& random, float least, float most) {
  return least + (most - least) * float(random.next_unit());
}

/// Strands that hang from patches 4 cm wide and 4 mm deep around a head at the origin, 20 cm long and bent inward.
Groom locks(int patches, int strands) {
  Groom groom;
  RandomStream random(3);
  for (int p = 0; p < patches; ++p) {
    const float turn = 6.2831853f * float(p) / float(patches);
    const glm::vec3 out(std::cos(turn), 0, std::sin(turn)), side(-out.z, 0, out.x);
    for (int s = 0; s < strands; ++s) {
      const glm::vec3 root = 0.1f * out + side * number(random, -0.02f, 0.02f) + out * number(random, -0.002f, 0.002f);
      std::vector<glm::vec3> points;
      for (int k = 0; k < 9; ++k) {
        const float down = 0.025f * float(k);
        points.push_back(root - glm::vec3(0, down, 0) - out * (0.5f * down * down));
      }
      add_strand(groom, points, 1e-4f);
    }
  }
  return groom;
}

CardSet cards_of(const Groom& groom, const CardParameters& values) {
  auto made = make_cards(groom, body_of_roots(groom), values);
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return std::move(*made);
}

TEST(Cards, LocksApart_AreOneCardEachInLayersFacingAwayFromTheHead) {
  const Groom groom = locks(8, 40);
  const CardSet set = cards_of(groom, settings({{"cards", std::int64_t(16)}, {"iterations", std::int64_t(20)}}));
  ASSERT_EQ(set.cards.size(), 16u);
  std::set<std::uint32_t> seen;
  for (const Card& card : set.cards) {
    EXPECT_EQ(card.members.size(), 20u);
    for (std::uint32_t s : card.members) {
      EXPECT_EQ(s / 40, card.members[0] / 40) << "strands of one lock";
      EXPECT_TRUE(seen.insert(s).second) << "a strand belongs to one card";
    }
    EXPECT_NEAR(card.length, strand_length(groom, card.members[0]), 1e-4);
    for (std::uint32_t r = 0; r < card.row_count; ++r) {
      const CardRow& row = set.rows[card.first_row + r];
      const glm::vec3 out = glm::normalize(glm::vec3(row.middle.x, 0, row.middle.z));
      EXPECT_GT(glm::dot(row.normal(), out), 0.95f);
      EXPECT_NEAR(glm::dot(row.across, row.tangent), 0, 1e-5f);
      EXPECT_NEAR(2 * row.half_width, 0.036f, 0.006f);
    }
  }
  EXPECT_EQ(seen.size(), groom.strand_count());
  for (std::size_t c = 0; c < set.cards.size(); c += 2) {
    ASSERT_EQ(set.cards[c].cluster, set.cards[c + 1].cluster);
    const auto from_axis = [&](const Card& card) {
      const glm::vec3& root = set.rows[card.first_row].middle;
      return std::hypot(root.x, root.z);
    };
    EXPECT_LT(from_axis(set.cards[c]), from_axis(set.cards[c + 1])) << "the outer layer";
  }
  // Strands lie up to a millimetre from the middle of their layer, and 5 % of them beyond the width.
  EXPECT_LT(set.error.distance, 0.0015);
  EXPECT_LT(set.error.outside, 0.08);
}

TEST(Cards, EqualSeeds_GiveEqualCards) {
  const Groom groom = locks(6, 30);
  const auto rows = [&](std::int64_t seed) {
    std::vector<float> numbers;
    for (const CardRow& row : cards_of(groom, settings({{"cards", std::int64_t(20)}, {"seed", seed}})).rows)
      numbers.insert(numbers.end(), {row.middle.x, row.middle.y, row.middle.z, row.half_width});
    return numbers;
  };
  EXPECT_EQ(rows(1), rows(1));
  EXPECT_NE(rows(1), rows(2));
}

TEST(Cards, BadGrooms_AreRefusedByName) {
  const CardParameters defaults = settings({});
  const auto message = [&](const Groom& groom, const CardParameters& values) {
    const auto made = make_cards(groom, {}, values);
    EXPECT_FALSE(made);
    return made ? std::string() : made.error().message;
  };
  EXPECT_NE(message({}, defaults).find("0 strands"), std::string::npos);
  Groom groom = locks(2, 3);
  EXPECT_NE(message(groom, settings({{"cards", std::int64_t(0)}})).find("cards = 0"), std::string::npos);
  Groom single = groom;
  add_strand(single, std::vector{glm::vec3(0)}, 1e-4f);
  EXPECT_NE(message(single, defaults).find("strand 6 has 1 vertices"), std::string::npos);
  Groom point = groom;
  add_strand(point, std::vector(3, glm::vec3(1)), 1e-4f);
  EXPECT_NE(message(point, defaults).find("strand 6 has length 0"), std::string::npos);
  Groom infinite = groom;
  infinite.radii[11] = std::numeric_limits<float>::infinity();
  EXPECT_NE(message(infinite, defaults).find("strand 1: vertex 2"), std::string::npos);
  groom.positions[12].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(message(groom, defaults).find("strand 1: vertex 3"), std::string::npos);
  EXPECT_FALSE(registry::parse_assignments(registry::table_of<CardParameters>(), "cards=0"));
}

TEST(Clusters, PointsApart_AreToldApart) {
  std::vector<float> values;
  RandomStream random(5);
  for (int k = 0; k < 90; ++k) {
    values.push_back(10 * float(k % 3) + number(random, -1, 1));
    values.push_back(number(random, -1, 1));
  }
  const Clusters clusters = k_means(values, 2, 3, 10, 1);
  ASSERT_EQ(clusters.count, 3u);
  for (std::size_t k = 3; k < 90; ++k) EXPECT_EQ(clusters.of[k], clusters.of[k % 3]);
  EXPECT_EQ(k_means(std::vector<float>(20, 1.0f), 2, 4, 3, 1).count, 1u) << "equal points are one cluster";
}

/// Straight strands with a slant over a card 10 cm long, 2 cm wide.
Groom slanted(int strands) {
  Groom groom;
  RandomStream random(11);
  for (int s = 0; s < strands; ++s) {
    const float x = number(random, -0.01f, 0.01f), slant = number(random, -0.004f, 0.004f);
    std::vector<glm::vec3> points;
    for (int k = 0; k < 5; ++k) points.emplace_back(x + slant * float(k - 2), -0.025f * float(k), 0.1f);
    add_strand(groom, points, number(random, 1e-4f, 6e-4f));
  }
  return groom;
}

float distance_to(const glm::vec2& point, const glm::vec2& a, const glm::vec2& b) {
  const glm::vec2 along = b - a;
  const float share = std::clamp(glm::dot(point - a, along) / glm::dot(along, along), 0.0f, 1.0f);
  return glm::distance(point, a + share * along);
}

/// Share of a card 2 cm wide along x and 10 cm long along y that strands cover, by random points.
double covered_by_points(const Groom& groom, double middle, float width) {
  RandomStream random(23);
  constexpr int k_points = 60000;
  int hits = 0;
  for (int p = 0; p < k_points; ++p) {
    const glm::vec2 point(middle + double(number(random, -0.01f, 0.01f)), number(random, -0.1f, 0));
    const auto covers = [&](std::size_t s) {
      const glm::vec3 a = groom.strand(s).front(), b = groom.strand(s).back();
      return distance_to(point, glm::vec2(a), glm::vec2(b)) < width * groom.radii[groom.offsets[s]];
    };
    bool hit = false;
    for (std::size_t s = 0; s < groom.strand_count() && !hit; ++s) hit = covers(s);
    hits += hit ? 1 : 0;
  }
  return double(hits) / k_points;
}

TEST(CardTextures, MeanAlpha_IsTheCoverageOfTheStrands) {
  const Groom groom = slanted(14);
  const auto values =
      settings({{"cards", std::int64_t(1)}, {"layers", std::int64_t(1)}, {"width", 0.02}, {"fill", 0.0}});
  auto made = make_cards(groom, CardBody{{0, -0.05f, 0}}, values);
  ASSERT_TRUE(made);
  const CardTextures textures = bake_textures(groom, *made, values);
  ASSERT_EQ(textures.kinds.size(), 1u);
  const double truth = covered_by_points(groom, double(made->rows[0].middle.x), 1);
  std::printf("coverage %.4f, of random points %.4f\n", textures.kinds[0].alpha, truth);
  EXPECT_NEAR(textures.kinds[0].alpha, truth, 0.005);
  EXPECT_EQ(textures.kinds[0].alpha, textures.kinds[0].coverage);
  double sum = 0;
  for (int y = 0; y < textures.height; ++y)
    for (int x = 0; x < textures.width; ++x) sum += double(textures.atlas.at(x, y, 3));
  EXPECT_NEAR(sum / (textures.height * (textures.width - 2)), textures.kinds[0].alpha, 1e-6);
}

TEST(CardTextures, Fill_WidensStrandsUntilTheyCoverItWithOpaqueParts) {
  const Groom groom = slanted(14);
  const auto values =
      settings({{"cards", std::int64_t(1)}, {"layers", std::int64_t(1)}, {"width", 0.02}, {"fill", 0.8}});
  auto made = make_cards(groom, CardBody{{0, -0.05f, 0}}, values);
  ASSERT_TRUE(made);
  const CardKind kind = bake_textures(groom, *made, values).kinds[0];
  EXPECT_NEAR(kind.alpha, 0.8, 0.003);
  EXPECT_NEAR(covered_by_points(groom, double(made->rows[0].middle.x), float(kind.strand_width)), 0.8, 0.01);
  EXPECT_LT(kind.coverage, kind.alpha);
  EXPECT_GT(kind.opaque, 0.4);
}

TEST(CardTextures, Noise_IsStretchedAlongTheStrands) {
  const Groom groom = slanted(14);
  const auto values = settings({{"cards", std::int64_t(1)}, {"layers", std::int64_t(1)}, {"width", 0.02}});
  auto made = make_cards(groom, CardBody{{0, -0.05f, 0}}, values);
  ASSERT_TRUE(made);
  const Image atlas = bake_textures(groom, *made, values).atlas;
  for (int channel : {0, 1}) {
    double along = 0, across = 0, least = 1, most = 0;
    for (int y = 1; y < atlas.height; ++y)
      for (int x = 2; x < atlas.width - 1; ++x) {
        along += double(std::abs(atlas.at(x, y, channel) - atlas.at(x, y - 1, channel)));
        across += double(std::abs(atlas.at(x, y, channel) - atlas.at(x - 1, y, channel)));
        least = std::min(least, double(atlas.at(x, y, channel)));
        most = std::max(most, double(atlas.at(x, y, channel)));
      }
    // Per metre: a card of 2 cm x 10 cm.
    EXPECT_GT(across * (atlas.width - 2) / 0.02, 4 * along * atlas.height / 0.1)
        << atlas.channel_names[std::size_t(channel)];
    EXPECT_GE(least, channel == 0 ? 0.5 : 0.35);
    EXPECT_LE(most, channel == 0 ? 1.0 : 0.65);
    EXPECT_GT(most - least, 0.15);
  }
}

/// Triangles that share vertices, by repeated passes over all pairs' labels.
std::vector<std::uint32_t> labels_by_brute_force(const Mesh& mesh) {
  std::vector<std::uint32_t> label(mesh.positions.size());
  for (std::uint32_t v = 0; v < label.size(); ++v) label[v] = v;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t least = std::min({label[a], label[b], label[c]});
      for (std::uint32_t v : {a, b, c}) {
        changed = changed || label[v] != least;
        label[v] = least;
      }
    }
  }
  return label;
}

/// By area, of the triangles of a label from the vertical axis; all of them lie below the head's middle.
double mean_distance(const Mesh& mesh, std::span<const std::uint32_t> label, std::uint32_t own) {
  double sum = 0, areas = 0;
  for (const auto& t : mesh.triangles) {
    if (label[t[0]] != own) continue;
    const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    const double area = glm::length(glm::cross(b - a, c - a));
    sum += area * std::hypot((a + b + c).x / 3, (a + b + c).z / 3);
    areas += area;
  }
  return sum / areas;
}

// The list is mixed first: patches come out whole and rising in their distance from the head.
TEST(CardOrder, MixedTriangles_BecomeWholePatchesFromTheInsideOut) {
  const Groom groom = locks(8, 40);
  CardSet set = cards_of(groom, settings({{"cards", std::int64_t(32)}, {"layers", std::int64_t(4)}}));
  CardMesh made = make_card_mesh(set, bake_textures(groom, set, settings({})), body_of_roots(groom), 0);
  std::ranges::sort(made.mesh.triangles, {}, [](const auto& t) { return (t[0] * 2654435761u) >> 7; });
  const Mesh mixed = made.mesh;
  const auto components = sort_inside_to_outside(made.mesh, glm::vec3(0));
  const std::vector<std::uint32_t> label = labels_by_brute_force(mixed);
  EXPECT_EQ(components.size(), std::set(label.begin(), label.end()).size());
  double last = 0;
  std::uint32_t next = 0;
  for (const MeshComponent& component : components) {
    EXPECT_EQ(component.first_triangle, next);
    next += component.triangle_count;
    const std::uint32_t own = label[made.mesh.triangles[component.first_triangle][0]];
    EXPECT_EQ(component.triangle_count,
              std::ranges::count_if(mixed.triangles, [&](const auto& t) { return label[t[0]] == own; }));
    const double outside = mean_distance(mixed, label, own);
    EXPECT_NEAR(outside, double(component.outside), 1e-6);
    EXPECT_GE(outside, last - 1e-7);
    last = outside;
  }
  EXPECT_EQ(next, mixed.triangles.size());
}

// A ray from outside meets the patches of a lock in the reverse of the order in which they are drawn.
TEST(CardOrder, LayersOfALock_AreDrawnFromTheHeadOutward) {
  const Groom groom = locks(8, 40);
  CardSet set = cards_of(groom, settings({{"cards", std::int64_t(32)}, {"layers", std::int64_t(4)}}));
  const CardMesh made = make_card_mesh(set, bake_textures(groom, set, settings({})), body_of_roots(groom), 0);
  std::map<std::uint32_t, std::uint32_t> layers_drawn;
  for (const CardPart& part : made.parts) {
    const Card& card = set.cards[part.card];
    EXPECT_EQ(layers_drawn[card.cluster]++, card.layer);
  }
}

TEST(CardOrder, CardsThatHangFree_AreCutIntoSwingingGroups) {
  // Two tails, left and right, that leave the head at 0.1 m.
  Groom groom;
  RandomStream random(9);
  for (int s = 0; s < 60; ++s) {
    const float side = s % 2 == 0 ? 1.0f : -1.0f, x = number(random, -0.01f, 0.01f), z = number(random, -0.01f, 0.01f);
    std::vector<glm::vec3> points;
    for (int k = 0; k < 11; ++k) points.emplace_back(side * (0.05f + 0.03f * float(k)) + x, 0, z);
    add_strand(groom, points, 1e-4f);
  }
  CardSet set = cards_of(groom, settings({{"cards", std::int64_t(8)}}));
  const CardMesh made = make_card_mesh(set, bake_textures(groom, set, settings({})), {}, 0.15);
  EXPECT_EQ(made.parts.size(), 2 * set.cards.size());
  std::map<std::pair<std::uint32_t, bool>, int> parts;
  for (const CardPart& part : made.parts) {
    const glm::vec3 first = made.rows[part.first_row].middle,
                    last = made.rows[part.first_row + part.row_count - 1].middle;
    ++parts[{part.group, first.x > 0}];
    EXPECT_GE(part.row_count, 2u);
    EXPECT_EQ(part.triangle_count, 2 * (part.row_count - 1));
    EXPECT_EQ(part.group == 0, std::abs(last.x) < 0.16f);
  }
  const std::map<std::pair<std::uint32_t, bool>, int> expected = {
      {{0, false}, 4}, {{0, true}, 4}, {{1, parts.contains({1, true})}, 4}, {{2, parts.contains({2, true})}, 4}};
  EXPECT_EQ(parts, expected) << "each tail is a group of its own";
}

/// The integral of exp(-tau / c) 2 c over c in 0 .. 1: 2 E3(tau), midpoints.
double open_under_slab(double tau) {
  double sum = 0;
  for (int k = 0; k < 20000; ++k) {
    const double c = (k + 0.5) / 20000;
    sum += 2 * c * std::exp(-tau / c) / 20000;
  }
  return sum;
}

// Short fibres in all directions at random fill a slab one cell of 1/64 thick fits into many times.
TEST(Occlusion, SlabOfFibres_IsAsOpenAsTheClosedForm) {
  Groom groom;
  RandomStream random(31);
  constexpr float k_width = 1, k_depth = 0.1f, k_length = 0.02f, k_radius = 1e-4f;
  constexpr int k_count = 60000;
  for (int s = 0; s < k_count; ++s) {
    const float z = number(random, -1, 1), turn = number(random, 0, 6.2831853f), flat = std::sqrt(1 - z * z);
    const glm::vec3 along = 0.5f * k_length * glm::vec3(flat * std::cos(turn), flat * std::sin(turn), z);
    const glm::vec3 middle(number(random, -0.5f, 0.5f), number(random, 0, k_depth), number(random, -0.5f, 0.5f));
    add_strand(groom, std::vector{middle - along, middle + along}, k_radius);
  }
  const double tau = k_count * double(k_length * k_radius / (k_width * k_width)) * 3.14159265 / 2;  // through all
  const std::vector<glm::vec3> points = {{0, 0, 0}, {0, 0.5f * k_depth, 0}, {0, 1.2f * k_depth, 0}, {0, -0.02f, 0}},
                               up(4, glm::vec3(0, 1, 0));
  const std::vector<float> open = ambient_occlusion(groom, nullptr, points, up, 256);
  std::printf("optical depth %.3f: open %.4f of %.4f below, %.4f of %.4f in the middle\n", tau, double(open[0]),
              open_under_slab(tau), double(open[1]), open_under_slab(0.5 * tau));
  EXPECT_NEAR(double(open[0]), open_under_slab(tau), 0.015);
  EXPECT_NEAR(double(open[1]), open_under_slab(0.5 * tau), 0.015);
  EXPECT_EQ(open[2], 1);
  EXPECT_NEAR(double(open[3]), open_under_slab(tau), 0.015) << "from outside the cells";
  const Mesh roof{{{-2, 0.08f, -2}, {2, 0.08f, -2}, {0, 0.08f, 2}}, {}, {}, {{0, 1, 2}}};
  EXPECT_LT(ambient_occlusion(groom, &roof, points, up, 64)[0], 0.05f);
}

using CardFolder = tests::TemporaryFolder;

TEST_F(CardFolder, Written_HoldMeshAndTextures) {
  const Groom groom = locks(4, 20);
  auto made = make_hair_cards(groom, nullptr, settings({{"cards", std::int64_t(8)}}));
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->occlusion.size(), made->mesh.mesh.positions.size());
  ASSERT_TRUE(write_cards(folder_.string(), *made));
  const Mesh& mesh = made->mesh.mesh;
  const auto read = read_obj(path("cards.obj"), 1);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->triangles.size(), mesh.triangles.size());
  const auto corner = [](const Mesh& m, std::size_t t) { return m.positions[m.triangles[t][1]]; };
  for (std::size_t t = 0; t < read->triangles.size(); t += 7)
    EXPECT_LT(glm::distance(corner(*read, t), corner(mesh, t)), 1e-6f) << "in the static order";
  const auto alpha = read_image(path("alpha.png"));
  ASSERT_TRUE(alpha) << alpha.error().message;
  double sum = 0;
  for (float value : alpha->pixels) sum += double(value);
  double expected = 0;
  for (const CardKind& kind : made->textures.kinds)
    expected += kind.alpha * (made->textures.width - 2) * made->textures.height;
  EXPECT_NEAR(sum / double(alpha->pixels.size()),
              expected / (double(made->textures.atlas.width) * made->textures.atlas.height), 2e-3);
}

}  // namespace
}  // namespace cuticle::strands::cards_test
