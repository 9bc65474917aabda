// S of one viewer and many lights at once, against S light by light; the mean over turns of a flat cross-section, which
// takes many lights, against the mean over viewers.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/model.h"

namespace cuticle::bsdf::huang::huang_lights_test {
namespace {

const Model& model() { return **find_model("huang"); }
registry::ParameterValues values_of(const std::string& settings, int samples) {
  return *parse_settings(model(), "", settings + ",samples=" + std::to_string(samples));
}

/// Lights evenly over the sphere.
std::vector<Point> lights_of(double theta_o, double h, int count, double phi_o = 0.4) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    Point& at = points.emplace_back();
    at.theta_i = std::asin(2 * (i + 0.5) / count - 1);
    at.theta_o = theta_o;
    at.phi = std::remainder(i * 2.399963229728653, 6.283185307179586);
    at.phi_o = phi_o;
    at.h = h;
  }
  return points;
}

std::vector<glm::dvec3> many(const registry::ParameterValues& values, int effort, const std::vector<Point>& points,
                             int lobe = -1) {
  std::vector<glm::dvec3> out(points.size());
  EXPECT_TRUE(*scattering_from_viewers(model(), values, effort, lobe, points, out));
  return out;
}
std::vector<glm::dvec3> one_by_one(const registry::ParameterValues& values, const std::vector<Point>& points,
                                   int lobe = -1) {
  std::vector<glm::dvec3> out(points.size());
  EXPECT_TRUE(evaluate(model(), values, Precision::f64, {Quantity::S, lobe, points}, out).ok());
  return out;
}

struct Difference {
  double rms = 0, sum = 0;  ///< relative
};
Difference between(const std::vector<glm::dvec3>& made, const std::vector<glm::dvec3>& truth) {
  double squares = 0, signal = 0, sum = 0, whole = 0;
  for (std::size_t i = 0; i < made.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      squares += std::pow(made[i][c] - truth[i][c], 2);
      signal += std::pow(truth[i][c], 2);
      sum += made[i][c] - truth[i][c];
      whole += truth[i][c];
    }
  return {std::sqrt(squares / signal), sum / whole};
}

struct Fibre {
  std::string settings;
  double theta_o, h;
};

TEST(HuangLights, OfOneViewer_AreThoseOneByOne) {
  const std::string colour = "sigma_a=0.1/0.3/0.8,";
  for (const Fibre& fibre : {Fibre{colour + "roughness=0.1", 0.6, 0}, Fibre{colour + "roughness=0.3,tilt=0.1", -0.9, 0},
                             Fibre{colour + "aspect=0.6", 0, 0}, Fibre{colour + "facets=single", 0.3, 0},
                             Fibre{colour + "field=near,roughness=0.3", 0.3, -0.7}}) {
    const std::vector<Point> points = lights_of(fibre.theta_o, fibre.h, 100);
    const Difference d =
        between(many(values_of(fibre.settings, 512), 16, points), one_by_one(values_of(fibre.settings, 2048), points));
    std::printf("%s: rms %.4f, sum %.4f\n", fibre.settings.c_str(), d.rms, d.sum);
    EXPECT_LT(d.rms, 0.06) << fibre.settings;
    EXPECT_LT(std::abs(d.sum), 0.01) << fibre.settings;
  }
}

/// All that a clear fibre scatters is the light that arrives, round or over turns of an ellipse.
TEST(HuangLights, OfAClearFibre_AddUpToTheLightThatArrives) {
  for (const char* settings : {"sigma_a=0,roughness=0.3", "sigma_a=0,roughness=0.3,aspect=0.6,turns=12"}) {
    const std::vector<Point> points = lights_of(0.3, 0, 4000);
    double sum = 0;
    for (const glm::dvec3& value : many(values_of(settings, 1024), 2, points))
      sum += value.x * 4 * 3.141592653589793 / double(points.size());
    std::printf("%s: %.4f\n", settings, sum);
    EXPECT_NEAR(sum, 1, 0.01) << settings;
  }
}

TEST(HuangLights, OfEachLobe_AddUpAndAreThoseOneByOne) {
  const auto values = values_of("roughness=0.3", 2048);
  const std::vector<Point> points = lights_of(0.4, 0, 60);
  std::vector<glm::dvec3> sum(points.size(), glm::dvec3(0));
  for (int lobe = 0; lobe < 4; ++lobe) {
    const std::vector<glm::dvec3> made = many(values, 8, points, lobe);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += made[i];
    const Difference d = between(made, one_by_one(values, points, lobe));
    std::printf("lobe %d: rms %.4f, sum %.4f\n", lobe, d.rms, d.sum);
    EXPECT_LT(std::abs(d.sum), lobe < 2 ? 0.01 : 0.05) << lobe;
  }
  EXPECT_LT(between(sum, many(values, 8, points)).rms, 1e-5);
}

