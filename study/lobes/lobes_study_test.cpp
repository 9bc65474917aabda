#include "study/lobes/lobes_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

#include <gtest/gtest.h>

#include "core/real.h"
#include "study/engine/run.h"

namespace cuticle::study::lobes_study_test {
namespace {

LobesRequest small_request() {
  LobesRequest request;
  request.fibre_name = "default";
  request.models = {"marschner"};
  request.points = 128;
  request.samples = 37;
  request.walks = 20000;
  return request;
}

const Study& small_study() {
  static const Study study = [] {
    Study made = *lobes_study(small_request(), silent_progress());
    made.timing = {.rounds = 1, .sample_seconds = 1e-5};
    return made;
  }();
  return study;
}

TEST(LobesStudy, Tiers_TheLastInDoubleIsTheTruthAndFloatIsNearIt) {
  const StudyResult result = *run_study(small_study(), silent_progress());
  ASSERT_EQ(result.groups.size(), 2u);
  const auto& points = result.groups[1].points;
  EXPECT_EQ(points[0].metrics[0].all.maximum, 0);
  for (const PointResult& point : points) EXPECT_GT(point.time.seconds.value, 0);
  const PointResult& single = points[1];
  EXPECT_EQ(single.method, "float");
  EXPECT_EQ(single.metrics[0].all.median > 0, (std::is_same_v<Single, float>));
  EXPECT_LT(single.metrics[0].all.median, 1e-4);
}

// A model of absorbing rough fibres is nearer to the walks than one without absorption or transmission.
TEST(LobesStudy, AcrossModels_AFibreModelIsNearerToTheWalksThanAPhenomenologicalOne) {
  LobesRequest request = small_request();
  const bsdf::Model* const models[] = {*bsdf::find_model("deon"), *bsdf::find_model("kajiya_kay")};
  Study study;
  study.timing = {.rounds = 1, .sample_seconds = 1e-5};
  study.groups = {*across_models(models, request)};
  const StudyResult result = *run_study(study, silent_progress());
  const auto& points = result.groups[0].points;
  const double deon = points.front().metrics[0].all.mean.value, kajiya_kay = points.back().metrics[0].all.mean.value;
  EXPECT_LT(deon, 0.5);
  EXPECT_LT(2 * deon, kajiya_kay);
  EXPECT_LT(study.groups[0].floor, 0.1);
  EXPECT_LT(points.front().metrics[1].all.mean.value, 0.1);
}

TEST(LobesStudy, Landmarks_AreWhereTheLiteraturePutsThem) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const Landmarks landmarks = *landmarks_of(model, model.from_fibre(bsdf::Fibre{}).settings, 37);
  ASSERT_EQ(landmarks.places.size(), 4u);
  for (const Landmark& mark : landmarks.places) EXPECT_NEAR(mark.measured, mark.expected, 0.02) << mark.what;
}

// TT is nothing at the azimuths around the caustic of TRT.
TEST(LobesStudy, Plots_HaveACurveForEachLobeAndEachLandmark) {
  const std::map<std::string, std::size_t> curves = {{"albedo", 1}, {"landmarks_M", 3 + 3}, {"landmarks_N", 2 + 2}};
  EXPECT_EQ(small_study().plots.size(), 6u);
  for (const Plot& plot : small_study().plots) {
    const auto known = curves.find(plot.name);
    EXPECT_EQ(plot.curves.size(), known == curves.end() ? 3u : known->second) << plot.name;
    for (const Curve& curve : plot.curves)
      EXPECT_TRUE(std::all_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y) && y >= 0; }));
  }
}

TEST(LobesStudy, UnknownModel_IsRefusedByName) {
  LobesRequest request = small_request();
  request.models = {"marshner"};
  const auto study = lobes_study(request, silent_progress());
  ASSERT_FALSE(study.ok());
  EXPECT_NE(study.error().message.find("marshner"), std::string::npos);
}

}  // namespace
}  // namespace cuticle::study::lobes_study_test
