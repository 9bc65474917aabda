#include "core/real.h"
#include "study/luts/luts_study.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "lut/evaluate.h"
#include "study/engine/run.h"
#include "study/luts/table_sampler.h"

namespace cuticle::study::luts_study_test {
namespace {

struct SmallStudy {
  Study study;
  StudyResult result;
};
const SmallStudy& small_study() {
  static const SmallStudy made = [] {
    LutsRequest request;
    request.layouts = {"nalu", "nalu_theta"};
    request.sizes = {16, 32};
    request.formats = {"exr", "png8"};
    request.fits = {"none"};
    request.points = 256;
    SmallStudy small{*luts_study(request, silent_progress()), {}};
    small.study.timing = {.rounds = 1, .sample_seconds = 1e-5};
    small.result = *run_study(small.study, silent_progress());
    return small;
  }();
  return made;
}

const PointResult& point_of(std::string_view name) {
  const auto& points = small_study().result.groups[0].points;
  return *std::find_if(points.begin(), points.end(),
                       [&](const PointResult& point) { return point_name(point.method, point.knobs) == name; });
}
double error_of(std::string_view name) { return point_of(name).metrics[0].all.mean.value; }

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
  EXPECT_LT(error_of("nalu exr size=32"), error_of("nalu exr size=16"));
  EXPECT_EQ(point_of("nalu exr size=16").bytes, 3 * 16 * 16 * 8);
  EXPECT_EQ(point_of("nalu exr size=32").bytes, 4 * point_of("nalu exr size=16").bytes);
  EXPECT_EQ(point_of("nalu png8 size=16").bytes, 3 * 16 * 16 * 4);
}

TEST(LutsStudy, EveryChannel_HasAPlotAgainstBytes) {
  for (const char* channel : {"M_R", "M_TT", "M_TRT", "N_R", "N_TT.r", "N_TRT.g"})
    EXPECT_TRUE(std::ranges::any_of(small_study().study.plots, [&](const Plot& plot) {
      return plot.name == std::string("bytes_marschner_") + channel && plot.curves.size() == 4;
    })) << channel;
}

TEST(LutsStudy, DirectEvaluation_IsTimedAndMoreExactThanTables) {
  EXPECT_LT(error_of("the model, float"), error_of("nalu exr size=32"));
  EXPECT_EQ(error_of("the model, float") > 0, (std::is_same_v<Single, float>));
  for (const PointResult& point : small_study().result.groups[0].points) EXPECT_GT(point.time.seconds.value, 0);
}

TEST(LutsStudy, LayoutWithoutTheModelsLobes_IsLeftOutWithItsReason) {
  LutsRequest request;
  request.models = {"kajiya_kay"};
  request.layouts = {"nalu"};
  request.sizes = {16};
  request.points = 8;
  const Study study = *luts_study(request, silent_progress());
  EXPECT_EQ(study.groups[0].points.size(), 2u);
  EXPECT_NE(study.notes.back().find("kajiya_kay in nalu"), std::string::npos);
}

}  // namespace
}  // namespace cuticle::study::luts_study_test
