// Parameters found again from synthetic measurements, and refusals where they cannot be.
#include <cmath>
#include <map>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lut/fit/detail/tangents.h"

namespace cuticle::lut::model_fit_test {
namespace {

using testing::UnorderedElementsAre;

constexpr double k_degree = 0.017453292519943295;

const bsdf::Model& model(std::string_view name) { return *bsdf::find_model(name).value(); }
registry::ParameterValues settings(std::string_view name, std::string_view text) {
  return registry::parse_assignments(model(name).entry.parameters, text).value();
}

/// Places over the sphere that no caustic of the smooth fibre comes near.
std::vector<bsdf::Point> places() {
  std::vector<bsdf::Point> points;
  for (double theta_i : {-40.0, -12.0, 18.0, 45.0})
    for (double theta_o : {-30.0, 4.0, 33.0})
      for (double phi : {40.0, 95.0, 150.0, 175.0})
        points.push_back(
            {theta_i * k_degree, theta_o * k_degree, (theta_o - theta_i) / 2 * k_degree, phi * k_degree, 0.3, 0});
  return points;
}

/// The model's values at the places, each with noise of `relative` of itself and `absolute` in all.
Measurements measured(std::string_view name, std::string_view truth, int lobe, double relative, double absolute,
                      unsigned seed) {
  Measurements data;
  const std::vector<bsdf::Point> points = places();
  std::vector<glm::dvec3> values(points.size());
  EXPECT_TRUE(
      bsdf::evaluate(model(name), settings(name, truth), bsdf::Precision::f64, {data.quantity, lobe, points}, values)
          .ok());
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double sigma = relative * values[i].x + absolute;
    for (int c = 0; c < 3; ++c) values[i][c] += sigma * normal(random);
    data.rows.push_back({points[i], lobe, values[i], sigma});
  }
  return data;
}

ModelFit fitted(std::string_view name, std::string_view start, std::vector<std::string> free, const Measurements& data,
                Loss loss = Loss::squares) {
  return fit_model({&model(name), settings(name, start), std::move(free), loss}, data).value();
}

/// All real and rgb parameters that the model's value depends on smoothly at its defaults.
std::vector<std::string> smooth_parameters(const bsdf::Model& model) {
  std::vector<std::string> names;
  for (const registry::Parameter& parameter : model.entry.parameters)
    if ((parameter.type == registry::ParameterType::real || parameter.type == registry::ParameterType::rgb) &&
        parameter.name.find("tolerance") == std::string_view::npos)
      names.emplace_back(parameter.name);
  return names;
}

/// Where a default sits at the end of its range, or where a branch begins, a place inside.
std::string_view away_from_edges(std::string_view name) {
  if (name == "chiang") return "h_from=-0.7,h_to=0.6";
  return name == "marschner" ? "aspect=0.9" : "";
}

TEST(Tangents, EveryModel_AgreesWithDifferencesOfItsValues) {
  for (const JetModel& jet : jet_models()) {
    const bsdf::Model& model = *bsdf::find_model(jet.name).value();
    const registry::ParameterValues values = settings(jet.name, away_from_edges(jet.name));
    const auto free = free_parameters(model, smooth_parameters(model), false).value();
    const Measurements data = measured(jet.name, "", -1, 0, 0, 1);
    const Tangents tangents = evaluate_tangents(jet, values, free, data);
    for (std::size_t j = 0; j < free.size(); ++j) {
      const double x = free[j].get(values), step = 1e-5 * std::max(std::abs(x), 0.1);
      std::vector<glm::dvec3> low(data.rows.size()), high(low);
      std::vector<bsdf::Point> points = places();
      for (auto [sign, out] : {std::pair(-1, &low), std::pair(1, &high)}) {
        registry::ParameterValues moved = values;
        free[j].set(moved, x + sign * step);
        model.evaluate_f64(moved, {data.quantity, -1, points}, *out);
      }
      double largest = 0, off = 0, size = 0;
      for (std::size_t row = 0; row < low.size(); ++row)
        for (int c = 0; c < 3; ++c) {
          const double difference = (high[row][c] - low[row][c]) / (2 * step);
          off = std::max(off, std::abs(tangents.gradients[(3 * row + std::size_t(c)) * free.size() + j] - difference));
          largest = std::max(largest, std::abs(difference));
          size = std::max(size, std::abs(tangents.values[row][c]));
        }
      EXPECT_LE(off, 1e-6 * largest + 1e-8 * size) << jet.name << ", " << free[j].name;
    }
  }
}

constexpr std::string_view k_truth = "eta=1.5,sigma_a=0.3/0.5/0.8,beta=0.2,alpha=-0.08";
const std::vector<std::string> k_free = {"eta", "sigma_a", "beta", "alpha"};

double truth_of(const std::string& name) {
  const auto values = settings("marschner", k_truth);
  return free_parameters(model("marschner"), {name}, false).value()[0].get(values);
}

/// Share of 200 noisy sets whose 95 % intervals hold the truth, for each parameter.
std::map<std::string, double> coverage(bool sigma_known, double relative, double absolute) {
  std::map<std::string, double> share;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Measurements data = measured("marschner", k_truth, -1, relative, absolute, seed);
    data.sigma_known = sigma_known;
    const ModelFit fit = fitted("marschner", "", k_free, data);
    EXPECT_TRUE(fit.converged && fit.inseparable.empty());
    for (const FittedParameter& p : fit.parameters)
      share[p.name] += (std::abs(p.value - truth_of(p.name)) <= fit.interval * p.sigma) / 200.0;
  }
  return share;
}

