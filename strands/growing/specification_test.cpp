// H18: the grooming specification, what it refuses, and the hair that regions, strokes, cuts and buns make.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include "core/file.h"
#include "strands/growing/grow.h"

namespace cuticle::strands::specification_test {
namespace {

using testing::HasSubstr;

GroomingSpecification specified(const std::string& fields) {
  const auto read = parse_specification(R"({"schema_version": 1, )" + fields + "}", "test");
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  return read ? *read : GroomingSpecification();
}

void expect_refused(const std::string& text, std::initializer_list<const char*> words) {
  const auto read = parse_specification(text, "spec.json");
  ASSERT_FALSE(read) << text;
  EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
  for (const char* word : words) EXPECT_THAT(read.error().message + " " + read.error().hint, HasSubstr(word));
}

TEST(Specification, Empty_IsTheDefaults) {
  const auto spec = specified(R"("name": "plain")");
  EXPECT_EQ(spec.name, "plain");
  EXPECT_EQ(registry::to_values(spec.growing), registry::to_values(Style()));
  EXPECT_TRUE(spec.shaping.empty());
  EXPECT_FALSE(spec.grooming.bun);
}

/// Share of the drawn roots whose distance from the scalp's edge is less than a centimetre.
double share_at_the_edge(const Grown& grown) {
  std::size_t near = 0;
  for (std::size_t s = 0; s < grown.drawn.strand_count(); ++s) {
    const glm::vec3 root = grown.drawn.strand(s)[0];
    for (std::size_t v = 0; v < grown.head.scalp.positions.size(); ++v)
      if (glm::distance(grown.head.scalp.uv[v], glm::vec2(0.5f)) > 0.499f &&
          glm::distance(grown.head.scalp.positions[v], root) < 0.01f) {
        ++near;
        break;
      }
  }
  return double(near) / double(grown.drawn.strand_count());
}

TEST(Specification, Hairline_ThinsTheScalpsEdge) {
  const auto even = grow(specified(R"("strands": {"density": 40000})"));
  const auto thin = grow(specified(R"("strands": {"density": 40000, "hairline": 0.15})"));
  ASSERT_TRUE(even && thin);
  EXPECT_LT(share_at_the_edge(*thin), 0.7 * share_at_the_edge(*even));
}

TEST(Specification, WhatItRefuses_IsNamed) {
  expect_refused("[", {"spec.json", "JSON"});
  expect_refused("[]", {"object"});
  expect_refused("{}", {"schema_version", "1"});
  expect_refused(R"({"schema_version": 1, "groing": {}})", {"groing", "growing"});
  expect_refused(R"({"schema_version": 1, "growing": {"lenght": 1}})", {"lenght", "length"});
  expect_refused(R"({"schema_version": 1, "growing": {"length": 9}})", {"length", "9", "2 m"});
  expect_refused(R"({"schema_version": 1, "strands": {"density": NaN}})", {"JSON"});
  expect_refused(R"({"schema_version": 1, "strands": {"roots": "fold"}})", {"roots", "fold", "folded"});
  expect_refused(R"({"schema_version": 1, "shaping": {"curls": {}}})", {"curls", "curl"});
  expect_refused(R"({"schema_version": 1, "shaping": {"curl": {"radius": "wide"}}})", {"curl", "radius"});
  expect_refused(R"({"schema_version": 1, "regions": {}})", {"regions", "list"});
  expect_refused(R"({"schema_version": 1, "strokes": [{"direction": [1, 2]}]})", {"strokes[0]", "direction"});
  expect_refused(R"({"schema_version": 1, "name": 3})", {"name"});
}

TEST(Specification, Schema_IsThePublishedOne) {
  const auto text = read_text_file(CUTICLE_SOURCE_DIR "/docs/grooming.schema.json");
  ASSERT_TRUE(text);
  EXPECT_TRUE(*text == specification_schema()) << "run: cuticle grow --schema > docs/grooming.schema.json";
}

TEST(Specification, Presets_AllAreRead) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(CUTICLE_SOURCE_DIR "/scenes/presets")) {
    const auto read = load_specification(file.path().string());
    EXPECT_TRUE(read) << (read ? "" : read.error().message);
    ++count;
  }
  EXPECT_EQ(count, 8);
}

TEST(Growing, Counts_AreAreaTimesDensityTimesShare) {
  const auto full = grow(specified(R"("strands": {"density": 20000, "vertices": 8})")).value();
  const auto half = grow(specified(R"("strands": {"density": 20000, "vertices": 8, "share": 0.5})")).value();
  double area = 0;
  for (const auto& t : full.head.scalp.triangles) {
    const auto& p = full.head.scalp.positions;
    area += 0.5 * double(glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])));
  }
  EXPECT_NEAR(double(full.drawn.strand_count()), 20000 * area, 1);
  ASSERT_NEAR(double(half.drawn.strand_count()), 10000 * area, 1);
  EXPECT_EQ(half.drawn.strand(17)[5], full.drawn.strand(17)[5]);  // a prefix
  EXPECT_TRUE(validate(full.drawn).ok());
  EXPECT_GT(full.report.deviation.largest, full.report.deviation.mean);
}

