// Arrays against the scalar formulas for every instruction set of this processor: values, edges, sizes, threads.
#include "bsdf/batch/batch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "core/registry/parameter.h"
#include "tests/support/batch_data.h"

namespace cuticle::bsdf::batch_test {
namespace {

using ::testing::HasSubstr;
using tests::Arrays, tests::Data;
constexpr double pi = std::numbers::pi;

glm::vec3 vector_at(const Arrays& v, std::size_t i) { return {v.x[i], v.y[i], v.z[i]}; }

const Model& chiang() { return **find_model("chiang"); }
registry::ParameterValues values_of(const std::string& settings) { return *parse_settings(chiang(), "", settings); }
constexpr const char* usual = "field=near,sigma_a=0.2/0.5/1.2,beta_m=0.3,beta_n=0.3";

glm::dvec3 truth(const std::string& settings, Quantity quantity, const Point& point) {
  glm::dvec3 value(0);
  EXPECT_TRUE(evaluate(chiang(), values_of(settings), Precision::f64, {quantity, -1, {&point, 1}}, {&value, 1}).ok());
  return value;
}

class BatchSet : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!is_supported(GetParam())) GTEST_SKIP() << "this processor has no " << name_of(GetParam());
  }
  BatchEvaluator evaluator(const std::string& settings) const {
    return *BatchEvaluator::make(chiang(), values_of(settings), GetParam());
  }
};
INSTANTIATE_TEST_SUITE_P(Sets, BatchSet,
                         testing::Values(InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& info) { return std::string(name_of(info.param)); });

struct Errors {
  std::vector<double> relative;
  void add(double value, double exact) { relative.push_back(std::abs(value - exact) / (exact + 1e-12)); }
  double at(double share) {
    std::ranges::sort(relative);
    return relative[std::size_t(share * double(relative.size() - 1))];
  }
};

TEST_P(BatchSet, Values_AgreeWithDouble) {
  const Data data(5000);
  Arrays color(5000);
  std::vector<float> density(5000);
  ASSERT_TRUE(evaluator(usual).is_vectorised() && evaluator(usual).draws_vectorised());
  ASSERT_TRUE(evaluator(usual).evaluate(data.points(), color.out()).ok());
  ASSERT_TRUE(evaluator(usual).pdf(data.points(), density).ok());
  Errors value_errors, density_errors;
  for (std::size_t i = 0; i < density.size(); ++i) {
    const glm::dvec3 exact = truth(usual, Quantity::S, data.point(i));
    value_errors.add(color.x[i], exact.x);
    value_errors.add(color.y[i], exact.y);
    value_errors.add(color.z[i], exact.z);
    density_errors.add(density[i], truth(usual, Quantity::pdf, data.point(i)).x);
  }
  fmt::print("{}: S median {:.2g} 99 % {:.2g} largest {:.2g}; pdf largest {:.2g}\n", name_of(GetParam()),
             value_errors.at(0.5), value_errors.at(0.99), value_errors.at(1), density_errors.at(1));
  EXPECT_LT(value_errors.at(0.5), 5e-7);
  EXPECT_LT(value_errors.at(0.99), 5e-6);
  EXPECT_LT(value_errors.at(1), 3e-5);
  EXPECT_LT(density_errors.at(1), 3e-5);
}

// The sets differ in the fusing of products and sums alone.
TEST_P(BatchSet, Values_AreThoseOfTheBaselineWithinAFewUlp) {
  const Data data(5000);
  Arrays mine(5000), plain(5000);
  ASSERT_TRUE(evaluator(usual).evaluate(data.points(), mine.out()).ok());
  ASSERT_TRUE((*BatchEvaluator::make(chiang(), values_of(usual), InstructionSet::baseline))
                  .evaluate(data.points(), plain.out())
                  .ok());
  Errors errors;
  for (std::size_t i = 0; i < mine.x.size(); ++i) errors.add(mine.x[i], plain.x[i]);
  EXPECT_LT(errors.at(0.5), 4 * 1.2e-7);
  EXPECT_LT(errors.at(1), 2e-5);
}

