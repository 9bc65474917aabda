#include "core/json/json.h"
#include "core/real.h"
#include "study/luts/luts_study.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "lut/evaluate.h"
#include "study/luts/table_sampler.h"

namespace cuticle::study::luts_study_test {
namespace {

const LutsStudy& small_study() {
  static const LutsStudy study = [] {
    LutsRequest request;
    request.layouts = {"nalu", "nalu_theta"};
    request.sizes = {16, 32};
    request.formats = {"exr", "png8"};
    request.fits = {"none"};
    request.points = 256;
    request.repeats = 2;
    return *run_luts_study(request, silent_progress());
  }();
  return study;
}

const LutRow& row_of(std::string_view layout, int size, std::string_view format, std::string_view channel) {
  const auto& rows = small_study().rows;
  return *std::find_if(rows.begin(), rows.end(), [&](const LutRow& row) {
    return row.layout == layout && row.size == size && row.format == format && row.channel == channel;
  });
}

/// The terms of nalu by hand, from lut::sample in double.
TEST(TableSampler, ScatteringOfNalu_IsThatOfItsTablesFiltered) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  const auto values = *bsdf::parse_settings(model, "", "sigma_a=0.1/0.3/0.9");
  const lut::TableSet set = *lut::bake(model, values, **lut::find_layout("nalu"), 32, silent_progress());
  const TableSampler sampler = *TableSampler::make(set);
  for (const auto& [theta_i, theta_o, phi] : {std::tuple(0.1, -0.4, 2.8), {0.9, 0.2, 0.3}, {-0.7, -1.1, 1.4}}) {
    const auto at = [&](std::size_t table, int channel, double u, double v) {
      const lut::TableLayout& layout = *set.tables[table].layout;
      const lut::AxisMap map_u = lut::axis_map(layout.u, 32), map_v = lut::axis_map(layout.v, 32);
      return lut::sample(set.tables[table], channel, u * map_u.scale + map_u.bias, v * map_v.scale + map_v.bias);
    };
    const double sin_i = std::sin(theta_i), sin_o = std::sin(theta_o), cos_phi = std::cos(phi);
    const double cos_d = at(0, 3, sin_i, sin_o);
    const glm::vec3 found = sampler.scattering({float(sin_i), float(sin_o), float(cos_phi)});
    for (int c = 0; c < 3; ++c) {
      const double expected = at(0, 0, sin_i, sin_o) * at(1, 3, cos_phi, cos_d) +
                              at(0, 1, sin_i, sin_o) * at(1, c, cos_phi, cos_d) +
                              at(0, 2, sin_i, sin_o) * at(2, c, cos_phi, cos_d);
      EXPECT_NEAR(double(found[c]), expected, 1e-4 * expected) << theta_i << " " << c;
    }
  }
}

TEST(LutsStudy, MoreTexels_LessErrorAndMoreBytes) {
  const LutRow &coarse = row_of("nalu", 16, "exr", "S"), &fine = row_of("nalu", 32, "exr", "S");
  EXPECT_LT(fine.rms_error, coarse.rms_error);
  EXPECT_EQ(coarse.bytes, 3u * 16 * 16 * 8);
  EXPECT_EQ(fine.bytes, 4 * coarse.bytes);
  EXPECT_EQ(row_of("nalu", 16, "png8", "S").bytes, 3u * 16 * 16 * 4);
}

TEST(LutsStudy, EveryChannel_HasARowAndSToo) {
  for (const char* channel : {"M_R", "M_TT", "M_TRT", "N_R", "N_TT.r", "N_TRT.g", "S"})
    EXPECT_GT(row_of("nalu", 32, "exr", channel).rms_error, 0) << channel;
  EXPECT_GT(row_of("nalu_theta", 16, "exr", "S").ns, 0);
}

TEST(LutsStudy, DirectEvaluation_IsTimedAndMoreExactThanTables) {
  const auto& direct = small_study().direct;
  const auto of = [&](std::string_view path, std::string_view lobe) {
    return *std::find_if(direct.begin(), direct.end(),
                         [&](const DirectRow& row) { return row.path == path && row.lobe == lobe; });
  };
  EXPECT_EQ(of("double", "S").rms_error, 0);
  EXPECT_LT(of("float", "S").rms_error, row_of("nalu", 32, "exr", "S").rms_error);
  EXPECT_GT(of("float", "TRT").ns, 0);
  EXPECT_EQ(small_study().verdicts.size(), 2u);  // float, and float in arrays
}

TEST(LutsStudy, Verdict_NamesWhatIsCheaperAtWhichError) {
  LutsStudy study;
  for (const auto& [ns, error] : {std::pair(50.0, 0.02), {90.0, 0.01}}) {
    LutRow& row = study.rows.emplace_back(LutRow{"m", "nalu", "exr", "none", "S"});
    row.ns = ns;
    row.rms_error = error;
  }
  study.direct = {{"m", "float", "S", 20, 1e-6}, {"m", "float", "S", 70, 1e-6}, {"m", "float", "S", 400, 1e-6}};
  const std::vector<std::string> verdicts = verdicts_of(study);
  ASSERT_EQ(verdicts.size(), 3u);
  EXPECT_NE(verdicts[0].find("no table is worth it"), std::string::npos);
  EXPECT_NE(verdicts[1].find("off by 2.0e-02"), std::string::npos);
  EXPECT_NE(verdicts[1].find("below that error the model itself"), std::string::npos);
  EXPECT_NE(verdicts[2].find("off by 1.0e-02"), std::string::npos);
  EXPECT_EQ(verdicts[2].find("below that error"), std::string::npos);
}

TEST(LutsStudy, LayoutWithoutTheModelsLobes_IsLeftOutWithItsReason) {
  LutsRequest request;
  request.models = {"kajiya_kay"};
  request.layouts = {"nalu"};
  request.sizes = {16};
  request.points = 8;
  request.repeats = 1;
  const LutsStudy study = *run_luts_study(request, silent_progress());
  EXPECT_TRUE(study.rows.empty());
  EXPECT_EQ(study.skipped.size(), 1u);
}

TEST(LutsStudy, Json_HoldsWhatTheReporterReads) {
  const auto json = Json::parse(to_json(small_study())).value();
  // Two layouts, sizes and formats; in arrays, and float by itself: double is the reference, of no error.
  EXPECT_EQ(json["rows"].size(), 8u + 1 + (std::is_same_v<Single, float> ? 1 : 0));
  EXPECT_EQ(json["words"].size(), 3u);
  EXPECT_FALSE(json["plots"].empty());
}

}  // namespace
}  // namespace cuticle::study::luts_study_test
