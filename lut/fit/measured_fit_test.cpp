// A measured fibre whose truth is known: found again up to a factor, and judged where it was not fitted.
#include "lut/fit/measured_fit.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::lut::measured_fit_test {
namespace {

constexpr double k_degree = 0.017453292519943295;

/// karis at a gantry's directions, 3.5 times too bright.
bsdf::MeasuredFibre gantry_of_karis() {
  bsdf::MeasuredFibre fibre;
  std::vector<bsdf::Point> points;
  for (double theta = 12; theta <= 48; theta += 4)
    for (double phi = -18; phi <= 198; phi += 6)
      points.push_back({.theta_i = theta * k_degree, .theta_o = -30 * k_degree, .phi = phi * k_degree});
  const bsdf::Model& karis = *bsdf::find_model("karis").value();
  std::vector<glm::dvec3> values(points.size());
  EXPECT_TRUE(bsdf::evaluate(karis,
                             bsdf::parse_settings(karis, "", "color=0.5/0.5/0.5,roughness=0.35,shift=0.06").value(),
                             bsdf::Precision::f64, {bsdf::Quantity::S, -1, points}, values)
                  .ok());
  for (std::size_t i = 0; i < points.size(); ++i)
    fibre.directions.push_back({points[i].theta_i, points[i].theta_o, points[i].phi, 3.5 * values[i], 0});
  return fibre;
}

TEST(MeasuredFit, TheModelThatMadeTheFile_IsFoundWithItsFactor) {
  const bsdf::MeasuredFibre fibre = gantry_of_karis();
  const auto found = fit_measured({.model = bsdf::find_model("karis").value()}, fibre);
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_NEAR(found->fit.scale, 3.5, 0.01);
  EXPECT_NEAR(found->fit.values.real("roughness"), 0.35, 1e-3);
  EXPECT_NEAR(found->fit.values.real("shift"), 0.06, 1e-3);
  EXPECT_LT(judged_error(*found, fibre), 1e-3);
}

TEST(MeasuredFit, AnotherModel_IsJudgedWorse) {
  const bsdf::MeasuredFibre fibre = gantry_of_karis();
  const auto other = fit_measured({.model = bsdf::find_model("kajiya_kay").value()}, fibre);
  ASSERT_TRUE(other.ok()) << other.error().message;
  EXPECT_GT(judged_error(*other, fibre), 0.1);
}

TEST(MeasuredFit, Differences_FindWhatDerivativesFind) {
  const bsdf::MeasuredFibre fibre = gantry_of_karis();
  const bsdf::Model& karis = *bsdf::find_model("karis").value();
  Measurements data;
  data.one_number = data.relative = true;
  for (const bsdf::MeasuredDirection& at : fibre.directions)
    data.rows.push_back({{.theta_i = at.theta_i, .theta_o = at.theta_o, .phi = at.phi}, -1, at.value, 0});
  const FitRequest request{.model = &karis,
                           .start = bsdf::parse_settings(karis, "", "color=0.5/0.5/0.5").value(),
                           .free = {"roughness", "shift"}};
  FitRequest differences = request;
  differences.by_differences = true;
  const auto a = fit_model(request, data), b = fit_model(differences, data);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_NEAR(a->values.real("roughness"), b->values.real("roughness"), 1e-6);
  EXPECT_NEAR(a->scale, b->scale, 1e-5);
}

TEST(MeasuredFit, Zones_AreTheLobesOfAFibreWhoseScalesLeanToTheTip) {
  EXPECT_EQ(zone_of({.theta_i = 0.4, .theta_o = -0.5, .phi = 0}), LobeZone::r);
  EXPECT_EQ(zone_of({.theta_i = 0.6, .theta_o = -0.5, .phi = 6.2}), LobeZone::trt);
  EXPECT_EQ(zone_of({.theta_i = 0.4, .theta_o = -0.5, .phi = 3.2}), LobeZone::tt);
}

TEST(MeasuredFit, FewDirections_AreRefused) {
  bsdf::MeasuredFibre fibre = gantry_of_karis();
  fibre.directions.resize(7);
  EXPECT_THAT(fit_measured({.model = bsdf::find_model("karis").value()}, fibre).error().message,
              testing::HasSubstr("needs 8"));
}

}  // namespace
}  // namespace cuticle::lut::measured_fit_test
