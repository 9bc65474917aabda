// What Kajiya-Kay, Scheuermann and HairWorks have in common: tables by mpmath, densities, samplers, energies, edges.
#define GLM_FORCE_XYZW_ONLY
#include <cmath>
#include <numbers>
#include <random>

#include <ceres/jet.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "tests/support/condition_number.h"
#include "tests/support/csv_table.h"
#include "bsdf/hairworks/hairworks.glslh"
#include "bsdf/kajiya_kay/kajiya_kay.glslh"
#include "bsdf/scheuermann/scheuermann.glslh"

namespace cuticle::bsdf::empirical_models_test {
namespace {

constexpr double pi = std::numbers::pi;

/// A model, and settings that make its lobes broad enough to integrate on a grid, with every shift in use.
struct Subject {
  const char* name;
  const char* settings;
  tests::Conditioned (*condition)(const std::vector<float>&, int lobe, const EvaluationPoint<double>&);
};

#define CUTICLE_CONDITION(space, Prepared)                                                                             \
  [](const std::vector<float>& numbers, int lobe, const EvaluationPoint<double>& at) {                                 \
    const auto prepared = narrow<double>(from_numbers<space::Prepared<float>>(numbers.data()));                        \
    return tests::condition_number(                                                                                    \
        prepared, CUTICLE_QUANTITY_S, lobe, at,                                                                        \
        [](const auto& p, int quantity, int l, const auto& point) { return space::evaluate(p, quantity, l, point); }); \
  }
const Subject subjects[] = {
    {"kajiya_kay", "diffuse=0.05,specular=0.2/0.1/0.05,exponent=12.5", CUTICLE_CONDITION(kajiya_kay, KajiyaKay)},
    {"scheuermann", "primary=0.1,primary_exponent=40,secondary=0.1/0.05/0.01,secondary_exponent=9,primary_shift=0.2",
     CUTICLE_CONDITION(scheuermann, Scheuermann)},
    {"hairworks",
     "diffuse_blend=0.4,normal_theta=0.3,normal_phi=1,exponent=30,secondary_scale=0.6,secondary_width=2.5,secondary_"
     "shift=0.3",
     CUTICLE_CONDITION(hairworks, Hairworks)},
};

class EmpiricalModels : public testing::TestWithParam<Subject> {
 protected:
  const Model& model() const { return **find_model(GetParam().name); }
  registry::ParameterValues values(const std::string& settings) const { return *parse_settings(model(), "", settings); }
  std::vector<glm::dvec3> at(const std::string& settings, Quantity quantity, int lobe, const std::vector<Point>& points,
                             Precision precision = Precision::f64) const {
    std::vector<glm::dvec3> out(points.size());
    EXPECT_TRUE(evaluate(model(), values(settings), precision, {quantity, lobe, points}, out).ok()) << settings;
    return out;
  }
  int lobes() const { return int(model().lobes.size()); }
};
INSTANTIATE_TEST_SUITE_P(Models, EmpiricalModels, testing::ValuesIn(subjects),
                         [](const auto& info) { return std::string(info.param.name); });

/// The largest relative error over the model's table, as a part of what the condition number allows.
template <class Precise>
double worst_part(const Subject& subject, Precision precision, const Precise& evaluate_row) {
  double worst = 0;
  const std::string file = fmt::format("{}/bsdf/{}/reference/{}.csv", CUTICLE_SOURCE_DIR, subject.name, subject.name);
  for (const tests::CsvRow& row : tests::read_csv(file)) {
    const double truth = row.number("s");
    if (truth < 1e-6) continue;
    const auto [value, kappa] = evaluate_row(row);
    const double relative = std::abs(value / truth - 1);
    const double eps = precision == Precision::f64 ? 2.220446049250313e-16 : 1.1920928955078125e-7;
    worst = std::max(worst, relative / (16 * eps * (1 + kappa)));
  }
  return worst;
}

TEST_P(EmpiricalModels, Scattering_AgreesWithMpmathAsFarAsItsInputsAllow) {
  for (Precision precision : {Precision::f64, Precision::f32}) {
    const double worst = worst_part(GetParam(), precision, [&](const tests::CsvRow& row) {
      std::string settings = row.text("settings");
      std::replace(settings.begin(), settings.end(), ';', ',');
      const int lobe = int(row.number("lobe"));
      const Point point{.theta_i = row.number("theta_i"), .theta_o = row.number("theta_o"), .phi = row.number("phi")};
      const std::vector<float> numbers = model().pack(values(settings));
      const auto conditioned = GetParam().condition(numbers, lobe, {point.theta_i, point.theta_o, 0, point.phi, 0, 0});
      return std::pair(at(settings, Quantity::S, lobe, {point}, precision)[0].x, conditioned.kappa);
    });
    RecordProperty(precision == Precision::f64 ? "double" : "float", std::to_string(worst));
    EXPECT_LE(worst, 1) << "parts of 16 eps (1 + kappa)";
  }
}

TEST_P(EmpiricalModels, Albedo_IsTheIntegralOfS) {
  const int across = 500, around = 240;
  for (double theta_o : {0.0, 0.6, -1.3}) {
    std::vector<Point> points;
    for (int i = 0; i < across; ++i)
      for (int k = 0; k < around; ++k)
        points.push_back(
            {.theta_i = ((i + 0.5) / across - 0.5) * pi, .theta_o = theta_o, .phi = (2 * (k + 0.5) / around - 1) * pi});
    for (int lobe = -1; lobe < lobes(); ++lobe) {
      const auto scattering = at(GetParam().settings, Quantity::S, lobe, points);
      double sum = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        sum += scattering[i].y * std::cos(points[i].theta_i) * 2 * pi * pi / (across * around);
      const double albedo = at(GetParam().settings, Quantity::albedo, lobe, {{.theta_o = theta_o}})[0].y;
      EXPECT_NEAR(sum, albedo, 5e-5 * albedo) << lobe << " " << theta_o;
    }
  }
}

TEST_P(EmpiricalModels, Density_IntegratesToOne) {
  const int across = 20000;
  for (double theta_o : {0.0, 0.9, -1.4, 1.5707}) {
    std::vector<Point> points;
    for (int i = 0; i < across; ++i) points.push_back({.theta_i = ((i + 0.5) / across - 0.5) * pi, .theta_o = theta_o});
    for (int lobe = -1; lobe < lobes(); ++lobe) {
      const auto density = at(GetParam().settings, Quantity::pdf, lobe, points);
      double sum = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        sum += density[i].x * std::cos(points[i].theta_i) * 2 * pi * pi / across;
      EXPECT_NEAR(sum, 1, 1e-6) << lobe << " " << theta_o;
    }
  }
}

/// Directions drawn for one viewer, by a fixed seed.
std::vector<Sample> drawn(const Model& model, const registry::ParameterValues& values, double theta_o, int count) {
  std::mt19937 random(1989);
  std::vector<SampleQuery> queries(count);
  for (SampleQuery& query : queries) {
    query.theta_o = theta_o;
    for (double& u : query.u) u = double(random()) / 4294967296.0;
  }
  std::vector<Sample> samples(count);
  EXPECT_TRUE(sample(model, values, Precision::f64, queries, samples).ok());
  return samples;
}

TEST_P(EmpiricalModels, MeanWeight_IsTheAlbedo) {
  for (double theta_o : {0.0, 0.8, -1.3}) {
    const auto samples = drawn(model(), values(GetParam().settings), theta_o, 100000);
    double sum = 0, squares = 0;
    for (const Sample& one : samples) {
      sum += one.weight.x;
      squares += one.weight.x * one.weight.x;
    }
    const double mean = sum / samples.size(), deviation = std::sqrt(squares / samples.size() - mean * mean);
    const double albedo = at(GetParam().settings, Quantity::albedo, -1, {{.theta_o = theta_o}})[0].x;
    EXPECT_NEAR(mean, albedo, 4 * deviation / std::sqrt(double(samples.size()))) << theta_o;
  }
}

TEST_P(EmpiricalModels, Samples_AreDistributedAsTheDensity) {
  constexpr int bins = 40, inside = 200, count = 200000;
  for (double theta_o : {0.2, -1.2}) {
    std::vector<double> expected(bins), found(bins);
    std::vector<Point> points;
    for (int i = 0; i < bins * inside; ++i)
      points.push_back({.theta_i = ((i + 0.5) / (bins * inside) - 0.5) * pi, .theta_o = theta_o});
    const auto density = at(GetParam().settings, Quantity::pdf, -1, points);
    for (int i = 0; i < bins * inside; ++i)
      expected[i / inside] += density[i].x * std::cos(points[i].theta_i) * 2 * pi * pi / (bins * inside) * count;
    for (const Sample& one : drawn(model(), values(GetParam().settings), theta_o, count))
      found[std::min(bins - 1, int((one.theta_i / pi + 0.5) * bins))] += 1;
    double chi_squared = 0;
    for (int b = 0; b < bins; ++b) chi_squared += std::pow(found[b] - expected[b], 2) / expected[b];
    EXPECT_LT(chi_squared, 39 + 5 * std::sqrt(2 * 39.0)) << theta_o;
  }
}

TEST_P(EmpiricalModels, Lobes_AddUpToTheSum) {
  const Point point{.theta_i = 0.2, .theta_o = -0.3, .theta_d = 0.1, .phi = 2.1, .h = 0.4};
  for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::albedo, Quantity::error}) {
    double sum = 0;
    for (int lobe = 0; lobe < lobes(); ++lobe) sum += at("", quantity, lobe, {point})[0].x;
    EXPECT_DOUBLE_EQ(at("", quantity, -1, {point})[0].x, sum) << int(quantity);
  }
}

