// What certify says of angles, mip levels, S and a layout's assumption, and the search for a wanted error.
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lut/comparison.h"
#include "lut/max_error.h"

namespace cuticle::lut::lut_error_test {
namespace {

constexpr double pi = std::numbers::pi;

const bsdf::Model& model(const char* name = "marschner") { return *bsdf::find_model(name).value(); }
const Layout& layout(const char* name) { return *find_layout(name).value(); }
TableSet certified(const char* layout_name, const char* settings, int size, const char* model_name = "marschner") {
  const auto values = bsdf::parse_settings(model(model_name), "", settings).value();
  TableSet set = bake(model(model_name), values, layout(layout_name), size, silent_progress()).value();
  EXPECT_TRUE(certify(set, half_exr(), silent_progress()).ok());
  return set;
}
double rms(const ChannelError& error) { return error.rms / error.signal_rms; }
glm::dvec3 value(const TableSet& set, bsdf::Quantity quantity, const char* lobe, const bsdf::Point& point) {
  glm::dvec3 result;
  const bsdf::Request request{quantity, bsdf::find_lobe(*set.model, lobe).value(), std::span(&point, 1)};
  EXPECT_TRUE(bsdf::evaluate(*set.model, set.values, bsdf::Precision::f64, request, std::span(&result, 1)).ok());
  return result;
}

TEST(AxisInfo, EveryQuantity_StandsInItsPlaceAndGivesItsValueBack) {
  for (int q = 0; q <= int(AxisQuantity::none); ++q) {
    const AxisInfo& info = axis_info(AxisQuantity(q));
    EXPECT_EQ(int(info.quantity), q);
    for (double part : {0.0, 0.3, 1.0}) {
      const double at = info.lower + part * (info.upper - info.lower);
      EXPECT_NEAR(info.from_angle(info.to_angle(at)), at, 1e-15) << info.name;
    }
  }
}

TEST(AngleWeights, AnyLayout_AddUpToTheAnglesOfItsAxes) {
  const auto sum = [](const TableLayout& table) {
    double total = 0;
    for (double weight : angle_weights(table, 32, {100, 70})) total += weight;
    return total;
  };
  for (const char* name : {"nalu", "nalu_theta", "nalu_borders"})
    EXPECT_NEAR(sum(layout(name).tables[0]), pi * pi, 1e-9);
  EXPECT_NEAR(sum(layout("barbu").tables[1]), pi * pi / 2, 1e-9);
}

TEST(Layouts, SignedCosineOfBarbu_RepeatsTheRowAtZero) {
  const TableSet set = certified("barbu", "variant=as_published,sigma_a=0.2", 32);
  for (int x : {3, 20})
    for (int y = 1; y < 15; ++y)
      for (int c : {0, 1, 2}) EXPECT_EQ(set.tables[1].image.at(x, y, c), set.tables[1].image.at(x, 0, c));
}

TEST(Layouts, RowsOfDualScattering_HoldTheAverageFibre) {
  const auto values = bsdf::parse_settings(model(), "", "beta=0.6,sigma_a=0.1/0.5/2").value();
  const TableSet set = bake(model(), values, layout("dual_scattering"), 16, silent_progress()).value();
  const auto average = bsdf::average_scattering(model(), values, pi * (4 / 15.0 - 0.5)).value();
  ASSERT_EQ(set.tables[0].image.height, 1);
  EXPECT_NEAR(double(set.tables[0].image.at(4, 0, 1)), average.forward.share.y, 1e-6);
  EXPECT_NEAR(double(set.tables[3].image.at(4, 0, 2)), average.backward.deviation.z, 1e-6);
}

TEST(Bake, NearField_IsRefused) {
  const auto values = bsdf::parse_settings(model("chiang"), "", "field=near").value();
  const auto result = bake(model("chiang"), values, layout("nalu"), 16, silent_progress());
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, testing::HasSubstr("offset h"));
}

/// Against the model averaged by brute force over a texel of the level around places of its own.
TEST(Levels, ErrorOfALevel_IsThatAgainstTheModelsFootprint) {
  const TableSet set = certified("nalu_theta", "beta_deg=25,sigma_a=0.2", 32);
  const Table& m = set.tables[0];
  const MipLevel& level = m.levels[1];
  ASSERT_EQ(level.image.width, 8);
  const auto inclination = [](double coordinate) { return std::clamp((coordinate - 0.5) * 32 / 31, -0.5, 0.5) * pi; };
  double error = 0, signal = 0;
  for (int k = 0; k < 400; ++k) {
    const double u = (k % 20 + 0.5) / 20, v = (k / 20 + 0.5) / 20;
    double mean = 0;
    for (int j = 0; j < 256; ++j) {
      const bsdf::Point point{.theta_i = inclination(u + ((j % 16 + 0.5) / 16 - 0.5) / 8),
                              .theta_o = inclination(v + ((j / 16 + 0.5) / 16 - 0.5) / 8)};
      mean += value(set, bsdf::Quantity::M, "R", point).x / 256;
    }
    error += std::pow(sample(level.image, 0, u, v) - mean, 2);
    signal += mean * mean;
  }
  EXPECT_NEAR(rms(level.errors[0]) / std::sqrt(error / signal), 1, 0.05);
}

TEST(Levels, Texels_AreMeansOfFour) {
  const TableSet set = certified("nalu", "sigma_a=0.2", 16);
  const Table& n = set.tables[1];
  ASSERT_EQ(n.levels.size(), 4u);
  const float sum = n.image.at(4, 6, 0) + n.image.at(5, 6, 0) + n.image.at(4, 7, 0) + n.image.at(5, 7, 0);
  EXPECT_NEAR(n.levels[0].image.at(2, 3, 0), sum / 4, 1e-3F * sum);
}

TEST(Scattering, ExactChannelsOfNalu_MakeS) {
  for (const ChannelError& error : certified("nalu", "sigma_a=0.1/0.2/0.4", 32).assumption)
    EXPECT_LT(rms(error), 1e-12);
}

/// M_TRT taken as M_TT, against the model itself at directions of our own.
TEST(Scattering, AssumptionOfNalu2_IsMeasured) {
  const TableSet set = certified("nalu2", "caustic=smoothed,sigma_a=0.2", 64);
  std::mt19937 random(1);
  const auto part = [&] { return (random() + 0.5) / 4294967296.0; };
  double error = 0, signal = 0;
  for (int k = 0; k < 20000; ++k) {
    bsdf::Point at{.theta_i = std::asin(2 * part() - 1), .theta_o = std::asin(2 * part() - 1), .phi = part() * pi};
    at.theta_d = (at.theta_o - at.theta_i) / 2;
    const double tt = value(set, bsdf::Quantity::M, "TT", at).x, trt = value(set, bsdf::Quantity::M, "TRT", at).x;
    error += std::pow((tt - trt) * value(set, bsdf::Quantity::N, "TRT", at).y, 2);
    signal += std::pow(value(set, bsdf::Quantity::S, "sum", at).y, 2);
  }
  EXPECT_NEAR(rms(set.assumption[1]) / std::sqrt(error / signal), 1, 0.1);
}

TEST(Scattering, TablesOverAngles_ResolveGrazingDirections) {
  const TableSet sines = certified("nalu", "sigma_a=0.2", 64), angles = certified("nalu_theta", "sigma_a=0.2", 64);
  EXPECT_LT(rms(angles.scattering[1]), 0.45 * rms(sines.scattering[1]));
  EXPECT_LT(rms(angles.scattering[1]), 0.03);
}

TEST(Scattering, DividedByTheSquaredCosine_IsTheModelAsPublished) {
  for (const ChannelError& error : certified("barbu", "variant=as_published,sigma_a=0.2", 32).assumption)
    EXPECT_LT(rms(error), 1e-10);
}

ErrorSearch searched(const char* settings, std::vector<int> sizes, double wanted, ErrorMeasure measure) {
  TableChoices choices{{&layout("nalu"), &layout("nalu_theta")}, std::move(sizes), {}};
  choices.formats = {&half_exr(), find_format("png8").value()};
  const auto values = bsdf::parse_settings(model(), "", settings).value();
  return search_tables(model(), values, choices, wanted, measure, silent_progress()).value();
}

TEST(SearchTables, Reached_IsTheFewestBytesOfThoseTried) {
  const ErrorSearch search = searched("beta_deg=30,caustic=smoothed", {16, 32, 64, 128}, 0.1, ErrorMeasure::rms);
  ASSERT_TRUE(search.reached);
  EXPECT_LE(search.best.worst.error, 0.1);
  for (const TableChoice& choice : search.tried)
    EXPECT_TRUE(choice.worst.error > 0.1 || choice.bytes >= search.best.bytes) << choice.size;
  EXPECT_EQ(search.best.bytes, texture_bytes(*search.best.layout, search.best.size, *search.best.format));
}

TEST(SearchTables, NotReached_SaysTheBestFound) {
  const ErrorSearch search = searched("", {16, 32}, 1e-5, ErrorMeasure::maximum);
  EXPECT_FALSE(search.reached);
  ASSERT_EQ(search.tried.size(), 4u);
  for (const TableChoice& choice : search.tried) EXPECT_GE(choice.worst.error, search.best.worst.error);
}

TEST(RelativeError, EachMeasure_IsItsQuotient) {
  const ChannelError error{"S", 3, 9, 9, 10, 9, 0, {2, 1, 8}};
  EXPECT_EQ(relative_error(error, ErrorMeasure::rms), 0.25);
  EXPECT_EQ(relative_error(error, ErrorMeasure::maximum), 0.3);
  EXPECT_EQ(relative_error(error, ErrorMeasure::percentile_99), 0.1);
}

}  // namespace
}  // namespace cuticle::lut::lut_error_test