TEST_P(BatchSet, PointsOneByOne_AgreeWithTheirBatch) {
  const Data data(500);
  Arrays color(500), drawn(500);
  std::vector<float> density(500);
  const BatchEvaluator batch = evaluator(usual);
  ASSERT_TRUE(batch.evaluate(data.points(), color.out()).ok() && batch.pdf(data.points(), density).ok() &&
              batch.sample(data.queries(), drawn.out()).ok());
  Errors errors;
  for (std::size_t i = 0; i < 500; ++i) {
    const glm::vec3 light = vector_at(data.light, i), viewer = vector_at(data.viewer, i);
    const glm::vec3 value = batch.evaluate(light, viewer, data.h[i]);
    errors.add(value.x, color.x[i]);
    errors.add(value.z, color.z[i]);
    errors.add(batch.pdf(light, viewer, data.h[i]), density[i]);
    const glm::vec3 sample =
        batch.sample(viewer, data.h[i], {data.u[0][i], data.u[1][i], data.u[2][i], data.u[3][i], data.u[4][i]});
    EXPECT_LT(glm::length(sample - vector_at(drawn, i)), 2e-6f) << i;
  }
  EXPECT_LT(errors.at(0.5), 2 * 1.2e-7);
  EXPECT_LT(errors.at(1), 1e-5);
}

/// How many unit vectors are not those of the samples: a random number at the border of two lobes falls on either side.
int samples_apart(const Data& data, const std::vector<Sample>& samples, const Arrays& light) {
  int apart = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double phi_o = std::atan2(double(data.viewer.z[i]), double(data.viewer.y[i])), phi = phi_o - samples[i].phi;
    const glm::dvec3 exact(std::sin(samples[i].theta_i), std::cos(samples[i].theta_i) * std::cos(phi),
                           std::cos(samples[i].theta_i) * std::sin(phi));
    EXPECT_NEAR(light.x[i] * light.x[i] + light.y[i] * light.y[i] + light.z[i] * light.z[i], 1, 4e-6);
    if (glm::length(exact - glm::dvec3(light.x[i], light.y[i], light.z[i])) > 1e-4) ++apart;
  }
  return apart;
}

TEST_P(BatchSet, Samples_AreThoseOfTheScalarSampler) {
  const Data data(2000);
  Arrays light(2000);
  ASSERT_TRUE(evaluator(usual).sample(data.queries(), light.out()).ok());
  std::vector<SampleQuery> queries(2000);
  std::vector<Sample> samples(2000);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    queries[i] = {.theta_o = data.point(i).theta_o, .h = double(data.h[i])};
    for (std::size_t k = 0; k < 4; ++k) queries[i].u[k] = double(data.u[k][i]);
  }
  ASSERT_TRUE(sample(chiang(), values_of(usual), Precision::f64, queries, samples).ok());
  EXPECT_LE(samples_apart(data, samples, light), 2);
}

TEST_P(BatchSet, ParametersThatVary_GiveTheValuesOfEach) {
  const Data data(600);
  Arrays color(600);
  std::vector<float> beta_n, red;
  for (int i = 0; i < 600; ++i) {
    beta_n.push_back(0.15f + 0.001f * float(i));
    red.push_back(0.002f * float(i));
  }
  const std::array<VaryingParameter, 2> varying = {{{"beta_n", beta_n}, {"sigma_a.r", red}}};
  ASSERT_TRUE(evaluator(usual).evaluate_varying(data.points(), varying, color.out()).ok());
  Errors errors;
  for (std::size_t i = 0; i < 600; ++i) {
    const std::string settings = fmt::format("field=near,sigma_a={}/0.5/1.2,beta_m=0.3,beta_n={}", red[i], beta_n[i]);
    errors.add(color.x[i], truth(settings, Quantity::S, data.point(i)).x);
    errors.add(color.z[i], truth(settings, Quantity::S, data.point(i)).z);
  }
  EXPECT_LT(errors.at(0.5), 1e-6);
  EXPECT_LT(errors.at(1), 5e-5);
}

