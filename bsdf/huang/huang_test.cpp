// The microfacet model: R by mpmath, integrals, the bound that the quadrature reports, symmetry, hard cases, bad
// parameters.
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "tests/support/csv_table.h"
#include "tests/support/model_values.h"

namespace cuticle::bsdf::huang_test {
namespace {

using ::testing::HasSubstr;
constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

const Model& model() { return **find_model("huang"); }
constexpr tests::ValuesOf evaluate_at{"huang"};
double value_at(const std::string& settings, Quantity quantity, std::string_view lobe, const Point& point) {
  return tests::model_value("huang", settings, quantity, lobe, point).x;
}

/// R by one facet of a fibre seen from far, and of one offset; generated with 30 digits.
TEST(Huang, MirroredLobe_AgreesWithMpmath) {
  double worst_far = 0, worst_near = 0;
  for (const tests::CsvRow& row : tests::read_csv(CUTICLE_SOURCE_DIR "/bsdf/huang/reference/mirrored.csv")) {
    const std::string settings = fmt::format("facets=single,roughness={},tilt={},aspect={}", row.text("roughness"),
                                             row.text("tilt"), row.text("aspect"));
    const Point point{.theta_i = row.number("theta_i"),
                      .theta_o = row.number("theta_o"),
                      .phi = row.number("phi"),
                      .h = row.number("h"),
                      .phi_o = row.number("phi_o")};
    const double far = row.number("far"), near_by = row.number("near");
    worst_far = std::max(worst_far, std::abs(value_at(settings, Quantity::S, "R", point) - far) / far);
    if (near_by > 0)
      worst_near = std::max(worst_near,
                            std::abs(value_at(settings + ",field=near", Quantity::S, "R", point) - near_by) / near_by);
    EXPECT_LE(std::abs(value_at(settings, Quantity::S, "R", point) - far),
              value_at(settings, Quantity::error, "R", point) + 1e-13 * far)
        << settings << " phi " << point.phi;
  }
  EXPECT_LE(worst_far, 1e-5);
  EXPECT_LE(worst_near, 1e-12);
}

TEST(Huang, MirroredLobeOfTheFarField_IsTheMeanOverOffsets) {
  const std::string settings = "facets=single,roughness=0.3,aspect=0.6";
  const Point point{.theta_i = -0.5, .theta_o = 0.3, .phi = 0.8, .phi_o = 0.4};
  double sum = 0;
  const int count = 4000;
  for (int k = 0; k < count; ++k) {
    Point place = point;
    place.h = -1 + (k + 0.5) * 2 / count;
    sum += value_at(settings + ",field=near", Quantity::S, "R", place) / count;
  }
  EXPECT_NEAR(sum, value_at(settings, Quantity::S, "R", point), 2e-4 * sum);
}

TEST(Huang, MirroredLobe_PeaksTwiceTheTiltTowardTheRoot) {
  double peak = 0, largest = 0;
  for (int k = -300; k <= 300; ++k) {
    const double theta = k * 0.1 * degree;
    const double value = value_at("roughness=0.02,tilt_deg=3", Quantity::S, "R", {.theta_i = theta});
    if (value > largest) peak = theta;
    largest = std::max(largest, value);
  }
  EXPECT_NEAR(peak / degree, -6, 0.11);
}

/// The integral of S over the sphere of the light, by even steps.
double integral_of_s(const std::string& settings, int lobe, double theta_o, double phi_o) {
  const int thetas = 24, phis = 32;
  std::vector<Point> points;
  for (int i = 0; i < thetas; ++i)
    for (int k = 0; k < phis; ++k)
      points.push_back({.theta_i = ((i + 0.5) / thetas - 0.5) * pi,
                        .theta_o = theta_o,
                        .phi = ((k + 0.5) / phis - 0.5) * 2 * pi,
                        .phi_o = phi_o});
  double sum = 0;
  const auto values = evaluate_at(settings, Quantity::S, lobe, points);
  for (std::size_t n = 0; n < points.size(); ++n) sum += values[n].x * std::cos(points[n].theta_i);
  return sum * (pi / thetas) * (2 * pi / phis);
}

TEST(Huang, Albedo_IsTheIntegralOfS) {
  for (const char* settings :
       {"facets=single,roughness=0.4,samples=1024", "facets=single,roughness=0.6,samples=1024,aspect=0.5"})
    for (int lobe = 0; lobe < 3; ++lobe) {
      const double allowed = std::array<double, 3>{0.01, 0.03, 0.03}[std::size_t(lobe)];
      const double albedo = evaluate_at(settings, Quantity::albedo, lobe, {{.theta_o = 0.5, .phi_o = 0.7}})[0].x;
      EXPECT_NEAR(integral_of_s(settings, lobe, 0.5, 0.7), albedo, allowed * albedo) << settings << lobe;
    }
}

TEST(Huang, SingleFacetsWithoutAbsorption_ScatterLessThanTheyGet) {
  for (double roughness : {0.001, 0.05, 0.3, 1.0})
    for (double theta : {-89.9, -60.0, 0.0, 45.0, 89.9}) {
      const double albedo = value_at(fmt::format("facets=single,sigma_a=0,roughness={}", roughness), Quantity::albedo,
                                     "sum", {.theta_o = theta * degree});
      EXPECT_LT(albedo, 1.001) << roughness << " " << theta;
      if (roughness < 0.01 && theta == 0) {
        EXPECT_GT(albedo, 0.98);
      }
    }
}

TEST(Huang, WithoutAbsorption_ScattersAllThatItGets) {
  for (double roughness : {0.05, 0.1, 0.3, 0.5, 1.0})
    for (double aspect : {1.0, 0.6})
      for (double theta : {-80.0, 0.0, 45.0}) {
        const std::string settings = fmt::format("sigma_a=0,roughness={},aspect={}", roughness, aspect);
        EXPECT_NEAR(value_at(settings, Quantity::albedo, "sum", {.theta_o = theta * degree, .phi_o = 0.4}), 1, 4e-4)
            << settings << " " << theta;
      }
}

TEST(Huang, WithoutAbsorption_SOverTheSphereIsOne) {
  EXPECT_NEAR(integral_of_s("sigma_a=0,roughness=0.3", -1, 0.5, 0.7), 1, 0.03);
}

/// Random points where there is light, from the model's own sampler.
std::vector<Point> lit_points(const std::string& settings, int count) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<SampleQuery> queries(static_cast<std::size_t>(count));
  for (SampleQuery& query : queries) {
    query = {std::asin(1.9 * unit(generator) - 0.95), 6 * unit(generator) - 3, 1.9 * unit(generator) - 0.95, {}};
    for (double& u : query.u) u = unit(generator);
  }
  std::vector<Sample> drawn(queries.size());
  EXPECT_TRUE(sample(model(), *parse_settings(model(), "", settings), Precision::f64, queries, drawn).ok());
  std::vector<Point> points;
  for (std::size_t k = 0; k < queries.size(); ++k)
    points.push_back({.theta_i = drawn[k].theta_i,
                      .theta_o = queries[k].theta_o,
                      .phi = drawn[k].phi,
                      .h = queries[k].h,
                      .phi_o = queries[k].phi_o});
  return points;
}

TEST(Huang, ReportedError_BoundsTheDifferenceFromManyPaths) {
  int within = 0, all = 0;
  for (const char* settings : {"facets=single,roughness=0.5", "facets=single,roughness=0.2,aspect=0.6",
                               "facets=single,roughness=0.05", "facets=single,roughness=0.2,field=near"}) {
    const std::vector<Point> points = lit_points(std::string(settings) + ",samples=64", 40);
    for (int lobe = 1; lobe < 3; ++lobe) {
      const std::string few = std::string(settings) + ",samples=256", many = std::string(settings) + ",samples=8192";
      const auto value = evaluate_at(few, Quantity::S, lobe, points),
                 error = evaluate_at(few, Quantity::error, lobe, points);
      const auto truth = evaluate_at(many, Quantity::S, lobe, points);
      for (std::size_t k = 0; k < points.size(); ++k) {
        within += std::abs(value[k].x - truth[k].x) <= error[k].x;
        ++all;
      }
    }
  }
  EXPECT_GE(within, 0.99 * all) << all;
}

TEST(Huang, ReportedErrorOfAllLobes_BoundsTheDifferenceFromManyPaths) {
  int within = 0, all = 0;
  for (const char* settings : {"roughness=0.4", "roughness=0.05,aspect=0.6", "roughness=0.2,field=near"}) {
    const std::vector<Point> points = lit_points(std::string(settings) + ",samples=64", 50);
    const std::string few = std::string(settings) + ",samples=256", many = std::string(settings) + ",samples=4096";
    const auto value = evaluate_at(few, Quantity::S, -1, points), error = evaluate_at(few, Quantity::error, -1, points);
    const auto truth = evaluate_at(many, Quantity::S, -1, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      within += std::abs(value[k].x - truth[k].x) <= error[k].x;
      ++all;
    }
  }
  EXPECT_GE(within, 0.99 * all) << all;
}

/// What passes from one direction to the other is symmetric where scales are not tilted: S cos(theta_o) times the width
/// seen.
void expect_reciprocal(const std::string& settings, int lobe, const std::vector<double>& phis, double share) {
  const auto flux = [&](const Point& point, Quantity quantity) {
    const double width = std::hypot(std::sin(point.phi_o), 0.6 * std::cos(point.phi_o));
    return evaluate_at("roughness=0.3,tilt=0,aspect=0.6," + settings, quantity, lobe, {point})[0].x *
           std::cos(point.theta_o) * width;
  };
  for (double phi : phis) {
    const Point there{.theta_i = -0.4, .theta_o = 0.3, .phi = phi, .phi_o = 0.5};
    const Point back{.theta_i = 0.3, .theta_o = -0.4, .phi = -phi, .phi_o = 0.5 - phi};
    const double bound = flux(there, Quantity::error) + flux(back, Quantity::error);
    const double value = flux(there, Quantity::S);
    EXPECT_NEAR(value, flux(back, Quantity::S), bound + 1e-12) << settings << lobe;
    EXPECT_LT(bound, share * value) << settings << lobe;
  }
}
TEST(Huang, UntiltedFibre_IsReciprocalInFlux) {
  expect_reciprocal("facets=single,samples=65536", 0, {0.8}, 0.4);
  expect_reciprocal("facets=single,samples=65536", 1, {2.6}, 0.4);
  expect_reciprocal("facets=single,samples=65536", 2, {0.5}, 0.4);
  expect_reciprocal("samples=32768", -1, {0.8, 2.6, 0.5}, 0.6);
}

TEST(Huang, CircularFibre_LooksTheSameFromEverywhereAround) {
  const Point one{.theta_i = 0.2, .theta_o = 0.4, .phi = 2.5},
      two{.theta_i = 0.2, .theta_o = 0.4, .phi = 2.5, .phi_o = 1.3};
  EXPECT_EQ(value_at("", Quantity::S, "sum", one), value_at("", Quantity::S, "sum", two));
}

TEST(Huang, EllipticalFibre_IsSymmetricAboutItsAxes) {
  const Point point{.theta_i = -0.2, .theta_o = 0.4, .phi = 1, .phi_o = 0.6};
  const Point mirrored{.theta_i = -0.2, .theta_o = 0.4, .phi = -1, .phi_o = -0.6};
  const Point turned{.theta_i = -0.2, .theta_o = 0.4, .phi = 1, .phi_o = 0.6 + pi};
  for (const char* lobe : {"R", "TT"}) {
    const double value = value_at("aspect=0.5,samples=4096", Quantity::S, lobe, point);
    const double bound = 2 * value_at("aspect=0.5,samples=4096", Quantity::error, lobe, point) + 1e-12;
    EXPECT_NEAR(value_at("aspect=0.5,samples=4096", Quantity::S, lobe, mirrored), value, bound) << lobe;
    EXPECT_NEAR(value_at("aspect=0.5,samples=4096", Quantity::S, lobe, turned), value, 1e-9) << lobe;
  }
}

TEST(Huang, Marginals_IntegrateToOneAndToTheAlbedo) {
  const double theta = 0.4;
  for (const char* lobe : {"R", "TT", "TRT"}) {
    double m = 0, n = 0;
    for (int k = 0; k < 24; ++k) {
      const double inclination = ((k + 0.5) / 24 - 0.5) * pi;
      m += value_at("roughness=0.4", Quantity::M, lobe, {.theta_i = inclination, .theta_o = theta}) *
           std::cos(inclination) * pi / 24;
    }
    for (int k = 0; k < 16; ++k)
      n += value_at("roughness=0.4", Quantity::N, lobe, {.theta_d = theta, .phi = ((k + 0.5) / 16 - 0.5) * 2 * pi}) *
           2 * pi / 16;
    const double tolerance = lobe == std::string_view("TRT") ? 0.25 : 0.05;
    EXPECT_NEAR(m, 1, tolerance) << lobe;
    EXPECT_NEAR(n / value_at("roughness=0.4", Quantity::albedo, lobe, {.theta_o = theta}), 1, tolerance) << lobe;
  }
}

TEST(Huang, FloatScattering_AgreesWithDouble) {
  for (const char* settings : {"roughness=0.5", "roughness=0.1", "roughness=0.1,field=near"}) {
    const std::vector<Point> points = lit_points(std::string(settings) + ",samples=64", 100);
    for (int lobe = 0; lobe < 3; ++lobe) {
      const auto truth = evaluate_at(settings, Quantity::S, lobe, points);
      const auto single = evaluate_at(settings, Quantity::S, lobe, points, Precision::f32);
      const auto error = evaluate_at(settings, Quantity::error, lobe, points);
      for (std::size_t k = 0; k < points.size(); ++k)
        EXPECT_NEAR(single[k].x, truth[k].x, error[k].x + 2e-4 * truth[k].x + 1e-6) << settings << lobe << " " << k;
    }
  }
}

TEST(Huang, EdgesOfTheDomain_AreFiniteAndNotNegative) {
  std::vector<Point> points;
  for (double theta_i : {-90.0, -89.999, 0.0, 90.0})
    for (double theta_o : {-90.0, 0.0, 89.999, 90.0})
      for (double phi : {0.0, 1e-7, 120.0, 180.0})
        for (double h : {-1.0, 0.0, 1.0})
          points.push_back({theta_i * degree, theta_o * degree, theta_o * degree, phi * degree, h, 0.3});
  for (const char* settings :
       {"roughness=0.001,sigma_a=0,samples=64", "roughness=1,sigma_a=100,eta=1.05,aspect=0.2,samples=64",
        "eta=3,tilt_deg=10,samples=64,field=near"})
    for (Quantity quantity : {Quantity::S, Quantity::pdf, Quantity::error})
      for (Precision precision : {Precision::f32, Precision::f64}) {
        const auto values = evaluate_at(settings, quantity, -1, points, precision);
        for (std::size_t k = 0; k < values.size(); ++k)
          for (int c = 0; c < 3; ++c)
            EXPECT_TRUE(std::isfinite(values[k][c]) && values[k][c] >= 0)
                << settings << " " << int(quantity) << " " << k;
      }
}

TEST(Huang, Fibre_IsMappedToItsSettings) {
  Fibre fibre;
  fibre.aspect = 0.8;
  fibre.longitudinal_deviation = 0.2;
  const FibreMapping mapping = model().from_fibre(fibre);
  const auto values = parse_settings(model(), "", mapping.settings);
  ASSERT_TRUE(values.ok());
  EXPECT_NEAR(values->real("roughness"), 0.1414, 1e-4);
  EXPECT_EQ(values->real("aspect"), 0.8);
  EXPECT_THAT(mapping.words, HasSubstr("roughness"));
}

TEST(Huang, BadParameters_AreNamedWithTheirRange) {
  EXPECT_THAT(parse_settings(model(), "", "aspect=0.1").error().message, HasSubstr("aspect"));
  EXPECT_THAT(parse_settings(model(), "", "field=middle").error().message, HasSubstr("field"));
}

}  // namespace
}  // namespace cuticle::bsdf::huang_test
