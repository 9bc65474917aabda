#include "core/json/json.h"
#include "core/real.h"
#include "study/lobes/lobes_study.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <type_traits>

#include <gtest/gtest.h>

namespace cuticle::study::lobes_study_test {
namespace {

LobesRequest small_request() {
  LobesRequest request;
  request.fibre_name = "default";
  request.models = {"marschner"};
  request.points = 128;
  request.seconds = 0.01;
  request.samples = 37;
  return request;
}

const LobesStudy& small_study() {
  static const LobesStudy study = *run_lobes_study(small_request(), silent_progress());
  return study;
}

TEST(LobesStudy, Tiers_HaveOneReferenceAndASmallFloatError) {
  const auto& rows = small_study().rows;
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const TierRow& row) { return row.reference; }), 1);
  for (const TierRow& row : rows) {
    EXPECT_GT(row.ns, 0);
    if (row.reference) {
      EXPECT_EQ(row.max_error, 0);
    } else if (row.precision == "f32" && row.tier == rows.front().tier) {
      EXPECT_EQ(row.median_error > 0, (std::is_same_v<Single, float>));
      EXPECT_LT(row.median_error, 1e-4);
    }
  }
}

TEST(LobesStudy, Landmarks_AreWhereTheLiteraturePutsThem) {
  ASSERT_EQ(small_study().landmarks.size(), 4u);
  for (const Landmark& mark : small_study().landmarks) EXPECT_NEAR(mark.measured, mark.expected, 0.02) << mark.what;
}

// TT is nothing at the azimuths around the caustic of TRT.
TEST(LobesStudy, Plots_HaveACurveForEachLobeAndEachLandmark) {
  const std::map<std::string, std::size_t> curves = {{"albedo", 1}, {"landmarks_M", 3 + 3}, {"landmarks_N", 2 + 2}};
  for (const Plot& plot : small_study().plots) {
    const auto known = curves.find(plot.name);
    EXPECT_EQ(plot.curves.size(), known == curves.end() ? 3u : known->second) << plot.name;
    for (const Curve& curve : plot.curves)
      EXPECT_TRUE(std::all_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y) && y >= 0; }));
  }
}

TEST(LobesStudy, Json_HoldsRowsPlotsAndLandmarks) {
  const auto json = Json::parse(to_json(small_study())).value();
  EXPECT_EQ(json["rows"].size(), small_study().rows.size());
  EXPECT_EQ(json["plots"].size(), 6u);
  EXPECT_EQ(json["landmarks"][0]["model"], "marschner");
}

TEST(LobesStudy, UnknownModel_IsRefusedByName) {
  LobesRequest request = small_request();
  request.models = {"marshner"};
  const auto study = run_lobes_study(request, silent_progress());
  ASSERT_FALSE(study.ok());
  EXPECT_NE(study.error().message.find("marshner"), std::string::npos);
}

}  // namespace
}  // namespace cuticle::study::lobes_study_test
