// Layouts, addressing, and what texels hold, against the model itself.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lut/table_set.h"

namespace cuticle::lut::lut_bake_test {
namespace {

const bsdf::Model& marschner() { return *bsdf::find_model("marschner").value(); }
registry::ParameterValues blond() {
  return registry::parse_assignments(marschner().entry.parameters, "eta=1.55,sigma_a=0.1/0.2/0.4").value();
}
const Layout& layout(const char* name) { return *find_layout(name).value(); }
TableSet bake_set(const char* layout_name, int size) {
  return bake(marschner(), blond(), layout(layout_name), size, silent_progress()).value();
}
double model_value(bsdf::Quantity quantity, const char* lobe, const bsdf::Point& point, int component) {
  glm::dvec3 value;
  const bsdf::Request request{quantity, bsdf::find_lobe(marschner(), lobe).value(), std::span(&point, 1)};
  EXPECT_TRUE(bsdf::evaluate(marschner(), blond(), bsdf::Precision::f64, request, std::span(&value, 1)).ok());
  return value[component];
}
double stored(const Table& table, int x, int y, int channel) {
  return double(table.image.at(x, y, channel)) * table.scale[channel];
}

TEST(Layouts, Registry_HoldsTheNaluForms) {
  std::vector<std::string_view> names;
  for (const Layout* each : layouts()) names.push_back(each->entry.name);
  EXPECT_THAT(names,
              testing::IsSupersetOf({"nalu", "nalu2", "nalu_borders", "nalu_theta", "barbu", "realengine", "deon"}));
}

TEST(Layouts, UnknownName_IsRefusedWithTheNearest) {
  const auto result = find_layout("nalu3");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::usage);
  EXPECT_THAT(result.error().hint, testing::HasSubstr("nalu"));
}

TEST(AxisMap, CornerAligned_PutsTheEndsOnTexelCentres) {
  const Axis axis{AxisQuantity::cos_phi, -1, 1, true};
  const AxisMap map = axis_map(axis, 128);
  EXPECT_DOUBLE_EQ(-1 * map.scale + map.bias, 0.5 / 128);
  EXPECT_DOUBLE_EQ(1 * map.scale + map.bias, 127.5 / 128);
  EXPECT_DOUBLE_EQ(axis_value(axis, 128, 0.5), 0);
  EXPECT_DOUBLE_EQ(axis_value(axis, 128, 0), -1);
}

TEST(AxisMap, Borders_IsTheHalvedCosine) {
  const Axis axis{AxisQuantity::cos_phi, -1, 1, false};
  const AxisMap map = axis_map(axis, 128);
  EXPECT_DOUBLE_EQ(map.scale, 0.5);
  EXPECT_DOUBLE_EQ(map.bias, 0.5);
  EXPECT_DOUBLE_EQ(axis_value(axis, 128, 0.5 / 128), -1 + 1.0 / 128);
}

TEST(Bake, LongitudinalTexels_EqualTheModelAtTheirCentres) {
  const TableSet set = bake_set("nalu", 32);
  const char* lobes[] = {"R", "TT", "TRT"};
  for (int y : {0, 7, 31})
    for (int x : {0, 16, 31}) {
      const bsdf::Point point{.theta_i = std::asin(-1 + 2.0 * x / 31), .theta_o = std::asin(-1 + 2.0 * y / 31)};
      for (int c = 0; c < 3; ++c) {
        const double expected = model_value(bsdf::Quantity::M, lobes[c], point, 0);
        EXPECT_NEAR(stored(set.tables[0], x, y, c), expected, 1e-7 * expected + 1e-12)
            << lobes[c] << " " << x << " " << y;
      }
    }
}

TEST(Bake, FourthChannelOfM_IsTheCosineOfHalfTheDifference) {
  const TableSet set = bake_set("nalu_borders", 16);
  for (int y : {0, 5, 15})
    for (int x : {0, 9, 15}) {
      const double sin_i = -1 + (x + 0.5) / 8, sin_o = -1 + (y + 0.5) / 8;
      const double cos_difference = sin_i * sin_o + std::sqrt((1 - sin_i * sin_i) * (1 - sin_o * sin_o));
      EXPECT_NEAR(stored(set.tables[0], x, y, 3), std::sqrt((1 + cos_difference) / 2), 1e-7);
    }
}

TEST(Bake, AzimuthalTexels_EqualTheModelAtTheirCentres) {
  const TableSet set = bake_set("nalu", 32);
  for (int y : {0, 12, 31})
    for (int x : {0, 20, 31}) {
      const bsdf::Point point{.theta_d = std::acos(y / 31.0), .phi = std::acos(-1 + 2.0 * x / 31)};
      for (int c = 0; c < 3; ++c) {
        const double expected = model_value(bsdf::Quantity::N, "TT", point, c);
        EXPECT_NEAR(stored(set.tables[1], x, y, c), expected, 1e-7 * expected + 1e-12);
      }
      EXPECT_NEAR(stored(set.tables[1], x, y, 3), model_value(bsdf::Quantity::N, "R", point, 0), 1e-7);
    }
}

/// The energy of a row of cell averages, the integral of N_TRT over phi in (0, pi), is a quarter of the integral of A
/// over h in (-1, 1): no energy of the caustic is lost.
TEST(Bake, CellAverages_KeepTheEnergyOfTheCausticLobe) {
  const int size = 64;
  const TableSet set = bake_set("nalu", size);
  for (int y : {40, 50, 63}) {
    double energy = 0;
    for (int x = 0; x < size; ++x) {
      const auto edge = [&](int k) { return std::acos(std::clamp(-1 + (2.0 * k - 1) / (size - 1), -1.0, 1.0)); };
      energy += stored(set.tables[2], x, y, 1) * (edge(x) - edge(x + 1));
    }
    double attenuation = 0;
    const int steps = 20000;  // midpoint rule in gamma, h = sin gamma
    for (int k = 0; k < steps; ++k) {
      const double gamma = (k + 0.5) / steps * std::acos(0.0);
      const bsdf::Point point{.theta_d = std::acos(y / (size - 1.0)), .h = std::sin(gamma)};
      attenuation += model_value(bsdf::Quantity::A, "TRT", point, 1) * std::cos(gamma) * std::acos(0.0) / steps;
    }
    EXPECT_NEAR(energy / (attenuation / 2), 1, 1e-4) << y;
  }
}

TEST(Bake, TexelsOnTheCaustic_AreMarkedOnBothLobesOfTheFormula) {
  const TableSet set = bake_set("nalu", 128);
  const double index = 1.55, offset = std::sqrt((4 - index * index) / 3);
  const double azimuth = 4 * std::asin(offset / index) - 2 * std::asin(offset);
  const int column = int(std::lround((std::cos(azimuth) + 1) / 2 * 127));
  const std::size_t normal_row = 127 * 128;
  EXPECT_EQ(set.tables[2].singular[normal_row + column], 1);
  int marked = 0;
  for (int x = 0; x < 128; ++x) marked += set.tables[2].singular[normal_row + x];
  EXPECT_LE(marked, 2);
}

TEST(Bake, TwoTextureForm_StoresTheSumOfTheTransmittedLobes) {
  const TableSet three = bake_set("nalu", 32), two = bake_set("nalu2", 32);
  for (int y : {3, 20})
    for (int x : {2, 10, 18}) {
      const double sum = stored(three.tables[1], x, y, 0) + stored(three.tables[2], x, y, 0);
      EXPECT_NEAR(stored(two.tables[1], x, y, 0), sum, 0.01 * sum);
      EXPECT_EQ(stored(two.tables[1], x, y, 3), stored(three.tables[1], x, y, 3));
    }
}

TEST(Bake, AnyTexel_IsFiniteAndNotNegative) {
  for (const char* name : {"nalu", "nalu2", "nalu_borders"})
    for (const Table& table : bake_set(name, 16).tables)
      for (float value : table.image.pixels)
        ASSERT_TRUE(std::isfinite(value) && value >= 0) << name << " " << table.layout->name;
}

TEST(Bake, SizeOutOfRange_IsRefusedWithTheRange) {
  for (int size : {-1, 0, 15, 1025}) {
    const auto result = bake(marschner(), blond(), layout("nalu"), size, silent_progress());
    ASSERT_FALSE(result.ok()) << size;
    EXPECT_THAT(result.error().message, testing::HasSubstr("16 .. 1024"));
  }
}

TEST(ExactValue, FractionsOfTheAxes_AreTheModelAtThem) {
  const TableLayout& n = layout("nalu").tables[1];
  const bsdf::Point point{.theta_d = std::acos(0.75), .phi = std::acos(-0.5)};
  EXPECT_EQ(exact_value(marschner(), blond(), n, n.channels[1], 0.25, 0.75),
            model_value(bsdf::Quantity::N, "TT", point, 1));
}

}  // namespace
}  // namespace cuticle::lut::lut_bake_test
