// Every registered model in float and on the device against double: at random points, at the edges of its domain, and
// in what it draws.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bsdf/model.h"
#include "core/random.h"
#ifdef CUTICLE_HAS_GPU
#include "tests/support/model_on_device.h"
#endif

namespace cuticle::bsdf::models_parity_test {
namespace {

constexpr double pi = std::numbers::pi;

bool same_choices(const Model& model, const registry::ParameterValues& a, const registry::ParameterValues& b) {
  return std::ranges::all_of(model.entry.parameters, [&](const registry::Parameter& p) {
    return p.type != registry::ParameterType::choice || a.choice(p.name) == b.choice(p.name);
  });
}

/// The defaults, at the coarsest of the model's tiers that is the same function: what is compared does not hang on the
/// tier.
registry::ParameterValues coarse_defaults(const Model& model) {
  const registry::ParameterValues defaults = registry::default_values(model.entry.parameters);
  for (const registry::StudyCase& tier : model.entry.study_cases) {
    const registry::ParameterValues values = parse_settings(model, "", tier.settings).value();
    if (same_choices(model, values, defaults)) return values;
  }
  return defaults;
}

/// The defaults, and what is hard: each named parameter at an end of its range.
std::vector<registry::ParameterValues> settings_of(const Model& model) {
  const registry::ParameterValues defaults = coarse_defaults(model);
  std::vector<registry::ParameterValues> all = {defaults};
  for (const registry::Parameter& p : model.entry.parameters) {
    const bool rgb = p.type == registry::ParameterType::rgb;
    if (!rgb && p.type != registry::ParameterType::real) continue;
    for (double end : {p.minimum, p.maximum}) {
      all.push_back(defaults);
      all.back().set(p.name, rgb ? registry::Value(glm::dvec3(end)) : registry::Value(end));
    }
  }
  return all;
}

/// Every combination of the inclinations, azimuths and offsets at which formulas divide by 0, with a few in between.
std::vector<Point> edge_points() {
  constexpr double right = pi / 2, near = 89.999 / 180 * pi;
  std::vector<Point> points;
  for (double theta_i : {-right, -near, 0.0, right})
    for (double theta_o : {-right, 0.0, near})
      for (double phi : {0.0, 1e-7, 2.0, -pi})
        for (double h : {-1.0, 0.0, 1.0})
          points.push_back({theta_i, theta_o, std::clamp(0.5 * (theta_o - theta_i), -right, right), phi, h, 0.7});
  return points;
}

/// All edge points for the defaults, and for the settings that follow a quarter of them in turn.
std::vector<Point> edge_points_for(std::size_t setting) {
  const std::vector<Point> all = edge_points();
  if (setting == 0) return all;
  std::vector<Point> some;
  for (std::size_t i = setting % 4; i < all.size(); i += 4) some.push_back(all[i]);
  return some;
}

/// Away from the poles and from the fibre's edge, where narrowing the point itself to float moves the value.
std::vector<Point> random_points(std::size_t count) {
  RandomStream random(4);
  const auto within = [&](double limit) { return limit * (2 * random.next_unit() - 1); };
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    Point point{
        .theta_o = within(1.4), .theta_d = within(1.4), .phi = within(pi), .h = within(0.95), .phi_o = within(pi)};
    point.theta_i = std::clamp(-point.theta_o + within(0.6), -1.5, 1.5);
    points.push_back(point);
  }
  return points;
}

std::vector<SampleQuery> queries(std::size_t count) {
  RandomStream random(5);
  std::vector<SampleQuery> all;
  for (const Point& point : edge_points())
    all.push_back({.theta_o = point.theta_o, .phi_o = point.phi_o, .h = point.h});
  for (const Point& point : random_points(count))
    all.push_back({.theta_o = point.theta_o, .phi_o = point.phi_o, .h = point.h});
  for (SampleQuery& query : all)
    for (double& u : query.u) {
      const double kind = random.next_unit();
      u = kind < 0.05 ? 0 : kind < 0.1 ? 1 - 0x1p-53 : random.next_unit();
    }
  return all;
}

std::vector<glm::dvec3> on_cpu(const Model& model, const registry::ParameterValues& values, Precision precision,
                               Quantity quantity, const std::vector<Point>& points) {
  std::vector<glm::dvec3> out(points.size());
  EXPECT_TRUE(evaluate(model, values, precision, {quantity, -1, points}, out).ok());
  return out;
}

void expect_finite(const std::vector<glm::dvec3>& values, const std::vector<Point>& points, const std::string& what) {
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_TRUE(std::isfinite(values[i][c]) && values[i][c] >= 0)
          << what << ": " << values[i][c] << " at theta_i " << points[i].theta_i << ", theta_o " << points[i].theta_o
          << ", theta_d " << points[i].theta_d << ", phi " << points[i].phi << ", h " << points[i].h;
}

void expect_sound(const std::vector<Sample>& samples, const std::string& what) {
  for (const Sample& s : samples) {
    ASSERT_TRUE(std::abs(s.theta_i) <= pi / 2 * (1 + 1e-6) && std::isfinite(s.phi)) << what;
    ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf >= 0) << what;
    for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(s.weight[c]) && s.weight[c] >= 0) << what;
  }
}

