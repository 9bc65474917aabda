// What the checks are made of, each against a known answer.
#include "study/model_check/model_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "study/model_check/checks/checks.h"
#include "study/model_check/checks/chi_square.h"
#include "study/model_check/gallery/gallery.h"
#include "study/model_check/mean_attenuation.h"
#include "study/model_check/registered.h"
#include "study/model_check/report.h"
#include "study/model_check/sphere_quadrature.h"

namespace cuticle::study::model_check::model_check_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(SphereQuadrature, Even_IsTheSphere) {
  const Batch one = [](std::span<const bsdf::Point>, std::span<glm::dvec3> out) {
    std::fill(out.begin(), out.end(), glm::dvec3(1));
  };
  const SphereIntegral sum = integrate_sphere(one, {}, {{-pi / 2, 0, pi / 2}, {-pi, pi}}, {.absolute = 1e-6});
  EXPECT_TRUE(sum.converged);
  EXPECT_NEAR(sum.value.x, 4 * pi, 1e-6);
}

// As 1 / sqrt(x) at a caustic.
TEST(SphereQuadrature, InverseRootInPhi_Converges) {
  const Batch root = [](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = glm::dvec3(points[i].phi < 1 ? 1 / std::sqrt(1 - points[i].phi) : 0);
  };
  const SphereIntegral sum = integrate_sphere(root, {}, {{-pi / 2, pi / 2}, {-pi, 0, pi}}, {.absolute = 1e-3});
  EXPECT_NEAR(sum.value.x, 4 * std::sqrt(1 + pi), 4e-3);
}

class NarrowLobe : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Views, NarrowLobe, testing::Values(0.0, 0.6, -1.4, 1.569));
TEST_P(NarrowLobe, OfAThousandthOfARadian_KeepsItsEnergy) {
  const std::optional<Scatterer> fibre =
      exhibit(Cause::none).make({Absorption::none, Roughness::narrowest, Tilt::given});
  const SphereIntegral sum = scattered_energy(*fibre, {.theta_o = GetParam(), .h = 0.3});
  EXPECT_NEAR(sum.value.x, 1, 4e-4);
}

// Half the sphere is integrated where the function is the same on both sides, all of it where it is not.
TEST(Partition, OfEvenAndUnevenLobes_CoversWhatItMust) {
  const auto energy = [](double slope) {
    Scatterer lobe;
    lobe.scattering = [slope](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::dvec3(1 + slope * std::sin(points[i].phi));
    };
    const Partition partition = partition_for(lobe, {});
    EXPECT_EQ(partition.even, slope == 0);
    return integrate_sphere(lobe.scattering, {}, partition).value.x;
  };
  EXPECT_NEAR(energy(0), 4 * pi, 1e-6);
  EXPECT_NEAR(energy(0.9), 4 * pi, 1e-6);
}

// The azimuths of huang's samples are Cauchy's: half a per mille lies beyond a radian, on rings of a thousandth of one.
TEST(Partition, OfLobesWithTailsAlongRings_CoversTheRings) {
  const bsdf::Model& model = **bsdf::find_model("huang");
  const Subject subject = subject_of(model, *bsdf::parse_settings(model, "", "field=near"), bsdf::Precision::f64);
  const std::optional<Scatterer> fibre =
      subject.make({Absorption::given, Roughness::narrowest, Tilt::given, Effort::draft});
  const bsdf::Point view{.theta_o = 0, .h = -0.95, .phi_o = 0.7};
  EXPECT_NEAR(integrate_sphere(fibre->pdf, view, partition_for(*fibre, view)).value.x, 1, 3e-4);
}

// At the view itself narrow lobes give nothing, and no error of it either.
TEST(Averages, OfNarrowLobes_AreKnownByTheErrorsAtTheirSamples) {
  const auto is_average = [](std::string_view name) {
    const bsdf::Model& model = **bsdf::find_model(name);
    const Subject subject = subject_of(model, *bsdf::parse_settings(model, "", ""), bsdf::Precision::f64);
    return averages(*subject.make({Absorption::none, Roughness::narrowest, Tilt::strong}), {.theta_o = 0.6});
  };
  EXPECT_TRUE(is_average("deon"));
  EXPECT_FALSE(is_average("marschner"));
}

/// Evenly 1 up to a ripple of a tenth, and that as its own error.
void ripple(std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::dvec3(1 + 0.1 * std::sin(300 * points[i].phi));
}
void tenth(std::span<const bsdf::Point>, std::span<glm::dvec3> out) {
  std::fill(out.begin(), out.end(), glm::dvec3(0.1));
}
const Partition quarters{{-pi / 2, 0, pi / 2}, {-pi, 0, pi}};