void expect_coverage(const std::map<std::string, double>& share) {
  ASSERT_EQ(share.size(), 6u);
  for (const auto& [name, held] : share) {
    fmt::print("{:<10} {:.1f} %\n", name, 100 * held);
    EXPECT_GE(held, 0.91) << name;
    EXPECT_LE(held, 0.98) << name;
  }
}

TEST(FitModel, KnownNoise_IntervalsHoldTheTruth) { expect_coverage(coverage(true, 0.02, 1e-4)); }
TEST(FitModel, UnknownNoise_IntervalsHoldTheTruth) { expect_coverage(coverage(false, 0, 5e-4)); }

TEST(FitModel, WithoutNoise_FindsTheTruth) {
  const ModelFit fit = fitted("marschner", "", k_free, measured("marschner", k_truth, -1, 0, 0, 1));
  for (const FittedParameter& p : fit.parameters) EXPECT_NEAR(p.value, truth_of(p.name), 1e-7) << p.name;
}

TEST(FitModel, OutliersWithHuber_MoveTheFitLess) {
  Measurements data = measured("marschner", k_truth, -1, 0.01, 1e-4, 7);
  for (std::size_t i = 0; i < data.rows.size(); i += 12) data.rows[i].value *= 1.5;
  double off[2] = {0, 0};
  for (Loss loss : {Loss::squares, Loss::huber}) {
    data.sigma_known = true;
    const ModelFit fit = fitted("marschner", "", k_free, data, loss);
    for (const FittedParameter& p : fit.parameters)
      off[loss == Loss::huber] += std::abs(p.value - truth_of(p.name)) / std::abs(truth_of(p.name));
  }
  fmt::print("off by {:.3f} with squares, {:.3f} with Huber's loss\n", off[0], off[1]);
  EXPECT_LT(off[1], off[0] / 2);
}

TEST(FitModel, TwoModels_TheTrueOneHasTheLowerCriterion) {
  Measurements data = measured("marschner", k_truth, -1, 0.02, 1e-4, 3);
  data.sigma_known = true;
  const ModelFit right = fitted("marschner", "", k_free, data);
  const ModelFit wrong = fitted("karis", "", {"color", "roughness", "shift"}, data);
  EXPECT_LT(right.aic, wrong.aic - 10);
}

TEST(FitModel, OnlyTheReflection_CannotTellTheAbsorption) {
  const Measurements data = measured("marschner", k_truth, 0, 0.01, 1e-5, 1);
  const ModelFit fit = fitted("marschner", "", {"eta", "sigma_a", "beta"}, data);
  EXPECT_THAT(fit.inseparable,
              UnorderedElementsAre(UnorderedElementsAre("sigma_a.r"), UnorderedElementsAre("sigma_a.g"),
                                   UnorderedElementsAre("sigma_a.b")));
}

TEST(FitModel, AProductOfTwo_CannotTellThemApart) {
  Measurements data = measured("scheuermann", "", 0, 0.01, 1e-5, 1);
  data.one_number = true;
  const ModelFit fit = fitted("scheuermann", "base=0.6,diffuse=0.7", {"base", "diffuse"}, data);
  EXPECT_THAT(fit.inseparable, UnorderedElementsAre(UnorderedElementsAre("base", "diffuse")));
}

TEST(FitModel, BadRequests_AreErrorsThatSayWhy) {
  const Measurements data = measured("marschner", k_truth, -1, 0.01, 1e-4, 1);
  const auto error = [&](std::string_view name, std::vector<std::string> free, const Measurements& rows) {
    return fit_model({&model(name), settings(name, ""), std::move(free), Loss::squares}, rows).error().message;
  };
  EXPECT_THAT(error("marschner", {"gamma"}, data), testing::HasSubstr("gamma of marschner is not one of eta, sigma_a"));
  EXPECT_THAT(error("marschner", {"variant"}, data), testing::HasSubstr("not one of"));
  EXPECT_THAT(error("marschner", {"eta", "eta"}, data), testing::HasSubstr("given twice"));
  EXPECT_THAT(error("huang", {"eta"}, data), testing::HasSubstr("no derivatives"));
  Measurements few = data;
  few.rows.resize(1);
  EXPECT_THAT(error("marschner", {"eta", "beta", "alpha"}, few), testing::HasSubstr("3 numbers cannot fix 3"));
  Measurements unsure = data;
  unsure.sigma_known = true;
  unsure.rows[1].sigma = 0;
  EXPECT_THAT(error("marschner", {"eta"}, unsure), testing::HasSubstr("row 2: sigma 0"));
}

}  // namespace
}  // namespace cuticle::lut::model_fit_test