TEST(Growing, NoDensity_IsRefused) {
  for (const char* fields : {R"("strands": {"density": 0})", R"("strands": {"share": 0})",
                             R"("regions": [{"center": [0, 0.15, 0], "radius": 1, "density": 0}])"})
    EXPECT_FALSE(grow(specified(fields))) << fields;
}

TEST(Growing, CountsThatOverflowAndNaN_AreRefused) {
  for (double density : {1e9, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    GroomingSpecification spec = {};
    spec.strands.density = density;
    const auto grown = grow(spec);
    ASSERT_FALSE(grown) << density;
    EXPECT_THAT(grown.error().message, HasSubstr("density"));
  }
}

TEST(Growing, Regions_ChangeDensityAndLengthWithinThem) {
  const auto grown = grow(specified(R"("strands": {"density": 30000, "vertices": 8}, "growing": {"length_variation": 0},
      "regions": [{"center": [0, 0.16, 0.08], "radius": 0.03, "blend": 0, "length": 0.25},
                  {"center": [0, 0.14, -0.1], "radius": 0.03, "blend": 0, "density": 0}])"))
                         .value();
  for (std::size_t v = 0; v < grown.control.strand_count(); ++v)
    if (glm::distance(glm::dvec3(grown.control.strand(v)[0]), glm::dvec3(0, 0.16, 0.08)) < 0.03) {
      EXPECT_NEAR(strand_length(grown.control, v), 0.25 * 0.27, 1e-5);
    }
  for (std::size_t s = 0; s < grown.drawn.strand_count(); ++s)
    EXPECT_GT(glm::distance(glm::dvec3(grown.drawn.strand(s)[0]), glm::dvec3(0, 0.14, -0.1)), 0.015) << s;
}

TEST(Growing, Stroke_CombsHairItsWay) {
  const auto tips = [](const char* more) {
    const auto grown = grow(specified(std::string(R"("strands": {"density": 5000, "vertices": 12},
        "growing": {"length": 0.05, "droop": 0, "clump": 0, "parting": 0})") +
                                      more))
                           .value();
    double mean = 0;
    for (std::size_t s = 0; s < grown.drawn.strand_count(); ++s)
      mean +=
          double(grown.drawn.strand(s).back().x - grown.drawn.strand(s).front().x) / double(grown.drawn.strand_count());
    return mean;
  };
  EXPECT_NEAR(tips(""), 0, 0.003);
  EXPECT_GT(tips(R"(, "strokes": [{"center": [0, 0.2, 0], "radius": 0.2, "direction": [1, 0, 0]}])"), 0.015);
}

TEST(Growing, CutHeight_EndsHairThere) {
  const auto grown = grow(specified(R"("strands": {"density": 5000, "vertices": 30},
      "growing": {"length": 0.4, "length_variation": 0, "cut_height": 0.05, "clump": 0})"))
                         .value();
  std::size_t below = 0;
  for (const glm::vec3& p : grown.control.positions) below += p.y < 0.045f;
  EXPECT_LT(double(below), 0.02 * double(grown.control.vertex_count()));
}

TEST(Growing, Bun_DrawsTipsTogetherAtTheTie) {
  const auto grown =
      grow(specified(R"("bun": {"tilt": 0.3}, "strands": {"control_hairs": 200, "density": 5000, "vertices": 64},
      "growing": {"control_vertices": 64, "segment_growth": 1, "droop": 0, "clump": 0, "parting": 0})"))
          .value();
  glm::dvec3 middle(0);
  const auto count = double(grown.control.strand_count());
  for (std::size_t v = 0; v < grown.control.strand_count(); ++v)
    middle += glm::dvec3(grown.control.strand(v).back()) / count;
  EXPECT_GT(middle.y, 0.2);
  for (std::size_t v = 0; v < grown.control.strand_count(); ++v)
    EXPECT_LT(glm::distance(glm::dvec3(grown.control.strand(v).back()), middle), 0.04) << v;
}

TEST(Growing, WholeHead_CarriesFur) {
  const auto grown = grow(specified(R"("strands": {"surface": "head", "density": 20000, "vertices": 6},
      "growing": {"length": 0.012, "droop": 0, "control_vertices": 4})"))
                         .value();
  EXPECT_EQ(grown.control.strand_count(), grown.head.mesh.positions.size());
  EXPECT_GT(grown.drawn.strand_count(), 2000u);
}

}  // namespace
}  // namespace cuticle::strands::specification_test