TEST_P(BatchSet, EdgesOfTheDomain_AreFinite) {
  const std::array<std::array<float, 3>, 6> vectors = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0.99999994f, 1e-20f, 0}, {0.6f, -0.8f, 0}}};
  for (const char* settings : {"beta_m=0.001,beta_n=0.001,sigma_a=0", "beta_m=1,beta_n=1,sigma_a=100,eta=1.05",
                               "eta=3,alpha=0.17", "beta_m=0.001,sigma_a=100"})
    for (const auto& light : vectors)
      for (const auto& viewer : vectors) {
        Data data(16);
        Arrays color(16), drawn(16);
        std::vector<float> density(16);
        for (std::size_t i = 0; i < 16; ++i) {
          data.h[i] = i % 3 == 0 ? -1.0f : i % 3 == 1 ? 1.0f : 0.0f;
          for (auto* to : {&data.light, &data.viewer}) {
            const auto& v = to == &data.light ? light : viewer;
            to->x[i] = v[0], to->y[i] = v[1], to->z[i] = v[2];
          }
          for (auto& u : data.u) u[i] = i % 2 ? 0.0f : 0.99999994f;
        }
        const BatchEvaluator batch = evaluator(fmt::format("field=near,{}", settings));
        ASSERT_TRUE(batch.evaluate(data.points(), color.out()).ok() && batch.pdf(data.points(), density).ok() &&
                    batch.sample(data.queries(), drawn.out()).ok());
        for (std::size_t i = 0; i < 16; ++i)
          for (float v : {color.x[i], color.y[i], color.z[i], density[i], drawn.x[i], drawn.y[i], drawn.z[i]})
            ASSERT_TRUE(std::isfinite(v)) << settings;
      }
}

TEST(Batch, LargeBatch_IsTheSameAsItsParts) {
  const Data data(20000);
  Arrays whole(20000), part(100);
  const BatchEvaluator batch = *BatchEvaluator::make(chiang(), values_of(usual));
  ASSERT_TRUE(batch.evaluate(data.points(), whole.out()).ok());
  const auto cut = [](const std::vector<float>& v) { return std::span<const float>(v).subspan(12288, 100); };
  const BatchPoints points{{cut(data.light.x), cut(data.light.y), cut(data.light.z)},
                           {cut(data.viewer.x), cut(data.viewer.y), cut(data.viewer.z)},
                           cut(data.h)};
  ASSERT_TRUE(batch.evaluate(points, part.out()).ok());
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(part.x[i], whole.x[12288 + i]) << i;
}

TEST_P(BatchSet, FarField_IsTheIntegralOfTheScalarFormulas) {
  const Data data(20);
  Arrays color(20), light(20);
  std::vector<float> density(20);
  const std::string settings = "field=far,tolerance=1e-4";
  const BatchEvaluator batch = evaluator(settings);
  EXPECT_TRUE(batch.is_vectorised() && batch.draws_vectorised());
  ASSERT_TRUE(batch.evaluate({data.light.in(), data.viewer.in(), {}}, color.out()).ok());
  ASSERT_TRUE(batch.pdf(data.points(), density).ok());
  ASSERT_TRUE(batch.sample(data.queries(), light.out()).ok());
  for (std::size_t i = 0; i < 20; ++i) {
    const double exact = truth(settings, Quantity::S, data.point(i)).x;
    EXPECT_NEAR(color.x[i], exact, 3e-4 * exact + 1e-9);
    const double exact_density = truth(settings, Quantity::pdf, data.point(i)).x;
    EXPECT_NEAR(density[i], exact_density, 3e-4 * exact_density + 1e-9);
    const glm::vec3 to_light = vector_at(data.light, i), viewer = vector_at(data.viewer, i);
    EXPECT_EQ(batch.evaluate(to_light, viewer, 0).x, color.x[i]);
    EXPECT_EQ(batch.pdf(to_light, viewer, data.h[i]), density[i]);
    const glm::vec3 drawn =
        batch.sample(viewer, 0, {data.u[0][i], data.u[1][i], data.u[2][i], data.u[3][i], data.u[4][i]});
    EXPECT_LT(glm::length(drawn - vector_at(light, i)), 2e-6f);
    EXPECT_NEAR(light.x[i] * light.x[i] + light.y[i] * light.y[i] + light.z[i] * light.z[i], 1, 1e-6);
  }
}

// Models with kernels of their own and models without, with their default settings.
TEST(Batch, EveryRegisteredModel_AgreesWithItsScalarFormulas) {
  constexpr std::size_t count = 150;  // more than one block of those that go point by point
  const Data data(count);
  for (const Model* model : models()) {
    const registry::ParameterValues values = registry::default_values(model->entry.parameters);
    const BatchEvaluator batch = *BatchEvaluator::make(*model, values);
    Arrays color(count);
    ASSERT_TRUE(batch.evaluate(data.points(), color.out()).ok()) << model->entry.name;
    std::vector<Point> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(data.point(i));
    std::vector<glm::dvec3> exact(count);
    model->evaluate_f32(values, {Quantity::S, -1, points}, exact);
    double largest = 0;
    for (const glm::dvec3& value : exact) largest = std::max(largest, value.x);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NEAR(color.x[i], exact[i].x, 1e-4 * exact[i].x + 1e-6 * largest) << model->entry.name << " point " << i;
    const glm::vec3 last =
        batch.evaluate(vector_at(data.light, count - 1), vector_at(data.viewer, count - 1), data.h[count - 1]);
    EXPECT_NEAR(last.x, color.x[count - 1], 1e-5f * last.x) << model->entry.name;
  }
}

