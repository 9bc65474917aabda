// Averages of an azimuthal term over phi: by quadrature, against integrals in closed form, where the source stands in
// for a model; and a model's own, against the rays through a fibre.
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "core/quadrature.h"
#include "lut/cell_average.h"

namespace cuticle::lut::lut_average_test {
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

const bsdf::Model& marschner() { return *bsdf::find_model("marschner").value(); }
registry::ParameterValues settings(const std::string& text) {
  return bsdf::parse_settings(marschner(), "", text).value();
}

/// A smooth round fibre of Bravais index `index` at one theta_d, by its rays: gamma in [-pi/2, pi/2] leaves TRT at
/// 4 gamma_t - 2 gamma, which rises between -gamma_c and gamma_c and falls beyond.
class Rays {
 public:
  Rays(std::string text, double eta, double theta_d) : values_(settings(text)), theta_d_(theta_d) {
    index_ = std::sqrt(eta * eta - std::pow(std::sin(theta_d), 2)) / std::cos(theta_d);
    const double turn = index_ < 2 ? std::asin(std::sqrt((4 - index_ * index_) / 3)) : 0;
    bends_ = {-std::numbers::pi / 2, -turn, turn, std::numbers::pi / 2};
  }
  double caustic() const { return azimuth(bends_[2]); }
  /// Half the integral of A over the h that leave between the azimuths, over their distance.
  double mean(double begin, double end) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double a = crossing(bends_[k], bends_[k + 1], begin), b = crossing(bends_[k], bends_[k + 1], end);
      sum += integrate_adaptive([&](double gamma) { return attenuation(gamma) * std::cos(gamma); }, std::min(a, b),
                                std::max(a, b))
                 .value;
    }
    return sum / 2 / (end - begin);
  }

 private:
  double azimuth(double gamma) const { return 4 * std::asin(std::sin(gamma) / index_) - 2 * gamma; }
  double attenuation(double gamma) const {
    const bsdf::Point point{.theta_d = theta_d_, .h = std::sin(gamma)};
    glm::dvec3 value;
    marschner().evaluate_f64(values_, {bsdf::Quantity::A, 2, {&point, 1}}, {&value, 1});
    return value.y;
  }
  /// Where a monotone stretch passes an azimuth, by halving; its nearer end where it does not.
  double crossing(double lower, double upper, double phi) const {
    const bool rises = azimuth(upper) > azimuth(lower);
    for (int k = 0; k < 60; ++k) {
      const double middle = (lower + upper) / 2;
      ((azimuth(middle) < phi) == rises ? lower : upper) = middle;
    }
    return (lower + upper) / 2;
  }
  registry::ParameterValues values_;
  double theta_d_, index_;
  std::array<double, 4> bends_;
};

/// A cell of every width that tables of 16 .. 128 have, one of them on the caustic where there is one.
TEST(AverageOverPhi, TrtOfASmoothFibre_IsTheRaysWithin4e6) {
  const Channel channel{"N_TRT", bsdf::Quantity::N, "TRT", 0, Texel::cell_average};
  for (const auto& [eta, theta_d] :
       {std::pair(1.55, 0.0), {1.55, 0.6}, {1.55, 0.9}, {1.55, 1.5}, {1.1, 0.3}, {2.6, 0.2}}) {
    const std::string text = fmt::format("eta={},sigma_a=0.1/0.4/1.5", eta);
    const Rays rays(text, eta, theta_d);
    const double peak = rays.caustic();
    std::vector<PhiInterval> cells = {
        {theta_d, 0, 0.13}, {theta_d, 0.13, 0.5}, {theta_d, 2.4, 2.416}, {theta_d, 2.7, 3.1415}};
    if (peak > 0.02) cells.push_back({theta_d, peak - 0.012, peak + 0.004});
    const PhiAverages result = average_over_phi(cpu_source(marschner(), settings(text)), channel, cells).value();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const double exact = rays.mean(cells[i].begin, cells[i].end);
      EXPECT_NEAR(result.values[i].y, exact, 4e-6 * exact + 1e-9) << text << " " << theta_d << " " << i;
      EXPECT_EQ(result.singular[i], cells[i].begin <= peak && peak <= cells[i].end && peak > 0) << text << " " << i;
    }
  }
}

}  // namespace
}  // namespace cuticle::lut::lut_average_test