/// The difference that all but one point in a hundred stay below, relative to the largest value: a caustic or the end
/// of a lobe within float's reach of a point moves it by more.
double typical_difference(const std::vector<glm::dvec3>& truth, const std::vector<glm::dvec3>& result) {
  std::vector<double> differences;
  double largest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      differences.push_back(std::abs(truth[i][c] - result[i][c]));
      largest = std::max(largest, truth[i][c]);
    }
  const auto place = differences.begin() + std::ptrdiff_t(differences.size() * 99 / 100);
  std::nth_element(differences.begin(), place, differences.end());
  return largest > 0 ? *place / largest : 0;
}

std::string settings_text(const Model& model, const registry::ParameterValues& values) {
  std::string text(model.entry.name);
  for (const auto& [name, value] : values.all()) text += " " + name + "=" + registry::to_text(value);
  return text;
}

constexpr Quantity values_of_models[] = {Quantity::S, Quantity::M,      Quantity::N,
                                         Quantity::A, Quantity::albedo, Quantity::pdf};
/// The estimate of S's error too, which is of a precision and agrees with no other.
constexpr Quantity quantities[] = {Quantity::S,      Quantity::M,   Quantity::N,    Quantity::A,
                                   Quantity::albedo, Quantity::pdf, Quantity::error};
static_assert(std::size(quantities) == quantity_count);

/// Every point for what is drawn and shaded by; every eighth for the parts, which some models integrate from S.
std::vector<Point> points_for(Quantity quantity, const std::vector<Point>& all) {
  const bool whole = quantity == Quantity::S || quantity == Quantity::pdf || quantity == Quantity::error;
  if (whole) return all;
  std::vector<Point> some;
  for (std::size_t i = 0; i < all.size(); i += 8) some.push_back(all[i]);
  return some;
}

#ifdef CUTICLE_HAS_GPU
/// Whether the kernel takes no more loop rounds than software Vulkan runs; others are refused there.
bool fits_software_loops(const Model& model, const registry::ParameterValues& values, Quantity quantity) {
  return !model.loop_rounds || model.loop_rounds(values, quantity) <= 65535;
}
#endif

class ModelsParity : public testing::TestWithParam<const Model*> {};
INSTANTIATE_TEST_SUITE_P(Registry, ModelsParity, testing::ValuesIn(models().begin(), models().end()),
                         [](const auto& at) { return std::string(at.param->entry.name); });

TEST_P(ModelsParity, EdgesOfTheDomain_AreFiniteInFloatAndDouble) {
  const std::vector<registry::ParameterValues> settings = settings_of(*GetParam());
  for (std::size_t k = 0; k < settings.size(); ++k) {
    for (Quantity quantity : quantities) {
      const std::vector<Point> points = points_for(quantity, edge_points_for(k));
      for (Precision precision : {Precision::f32, Precision::f64})
        expect_finite(on_cpu(*GetParam(), settings[k], precision, quantity, points), points,
                      settings_text(*GetParam(), settings[k]) + " quantity " + std::to_string(int(quantity)));
    }
  }
}