/// The settings that kernels of far fields are tried with beside the defaults: narrow and wide, pale and dark, no
/// caustic.
std::vector<std::string> settings_to_try(std::string_view model) {
  if (model == "marschner")
    return {"", "eta=1.15,beta=0.1", "eta=1.95,sigma_a=0", "eta=2.9,beta=0.5,alpha=0.1", "sigma_a=20,beta=0.05"};
  if (model == "karis") return {"", "roughness=0.2,shift=0.1,color=0.9/0.5/0.01"};
  return {""};
}

struct Subject {
  const Model* model;
  std::string settings;
};
std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const char* name : {"karis", "kajiya_kay", "hairworks", "scheuermann", "marschner"})
    for (const std::string& settings : settings_to_try(name)) all.push_back({*find_model(name), settings});
  return all;
}

TEST_P(BatchSet, FarModels_AgreeWithDouble) {
  const Data data(2000);
  std::vector<Point> points;
  for (std::size_t i = 0; i < 2000; ++i) points.push_back(data.point(i));
  for (const Subject& subject : subjects()) {
    const registry::ParameterValues values = *parse_settings(*subject.model, "", subject.settings);
    const BatchEvaluator batch = *BatchEvaluator::make(*subject.model, values, GetParam());
    ASSERT_TRUE(batch.is_vectorised() && batch.draws_vectorised()) << subject.model->entry.name;
    Arrays color(2000);
    std::vector<float> density(2000);
    ASSERT_TRUE(batch.evaluate({data.light.in(), data.viewer.in(), {}}, color.out()).ok());
    ASSERT_TRUE(batch.pdf({data.light.in(), data.viewer.in(), {}}, density).ok());
    std::vector<glm::dvec3> exact(2000), exact_density(2000);
    subject.model->evaluate_f64(values, {Quantity::S, -1, points}, exact);
    subject.model->evaluate_f64(values, {Quantity::pdf, -1, points}, exact_density);
    double largest = 0;
    for (const glm::dvec3& value : exact) largest = std::max(largest, value.x);
    Errors errors, density_errors;
    for (std::size_t i = 0; i < 2000; ++i) {
      errors.relative.push_back(std::abs(double(color.x[i]) - exact[i].x) / std::max(exact[i].x, 1e-6 * largest));
      density_errors.add(density[i], exact_density[i].x);
    }
    fmt::print("{} {} {}: S median {:.2g} 99 % {:.2g} largest {:.2g}; pdf 99 % {:.2g} largest {:.2g}\n",
               name_of(GetParam()), subject.model->entry.name, subject.settings, errors.at(0.5), errors.at(0.99),
               errors.at(1), density_errors.at(0.99), density_errors.at(1));
    EXPECT_LT(errors.at(0.5), 3e-7);
    EXPECT_LT(errors.at(0.99), 5e-6);
    EXPECT_LT(errors.at(1), 1.5e-4);
    EXPECT_LT(density_errors.at(0.99), 9e-6);
    EXPECT_LT(density_errors.at(1), 1.5e-4);
  }
}

/// A far model with every parameter off its default, all but one, which takes either of two values.
struct Varying {
  const char *model, *settings, *name;
  double values[2];
};
constexpr std::array<Varying, 5> varying_models = {{
    {"marschner", "eta=1.3,sigma_a=0.1/0.5/2,alpha=-0.05", "beta", {0.2, 0.4}},
    {"karis", "color=0.9/0.5/0.1,roughness=0.4", "shift", {0.1, -0.05}},
    {"kajiya_kay", "diffuse=0.1/0.2/0.3,specular=0.4/0.5/0.6", "exponent", {30, 7}},
    {"hairworks",
     "root_color=0.1/0.2/0.3,tip_color=0.7/0.6/0.5,along=0.3,root_reach=0.8,diffuse_blend=0.4,normal_theta=0.5,"
     "normal_phi=1,specular_color=0.3/0.2/0.1,exponent=40,secondary_scale=0.7,secondary_width=2.5",
     "secondary_shift",
     {0.1, -0.05}},
    {"scheuermann",
     "base=0.9/0.8/0.7,occlusion=0.6,diffuse=0.1/0.2/0.3,primary=0.4/0.3/0.2,primary_exponent=80,primary_shift=0.1,"
     "secondary=0.2/0.3/0.1,secondary_exponent=20,secondary_shift=-0.2,shift_texture=0.7",
     "mask",
     {0.6, 0.2}},
}};