TEST(SphereQuadrature, BelowTheIntegrandsOwnError_DoesNotDivide) {
  const SphereIntegral sum = integrate_sphere(ripple, {}, quarters, {.absolute = 1e-6, .own_error = tenth});
  EXPECT_EQ(sum.cells.size(), 4u);
  EXPECT_NEAR(sum.value.x, 4 * pi, sum.own_error);
  EXPECT_NEAR(sum.own_error, 0.1 * 4 * pi, 0.2);
}
TEST(SphereQuadrature, OfAnIntegrandThatKnowsTooLittle_EvaluatesNothing) {
  const SphereIntegral sum = integrate_sphere(ripple, {}, quarters, {.own_error = tenth, .most_own_error = 1});
  EXPECT_EQ(sum.evaluations, 0u);
  EXPECT_FALSE(sum.converged);
  EXPECT_GT(sum.own_error, 1);
}

// Q(1/2, 1.92) of one degree of freedom and the tabulated 5 % points (Abramowitz and Stegun, table 26.8).
TEST(ChiSquareTail, KnownQuantiles_GiveTheirProbabilities) {
  EXPECT_NEAR(chi_square_tail(3.841458820694124, 1), 0.05, 1e-12);
  EXPECT_NEAR(chi_square_tail(18.307038053275146, 10), 0.05, 1e-12);
  EXPECT_NEAR(chi_square_tail(124.34211340400407, 100), 0.05, 1e-12);
  EXPECT_NEAR(chi_square_tail(2 * std::log(100.0), 2), 0.01, 1e-14);
  EXPECT_EQ(chi_square_tail(0, 5), 1);
}

TEST(MeanAttenuation, WithoutAbsorptionAndWithAllOrders_IsOne) {
  for (double theta : {0.0, 0.5, -1.3})
    EXPECT_NEAR(mean_attenuation({1.55, glm::dvec3(0), 0}, theta).x, 1, 1e-6) << theta;
}

TEST(MeanAttenuation, OnTheAxisOfAnAbsorber_IsTheTextbooks) {
  const double f = std::pow(0.55 / 2.55, 2), t = std::exp(-0.4);
  const glm::dvec3 energy = attenuation_at({1.55, glm::dvec3(0.2), 3}, 0, 0);
  EXPECT_NEAR(energy.x, f + (1 - f) * (1 - f) * t * (1 + f * t), 1e-14);
}

TEST(MeanAttenuation, SquareOfTheChord_AbsorbsMore) {
  const Cylinder cylinder{1.55, glm::dvec3(1), 3};
  EXPECT_LT(mean_attenuation(cylinder, 0, Physics::squared_path).x, mean_attenuation(cylinder, 0).x - 0.05);
}

TEST(ChiSquareOfASampler, ThatFollowsItsDensity_IsProbable) {
  const std::optional<Scatterer> fibre = exhibit(Cause::none).make({});
  EXPECT_GT(sampler_probability(*fibre, {.theta_o = 0.7, .h = 0.3}, 20000, 1), 1e-3);
}

TEST(ChiSquareOfASampler, ForAnotherDensity_IsImprobable) {
  std::optional<Scatterer> fibre = exhibit(Cause::none).make({});
  fibre->pdf = exhibit(Cause::none).make({Absorption::none})->pdf;
  EXPECT_LT(sampler_probability(*fibre, {.theta_o = 0.7, .h = 0.3}, 20000, 1), 1e-6);
}

// Beyond the samples' own range a bin is as wide as the sphere, and the tail of a lobe like this one would be missed.
TEST(ChiSquareOfASampler, OfNarrowLobesTowardThePole_IsProbable) {
  const bsdf::Model& karis = **bsdf::find_model("karis");
  const Subject subject = subject_of(karis, *bsdf::parse_settings(karis, "", ""), bsdf::Precision::f64);
  const std::optional<Scatterer> fibre = subject.make({Absorption::given, Roughness::narrow, Tilt::strong});
  EXPECT_GT(sampler_probability(*fibre, {.theta_o = -80 * pi / 180}, 65536, 1), 1e-3);
}

TEST(Checks, SameSeed_GivesTheSameVerdicts) {
  const Check& check = checks()[4];
  EXPECT_EQ(check.name, "chi_square");
  const Subject subject = exhibit(Cause::none);
  EXPECT_EQ(check.run(subject, {.quick = true, .seed = 3}).measured,
            check.run(subject, {.quick = true, .seed = 3}).measured);
}

TEST(Checks, WithoutASampler_AreSkippedWithAReason) {
  Subject subject = exhibit(Cause::none);
  subject.make = [whole = subject.make](const Situation& situation) {
    std::optional<Scatterer> scatterer = whole(situation);
    scatterer->sample = nullptr;
    scatterer->pdf = nullptr;
    return scatterer;
  };
  for (std::size_t k : {3u, 4u, 5u}) {
    const Verdict verdict = checks()[k].run(subject, {.quick = true});
    EXPECT_EQ(verdict.state, State::skipped) << checks()[k].name;
    EXPECT_FALSE(verdict.words.empty());
  }
}

TEST(Variants, OfMarschner_AreItsChoicesAndAnEllipse) {
  EXPECT_EQ(variants_of(**bsdf::find_model("marschner")),
            (std::vector<std::string>{"", "variant=as_published", "aspect=0.85", "caustic=smoothed",
                                      "attenuation_angle=theta_o"}));
}