TEST_P(ModelsParity, RandomPoints_AgreeInFloat) {
  const registry::ParameterValues values = coarse_defaults(*GetParam());
  for (Quantity quantity : values_of_models) {
    const std::vector<Point> points = points_for(quantity, random_points(400));
    const auto truth = on_cpu(*GetParam(), values, Precision::f64, quantity, points);
    const double off = typical_difference(truth, on_cpu(*GetParam(), values, Precision::f32, quantity, points));
    RecordProperty("quantity_" + std::to_string(int(quantity)), std::to_string(off * 1e9));
    // A walk that turns otherwise in float is one path of the mean's thousands.
    EXPECT_LE(off, GetParam()->loop_rounds ? 5e-5 : 1e-5) << "quantity " << int(quantity);
  }
}

TEST_P(ModelsParity, Samples_AreSoundInFloatAndDouble) {
  if (!GetParam()->sample_f64) GTEST_SKIP() << "no sampler";
  const std::vector<SampleQuery> all = queries(60);
  std::vector<Sample> samples(all.size());
  for (const registry::ParameterValues& values : settings_of(*GetParam()))
    for (Precision precision : {Precision::f32, Precision::f64}) {
      ASSERT_TRUE(sample(*GetParam(), values, precision, all, samples).ok());
      expect_sound(samples, settings_text(*GetParam(), values));
    }
}

#ifdef CUTICLE_HAS_GPU
TEST_P(ModelsParity, DeviceAtRandomPoints_AgreesWithDouble) {
  GpuEvaluator& evaluator = tests::evaluator_of(*GetParam());
  const registry::ParameterValues values = coarse_defaults(*GetParam());
  for (Quantity quantity : values_of_models) {
    const std::vector<Point> points = points_for(quantity, random_points(400));
    std::vector<glm::dvec3> result(points.size());
    if (!fits_software_loops(*GetParam(), values, quantity)) {
      EXPECT_EQ(evaluator.evaluate(values, {quantity, -1, points}, result).error().kind, ErrorKind::usage);
      continue;
    }
    ASSERT_TRUE(evaluator.evaluate(values, {quantity, -1, points}, result).ok());
    // An albedo is a sum over hundreds of nodes.
    EXPECT_LE(typical_difference(on_cpu(*GetParam(), values, Precision::f64, quantity, points), result),
              quantity == Quantity::albedo ? 3e-5 : 2e-5)
        << int(quantity);
  }
}

TEST_P(ModelsParity, DeviceAtTheEdgesOfTheDomain_IsFinite) {
  GpuEvaluator& evaluator = tests::evaluator_of(*GetParam());
  const std::vector<registry::ParameterValues> settings = settings_of(*GetParam());
  for (std::size_t k = 0; k < settings.size(); ++k) {
    for (Quantity quantity : quantities) {
      if (!fits_software_loops(*GetParam(), settings[k], quantity)) continue;
      const std::vector<Point> points = points_for(quantity, edge_points_for(k));
      std::vector<glm::dvec3> result(points.size());
      ASSERT_TRUE(evaluator.evaluate(settings[k], {quantity, -1, points}, result).ok());
      expect_finite(result, points,
                    settings_text(*GetParam(), settings[k]) + " quantity " + std::to_string(int(quantity)));
    }
  }
}

TEST_P(ModelsParity, DeviceSamples_AreSoundAndThoseOfFloat) {
  if (!GetParam()->sample_f32) GTEST_SKIP() << "no sampler";
  GpuEvaluator& evaluator = tests::evaluator_of(*GetParam());
  const std::vector<SampleQuery> all = queries(300);
  std::vector<Sample> samples(all.size()), expected(all.size());
  for (const registry::ParameterValues& values : settings_of(*GetParam())) {
    const auto done = evaluator.sample(values, all, samples);
    ASSERT_TRUE(done.ok()) << done.error().message;
    expect_sound(samples, settings_text(*GetParam(), values));
  }
  const registry::ParameterValues values = coarse_defaults(*GetParam());
  ASSERT_TRUE(evaluator.sample(values, all, samples).ok());
  ASSERT_TRUE(sample(*GetParam(), values, Precision::f32, all, expected).ok());
  std::size_t other = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    other += std::abs(samples[i].theta_i - expected[i].theta_i) > 1e-3 ? 1u : 0u;
  EXPECT_LE(other, all.size() / 100) << "directions drawn otherwise than on the CPU";
}
#endif

}  // namespace
}  // namespace cuticle::bsdf::models_parity_test