TEST_P(BatchSet, ParametersOfFarModelsThatVary_GiveTheValuesOfEach) {
  const Data data(600);
  const BatchPoints points{data.light.in(), data.viewer.in(), {}};
  for (const Varying& v : varying_models) {
    const Model& model = **find_model(v.model);
    std::vector<float> values;
    std::vector<Arrays> each;
    std::optional<BatchEvaluator> batch;
    for (double value : v.values) {
      const std::string settings = fmt::format("{},{}={}", v.settings, v.name, value);
      batch = *BatchEvaluator::make(model, *parse_settings(model, "", settings), GetParam());
      ASSERT_TRUE(batch->evaluate(points, each.emplace_back(600).out()).ok());
    }
    for (std::size_t i = 0; i < 600; ++i) values.push_back(float(v.values[i % 2]));
    const std::array<VaryingParameter, 1> varying = {{{v.name, values}}};
    Arrays color(600);
    ASSERT_TRUE(batch->evaluate_varying(points, varying, color.out()).ok());
    const float largest = *std::ranges::max_element(each[0].y);
    for (std::size_t i = 0; i < 600; ++i) {
      const float expected = each[i % 2].y[i];
      EXPECT_NEAR(color.y[i], expected, 1e-4f * expected + 1e-6f * largest) << v.model << " " << i;
    }
  }
}

TEST_P(BatchSet, SamplesOfFarModels_AreThoseOfTheScalarSampler) {
  const Data data(500);
  std::vector<SampleQuery> queries(500);
  for (std::size_t i = 0; i < 500; ++i) {
    queries[i] = {.theta_o = data.point(i).theta_o};
    for (std::size_t k = 0; k < 5; ++k) queries[i].u[k] = double(data.u[k][i]);
  }
  std::vector<Subject> all = subjects();
  all.push_back({&chiang(), "field=far,h_from=-0.3,h_to=0.8,tolerance=1e-2"});
  for (const Subject& subject : all) {
    const registry::ParameterValues values = *parse_settings(*subject.model, "", subject.settings);
    Arrays light(500);
    BatchQueries from = data.queries();
    from.h = {};
    ASSERT_TRUE((*BatchEvaluator::make(*subject.model, values, GetParam())).sample(from, light.out()).ok());
    std::vector<Sample> samples(500);
    subject.model->sample_f64(values, queries, samples);
    EXPECT_LE(samples_apart(data, samples, light), 2) << subject.model->entry.name << " " << subject.settings;
  }
}

TEST(Batch, EmptyArrays_AreNoError) {
  EXPECT_TRUE((*BatchEvaluator::make(chiang(), values_of(usual))).evaluate({}, {}).ok());
}

TEST(Batch, ArraysOfDifferentSize_AreRefusedByName) {
  const Data data(8);
  Arrays color(8);
  std::vector<float> density(7);
  const BatchEvaluator batch = *BatchEvaluator::make(chiang(), values_of(usual));
  EXPECT_THAT(batch.pdf(data.points(), density).error().message, HasSubstr("density has 7 elements"));
  EXPECT_THAT(batch.evaluate({data.light.in(), data.viewer.in(), {}}, color.out()).error().message,
              HasSubstr("h has 0"));
  BatchQueries queries = data.queries();
  queries.u[2] = {};
  EXPECT_THAT(batch.sample(queries, color.out()).error().message, HasSubstr("u has 0"));
}
TEST(Batch, ParameterThatCannotVary_IsRefusedWithTheListOfThoseThatCan) {
  const Data data(8);
  Arrays color(8);
  const BatchEvaluator batch = *BatchEvaluator::make(chiang(), values_of(usual));
  const std::array<VaryingParameter, 1> varying = {{{"gamma", data.h}}};
  EXPECT_THAT(batch.evaluate_varying(data.points(), varying, color.out()).error().message, HasSubstr("sigma_a.r"));
}

}  // namespace
}  // namespace cuticle::bsdf::batch_test