TEST(Exceptions, OfAVariant_ExcuseNoOther) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const auto excused = [&](std::string_view settings, std::string_view check) {
    const auto found = exceptions_of(model, *bsdf::parse_settings(model, "", settings));
    return std::ranges::any_of(found, [&](const bsdf::Exception& exception) { return exception.check == check; });
  };
  EXPECT_TRUE(excused("variant=as_published", "absorbing_furnace"));
  EXPECT_TRUE(excused("caustic=smoothed", "absorbing_furnace"));
  EXPECT_FALSE(excused("", "absorbing_furnace"));
  EXPECT_TRUE(excused("", "white_furnace"));
  EXPECT_TRUE(excused("alpha=0", "white_furnace"));  // a situation tilts it
  EXPECT_FALSE(excused("attenuation_angle=theta_o", "white_furnace"));
}

/// A far-field fibre of one wide lobe around the mirror direction, times a factor of one's own.
Subject lobe_times(double (*factor)(const bsdf::Point&)) {
  Scatterer scatterer;
  scatterer.label = "function";
  scatterer.scattering = [factor](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = glm::dvec3(0.1 * std::exp(-8 * std::pow(points[i].theta_i + points[i].theta_o, 2)) * factor(points[i]));
  };
  return fixed_subject(scatterer, false, true, false);
}

State state_of(std::string_view name, double (*factor)(const bsdf::Point&)) {
  for (const Check& check : checks())
    if (check.name == name) return check.run(lobe_times(factor), {.quick = true}).state;
  return State::skipped;
}

TEST(EachCheck, OfASoundLobe_Passes) {
  for (const char* name : {"white_furnace", "reciprocity", "lobe_tails", "caustic_continuity", "finite"})
    EXPECT_EQ(state_of(name, [](const bsdf::Point&) { return 1.0; }), State::passed) << name;
}

TEST(EachCheck, WhiteFurnaceOfTooMuchEnergy_Fails) {
  EXPECT_EQ(state_of("white_furnace", [](const bsdf::Point&) { return 5.0; }), State::failed);
}

TEST(EachCheck, ReciprocityOfAFactorOfOneDirection_Fails) {
  EXPECT_EQ(state_of("reciprocity", [](const bsdf::Point& at) { return std::cos(at.theta_o); }), State::failed);
}

// Helmholtz's law has S cos(theta_o) symmetric, which a factor of cos(theta_i) is.
TEST(EachCheck, ReciprocityOfLambertsLaw_Passes) {
  EXPECT_EQ(state_of("reciprocity", [](const bsdf::Point& at) { return std::cos(at.theta_i); }), State::passed);
}

// Of an ellipse the viewer sees cos(theta_o) times a width, so S has to be symmetric times both.
TEST(EachCheck, ReciprocityOfAnEllipse_IsThatOfTheAreaSeen) {
  const auto verdict = [](double aspect) {
    Scatterer scatterer;
    scatterer.aspect = aspect;
    scatterer.scattering = [](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
      for (std::size_t i = 0; i < out.size(); ++i) {
        const bsdf::Point& at = points[i];
        out[i] = glm::dvec3(std::cos(at.theta_i) *
                            std::hypot(std::sin(at.phi_o - at.phi), 0.6 * std::cos(at.phi_o - at.phi)));
      }
    };
    return checks()[2].run(fixed_subject(scatterer, false, true, false), {.quick = true}).state;
  };
  EXPECT_EQ(verdict(0.6), State::passed);
  EXPECT_EQ(verdict(1), State::failed);
}

TEST(EachCheck, TailsThatAreCut_Fail) {
  const auto cut = [](const bsdf::Point& at) { return std::abs(at.theta_i + at.theta_o) < 0.8 ? 1.0 : 0.0; };
  EXPECT_EQ(state_of("lobe_tails", cut), State::failed);
}

TEST(EachCheck, TailsWithRipples_Fail) {
  EXPECT_EQ(state_of("lobe_tails", [](const bsdf::Point& at) { return 1 + 0.9 * std::sin(40 * at.theta_i); }),
            State::failed);
}

TEST(EachCheck, EnergyThatJumpsWithInclination_Fails) {
  EXPECT_EQ(state_of("caustic_continuity", [](const bsdf::Point& at) { return at.theta_o > 0.51 ? 1.01 : 1.0; }),
            State::failed);
}

TEST(EachCheck, ValueThatIsNotANumberAtAPole_IsFound) {
  EXPECT_EQ(state_of("finite", [](const bsdf::Point& at) { return at.theta_i > 1.5707 ? std::nan("") : 1.0; }),
            State::failed);
}

TEST(EachCheck, NegativeValueNextToAPole_IsFound) {
  EXPECT_EQ(state_of("finite", [](const bsdf::Point& at) { return at.theta_i < -1.570796 ? -1.0 : 1.0; }),
            State::failed);
}

}  // namespace
}  // namespace cuticle::study::model_check::model_check_test