/// Every parameter of the model at one of its ends, its default or in between.
std::string hard_settings(const Model& model, std::mt19937& random) {
  std::string settings;
  for (const registry::Parameter& parameter : model.entry.parameters) {
    const double place = std::array{0.0, 1.0, 0.5, 0.03}[random() % 4];
    if (random() % 3 == 0) continue;
    settings += fmt::format("{}{}={}", settings.empty() ? "" : ",", parameter.name,
                            parameter.minimum + (parameter.maximum - parameter.minimum) * place);
  }
  return settings;
}

TEST_P(EmpiricalModels, HardPoints_AreFiniteAndNotNegative) {
  std::mt19937 random(20040322);
  const double angles[] = {0, 1e-9, -1e-9, 0.5, -1.2, 89.999 * pi / 180, pi / 2, -pi / 2};
  for (int set = 0; set < 60; ++set) {
    const std::string settings = hard_settings(model(), random);
    std::vector<Point> points;
    for (double theta_i : angles)
      for (double theta_o : angles)
        for (double phi : {0.0, 1e-9, 2.0, pi, -pi})
          points.push_back({.theta_i = theta_i, .theta_o = theta_o, .theta_d = theta_o, .phi = phi, .h = 1});
    for (Precision precision : {Precision::f32, Precision::f64})
      for (Quantity quantity : {Quantity::S, Quantity::M, Quantity::N, Quantity::A, Quantity::pdf, Quantity::error})
        for (int lobe = -1; lobe < lobes(); ++lobe)
          for (const glm::dvec3& value : at(settings, quantity, lobe, points, precision))
            ASSERT_TRUE(std::isfinite(value.x) && value.x >= 0) << settings << " " << int(quantity) << " " << lobe;
    for (double theta_o : {0.0, pi / 2, -1.0})
      for (Precision precision : {Precision::f32, Precision::f64}) {
        const glm::dvec3 value = at(settings, Quantity::albedo, -1, {{.theta_o = theta_o}}, precision)[0];
        ASSERT_TRUE(std::isfinite(value.x) && value.x >= 0) << settings;
      }
  }
}

TEST_P(EmpiricalModels, Fibre_IsMappedToSettingsWithItsEnergy) {
  Fibre fibre;
  fibre.sigma_a = glm::dvec3(0.1, 0.5, 2);
  fibre.scale_tilt = 0;
  const FibreMapping mapping = model().from_fibre(fibre);
  EXPECT_FALSE(mapping.words.empty());
  const double blond = at(mapping.settings, Quantity::albedo, -1, {{}})[0].x;
  fibre.sigma_a = glm::dvec3(0);
  const double white = at(model().from_fibre(fibre).settings, Quantity::albedo, -1, {{}})[0].x;
  EXPECT_NEAR(white, 1, 2e-3) << "a fibre that absorbs nothing scatters all light";
  EXPECT_TRUE(blond < 0.9 && blond > 0.6) << blond;
}

TEST_P(EmpiricalModels, Presets_AreValid) {
  EXPECT_EQ(model().presets.size(), 3u);
  for (const registry::StudyCase& preset : model().presets)
    EXPECT_TRUE(parse_settings(model(), preset.name, "").ok()) << preset.name;
}

}  // namespace
}  // namespace cuticle::bsdf::empirical_models_test
