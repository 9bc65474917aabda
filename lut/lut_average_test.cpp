// Averages of an azimuthal term over phi, against integrals in closed form. The source stands in for a model.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <cuticle/lut/cell_average.h>

namespace cuticle::lut {
namespace {

constexpr std::string_view k_lobe_names[] = {"only"};
constexpr Channel k_channel{"N", bsdf::Quantity::N, "only", 0, Texel::cell_average};

template <class Term>
Source source_of(Term term) {
  static bsdf::Model model{};
  model.lobes = k_lobe_names;
  const Evaluate evaluate = [term](const bsdf::Request& request, std::span<glm::dvec3> out) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::dvec3(term(request.points[i].phi));
    return Result<void>();
  };
  return {&model, evaluate, evaluate};
}

template <class Term>
PhiAverages averages(Term term, std::vector<PhiInterval> intervals) {
  return average_over_phi(source_of(term), k_channel, intervals).value();
}

/// An infinite peak at phi = 0.37, seen from below only, as a caustic has it, on a floor of 0.2.
constexpr double k_peak = 0.37;
double caustic(double phi) { return 0.2 + (phi < k_peak ? 1 / std::sqrt(k_peak - phi) : 0.0); }
double caustic_mean(double begin, double end) {
  const double inside = std::min(end, k_peak);
  const double peak = inside > begin ? 2 * (std::sqrt(k_peak - begin) - std::sqrt(k_peak - inside)) : 0;
  return 0.2 + peak / (end - begin);
}

TEST(AverageOverPhi, SmoothTerm_EqualsTheIntegral) {
  const PhiAverages result =
      averages([](double phi) { return std::cos(phi / 2) / 4; }, {{0, 0.3, 0.4}, {0, 0, std::numbers::pi}});
  EXPECT_NEAR(result.values[0].x, (std::sin(0.2) - std::sin(0.15)) / 2 / 0.1, 1e-14);
  EXPECT_NEAR(result.values[1].y, 0.5 / std::numbers::pi, 1e-14);
  EXPECT_EQ(result.singular, (std::vector<std::uint8_t>{0, 0}));
}

TEST(AverageOverPhi, InfinitePeakInside_EqualsTheIntegralWithin2e5) {
  for (double begin : {0.30, 0.355, 0.3699}) {
    const PhiAverages result = averages(caustic, {{0, begin, begin + 0.02}, {0, begin, 0.6}});
    EXPECT_NEAR(result.values[0].x / caustic_mean(begin, begin + 0.02), 1, 2e-5) << begin;
    EXPECT_NEAR(result.values[1].x / caustic_mean(begin, 0.6), 1, 2e-5) << begin;
  }
}

TEST(AverageOverPhi, InfinitePeakInside_IsMarkedAndOnlyThere) {
  const PhiAverages result = averages(caustic, {{0, 0.30, 0.32}, {0, 0.36, 0.38}, {0, 0.40, 0.42}});
  EXPECT_EQ(result.singular, (std::vector<std::uint8_t>{0, 1, 0}));
}

TEST(AverageOverPhi, TermThatIsZero_GivesZero) {
  const PhiAverages result = averages([](double) { return 0.0; }, {{0, 0.1, 0.2}});
  EXPECT_EQ(result.values[0], glm::dvec3(0));
  EXPECT_EQ(result.singular[0], 0);
}

TEST(AverageOverPhi, TermThatIsNotANumber_EndsAndIsNotANumber) {
  EXPECT_TRUE(std::isnan(averages([](double) { return std::nan(""); }, {{0, 0.1, 0.2}}).values[0].x));
}

TEST(AverageOverPhi, TermThatIsNoise_EndsNearItsMean) {
  const auto noise = [](double phi) { return 1 + 0.01 * std::sin(1e9 * phi); };
  EXPECT_NEAR(averages(noise, {{0, 0.1, 0.2}}).values[0].x, 1, 1e-3);
}

}  // namespace
}  // namespace cuticle::lut