/// A value depends on its viewer and its light alone.
TEST(HuangLights, AmongOtherViewers_AreTheSameBits) {
  const auto values = values_of("roughness=0.3", 256);
  const std::vector<Point> first = lights_of(0.5, 0, 70), second = lights_of(-0.2, 0, 3);
  std::vector<Point> both = first;
  both.insert(both.end(), second.begin(), second.end());
  std::vector<glm::dvec3> apart = many(values, 1, first);
  for (const glm::dvec3& value : many(values, 1, second)) apart.push_back(value);
  EXPECT_EQ(many(values, 1, both), apart);
  EXPECT_EQ(many(values, 1, {first[69]}).front(), apart[69]);
}

std::vector<glm::dvec3> mean_over_viewers(const registry::ParameterValues& values, int lobe, int viewers) {
  std::vector<glm::dvec3> mean(96, glm::dvec3(0));
  for (int k = 0; k < viewers; ++k) {
    const double phi_o = 6.283185307179586 * (k + 0.5) / viewers;
    const std::vector<glm::dvec3> seen = many(values, 1, lights_of(-0.3, 0.4, 96, phi_o), lobe);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += seen[i] / double(viewers);
  }
  return mean;
}

TEST(HuangTurns, OfR_AreTheMeanOverViewers) {
  const std::string single = "facets=single,aspect=0.6,roughness=0.2";
  for (const std::string& settings : {single, single + ",field=near"}) {
    const auto made = many(values_of(settings + ",turns=12", 64), 1, lights_of(-0.3, 0.4, 96), 0);
    EXPECT_LT(between(made, mean_over_viewers(values_of(settings, 64), 0, 24)).rms, 1e-4) << settings;
  }
}

TEST(HuangTurns, OfAllLobes_AreTheMeanOverViewers) {
  const std::string flat = "sigma_a=0.1/0.3/0.8,aspect=0.6,roughness=0.3";
  const std::vector<Point> points = lights_of(-0.3, 0.4, 96);
  const auto made = many(values_of(flat + ",turns=12", 16384), 1, points);
  const Difference together = between(made, mean_over_viewers(values_of(flat, 1024), -1, 24));
  const Difference apart = between(one_by_one(values_of(flat + ",turns=12", 4096), points), made);
  std::printf("over viewers: rms %.4f, sum %.4f; one by one: rms %.4f, sum %.4f\n", together.rms, together.sum,
              apart.rms, apart.sum);
  EXPECT_LT(together.rms, 0.03);
  EXPECT_LT(std::abs(together.sum), 0.008);
  EXPECT_LT(apart.rms, 0.04);
  EXPECT_LT(std::abs(apart.sum), 0.01);
}

TEST(HuangTurns, KnowNoViewersAzimuth) {
  const auto values = values_of("aspect=0.6,turns=6", 256);
  EXPECT_LT(between(many(values, 1, lights_of(-0.3, 0, 20, 1.3)), many(values, 1, lights_of(-0.3, 0, 20, 0))).rms,
            1e-9);
}

double seconds_of(auto&& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// On one thread, where one by one takes all.
TEST(HuangLights, OfOneViewer_TakeAFractionOfTheTime) {
  const auto values = values_of("", 512);
  const std::vector<Point> points = lights_of(0.3, 0, 512);
  const double together = seconds_of([&] { many(values, 1, points); });
  const double apart = seconds_of([&] { one_by_one(values, points); });
  std::printf("%.1f and %.1f microseconds a point\n", together / 512 * 1e6, apart / 512 * 1e6);
  EXPECT_LT(together, 0.25 * apart);
}

TEST(HuangLights, OfOtherModels_AreNotMadeTogether) {
  std::vector<glm::dvec3> out(1);
  EXPECT_FALSE(*scattering_from_viewers(**find_model("deon"), *parse_settings(**find_model("deon"), "", ""), 1, -1,
                                        lights_of(0, 0, 1), out));
}

TEST(HuangLights, OutOfRange_AreRefusedByName) {
  std::vector<Point> points = lights_of(0, 0, 2);
  points[1].theta_i = 2;
  std::vector<glm::dvec3> out(2);
  const auto result = scattering_from_viewers(model(), values_of("", 64), 1, -1, points, out);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, testing::HasSubstr("point 1: theta_i = 2"));
}

}  // namespace
}  // namespace cuticle::bsdf::huang::huang_lights_test
