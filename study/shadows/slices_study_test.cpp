#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "core/json/json.h"
#include "shadows/footprint.h"
#include "study/shadows/marks.h"
#include "study/shadows/slices_study.h"

namespace cuticle::study::slices_study_test {

namespace {

/// The study of a small coat, run once.
const Comparison& coat_comparison() {
  static const strands::Groom groom = study_coat(4000);
  static const Comparison comparison = [] {
    SlicesStudy study = quick_slices_study();
    study.layers = {1, 4, 16, 64};
    study.resolutions = {128};
    study.request.groom = &groom;
    study.request.groom_name = "coat";
    return run_slices_study(study, silent_progress()).value();
  }();
  return comparison;
}

}  // namespace

TEST(SlicesStudy, MoreSlices_LessError) {
  const auto& rows = coat_comparison().rows;
  ASSERT_EQ(rows.size(), 6u) << "three of four for each method: 1 is no number of slices, 64 none of layers";
  EXPECT_LT(rows[1].error.mean, 0.5 * rows[0].error.mean);
  EXPECT_LT(rows[2].error.mean, rows[1].error.mean);
}

TEST(SlicesStudy, DeepLayers_BeatAsManySlicesAndImproveWithTheirNumber) {
  const auto& rows = coat_comparison().rows;
  for (int i = 0; i < 6; ++i)
    std::printf("%s %s: %.4f\n", rows[i].method.c_str(), rows[i].settings.c_str(), rows[i].error.mean);
  EXPECT_LT(rows[4].error.mean, 0.9 * rows[3].error.mean) << "4 layers against 1";
  EXPECT_LT(rows[3].error.mean, 0.9 * rows[0].error.mean) << "1 layer against 4 slices";
  EXPECT_LT(rows[5].error.mean, rows[4].error.mean) << "16 layers against 4";
  EXPECT_LT(rows[4].error.mean, 0.75 * rows[0].error.mean) << "4 layers against 4 slices";
}

TEST(SlicesStudy, SixteenSlices_BeatNoneAndTheBestConstant) {
  const Comparison& comparison = coat_comparison();
  EXPECT_LT(comparison.rows[1].error.mean, 0.3 * comparison.best_constant.mean);
  EXPECT_LT(comparison.best_constant.mean, comparison.none.mean);
}

TEST(SlicesStudy, SixtyFourSlices_AreCloseToTheTruth) { EXPECT_LT(coat_comparison().rows[2].error.mean, 0.023); }

TEST(SlicesStudy, Truth_ReportsItsNoiseAndItsReceivers) {
  const Comparison& comparison = coat_comparison();
  EXPECT_GT(comparison.counted, 100u);
  EXPECT_LE(comparison.counted, comparison.receivers);
  EXPECT_GT(comparison.truth_standard_error, 0);
  EXPECT_LT(comparison.truth_standard_error, 0.03);
}

TEST(SlicesStudy, Files_HoldWhatTheReadmeSays) {
  const std::string folder = testing::TempDir() + "/slices_study";
  ASSERT_TRUE(write_comparison(coat_comparison(), folder));
  const auto json = Json::parse(read_text_file(folder + "/study.json").value()).value();
  for (const char* key : {"name", "title", "x", "y", "series", "label", "groom", "alpha", "to_light", "footprint_m",
                          "truth", "device", "baselines", "rows"})
    EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"method", "settings", "layers", "resolution", "mean_error", "p95_error", "max_error", "bias",
                          "total_ms", "bytes", "device"})
    EXPECT_TRUE(json["rows"][0].contains(key)) << key;
  EXPECT_TRUE(std::filesystem::exists(folder + "/study.csv"));
  const std::string receivers = read_text_file(folder + "/receivers.csv").value();
  EXPECT_TRUE(receivers.starts_with("x,y,z,truth,standard_error,opacity_map "));
  EXPECT_EQ(std::size_t(std::count(receivers.begin(), receivers.end(), '\n')), coat_comparison().points.size() + 1);
}

TEST(BestChoice, Limits_AreKeptOrNoneDoes) {
  Comparison comparison;
  comparison.rows.resize(3);
  for (int i = 0; i < 3; ++i) {
    ComparisonRow& row = comparison.rows[std::size_t(i)];
    row.error.mean = row.choosing.mean = 0.3 / (i + 1);
    row.total_ms = 10.0 * (i + 1);
  }
  EXPECT_EQ(best_choice(comparison, {0.2, 0}), &comparison.rows[1]);
  EXPECT_EQ(best_choice(comparison, {0, 25}), &comparison.rows[1]);
  EXPECT_EQ(best_choice(comparison, {0, 0}), &comparison.rows[2]);
  EXPECT_EQ(best_choice(comparison, {0.1, 25}), nullptr);
  const Nearest nearest = nearest_to(comparison, {0.09, 25});
  EXPECT_EQ(nearest.row, &comparison.rows[2]);
  EXPECT_EQ(nearest.because, "its mean error is 0.1000, more than 0.09 and it takes 30 ms, more than 25");
  comparison.rows[1].error.mean = 0.21;
  EXPECT_EQ(best_choice(comparison, {0.2, 0}), &comparison.rows[2]) << "met on one half only";
}

TEST(ErrorStatistics, KnownValues_CountOnlyPartlyLitReceivers) {
  const std::vector<float> truth{0.5f, 0.25f, 0.01f, 0.99f}, values{0.75f, 0.125f, 1, 0};
  const ErrorStatistics statistics = error_statistics(values, truth);
  EXPECT_DOUBLE_EQ(statistics.mean, 0.1875);
  EXPECT_DOUBLE_EQ(statistics.bias, 0.0625);
  EXPECT_DOUBLE_EQ(statistics.maximum, 0.25);
}

TEST(ErrorStatistics, Halves_ShareNoReceiver) {
  const std::vector<float> truth{0.5f, 0.5f, 0.5f, 0.5f}, values{0.6f, 0.8f, 0.6f, 0.8f};
  EXPECT_NEAR(error_statistics(values, truth, Half::choosing).mean, 0.1, 1e-6);
  EXPECT_NEAR(error_statistics(values, truth, Half::reporting).mean, 0.3, 1e-6);
  const ErrorStatistics both = error_statistics(values, truth);
  EXPECT_NEAR(both.mean, 0.2, 1e-6);
  EXPECT_NEAR(both.mean_interval, 1.96 * 0.1 / std::sqrt(3.0), 1e-6);
}

namespace {

/// Each row's error is at most that of the row before, and the interval of their difference.
void expect_no_rise(const Comparison& comparison, std::size_t first, std::size_t count) {
  for (std::size_t i = first; i < first + count; ++i) {
    const ComparisonRow &row = comparison.rows[i], &coarser = comparison.rows[std::max(i, first + 1) - 1];
    std::printf("%s %s: %.4f +- %.4f\n", row.method.c_str(), row.settings.c_str(), row.error.mean,
                row.error.mean_interval);
    EXPECT_LE(row.error.mean, coarser.error.mean + row.error.mean_interval) << row.method << " " << row.settings;
  }
}
ComparisonRequest footprint_request(const strands::Groom& groom) {
  ComparisonRequest request;
  request.groom = &groom;
  request.rays = 256;
  request.receivers = 300;
  return request;
}

}  // namespace

TEST(CompareWithTruth, AFilterAsWideAsTheFootprint_FinerMapsAreNoWorse) {
  const strands::Groom groom = study_coat(4000);
  ComparisonRequest request = footprint_request(groom);
  const std::string methods[] = {"opacity_map", "deep_opacity", "moments", "fourier",
                                 "exact_list",  "deep_shadow",  "voxel"};
  const double footprint = shadows::default_footprint_radius(groom);
  request.candidates = candidates_of(methods, {{}, {32, 64, 128, 256}, {footprint}, {}}).value();
  const auto comparison = compare_with_truth(request, silent_progress());
  ASSERT_TRUE(comparison) << comparison.error().message;
  for (std::size_t i = 0; i < std::size(methods); ++i) expect_no_rise(*comparison, 4 * i, 4);
}

// What pictures use: a filter of one texel, and a footprint as small as a pixel. A strand that shadowed itself would
// make every map darker the finer it is. A volume's cells blur a receiver's surroundings, so it comes along without.
TEST(CompareWithTruth, AFilterOfOneTexelAtAPixel_FinerMapsAreBetter) {
  const strands::Groom groom = study_coat(2000);
  ComparisonRequest request = footprint_request(groom);
  request.footprint_radius = 2e-4;
  request.rays = 64;
  request.receivers = 600;
  const std::string methods[] = {"opacity_map", "deep_opacity", "moments", "fourier", "exact_list", "deep_shadow"};
  const std::vector<std::int64_t> sizes{64, 256, 1024, 2048};
  request.candidates = candidates_of(methods, {{16}, sizes, {}, {}, false, {1}}).value();
  const auto few = candidates_of(std::span(methods, 2), {{4}, sizes, {}, {}, false, {1}}).value();
  request.candidates.insert(request.candidates.end(), few.begin(), few.end());
  const auto comparison = compare_with_truth(request, silent_progress());
  ASSERT_TRUE(comparison) << comparison.error().message;
  const auto& rows = comparison->rows;
  ASSERT_EQ(rows.size() % sizes.size(), 0u);
  for (std::size_t i = 0; i < rows.size(); i += sizes.size()) {
    expect_no_rise(*comparison, i, sizes.size());
    for (std::size_t k = i + 1; k < i + sizes.size(); ++k)
      EXPECT_LT(rows[k].error.mean, rows[k - 1].error.mean) << rows[k].method << " " << rows[k].settings;
    std::printf("bias %+.4f at 64^2, %+.4f at 2048^2\n", rows[i].error.bias, rows[i + sizes.size() - 1].error.bias);
  }
}

// What a texel knows of its nearest and farthest fibre keeps few layers from growing worse where texels hold one or
// two.
TEST(CompareWithTruth, AFilterAsWideAsTheFootprint_FewLayersAreNoWorseInFineMaps) {
  const strands::Groom groom = study_coat(1000);
  ComparisonRequest request = footprint_request(groom);
  const std::string methods[] = {"deep_opacity"};
  const double footprint = shadows::default_footprint_radius(groom);
  for (const std::int64_t layers : {1, 2, 4}) {
    const auto candidates = candidates_of(methods, {{layers}, {64, 256, 1024}, {footprint}, {}}).value();
    request.candidates.insert(request.candidates.end(), candidates.begin(), candidates.end());
  }
  const auto comparison = compare_with_truth(request, silent_progress());
  ASSERT_TRUE(comparison) << comparison.error().message;
  for (std::size_t i = 0; i < 9; i += 3) expect_no_rise(*comparison, i, 3);
}

TEST(CompareWithTruth, AFilterAsWideAsTheFootprint_MoreNumbersATexelAreNoWorse) {
  const strands::Groom groom = study_coat(4000);
  ComparisonRequest request = footprint_request(groom);
  const std::string footprint = std::to_string(1e3 * shadows::default_footprint_radius(groom));
  const std::pair<std::string, std::vector<std::string>> sweeps[] = {
      {"opacity_map", {"slices=4", "slices=8", "slices=16", "slices=64", "slices=128"}},
      {"deep_opacity", {"layers=1", "layers=2", "layers=4", "layers=8", "layers=16"}},
      {"fourier", {"harmonics=1", "harmonics=3", "harmonics=7"}},
      {"moments", {"basis=power_4", "basis=power_6"}}};
  for (const auto& [name, sets] : sweeps)
    for (const std::string& set : sets) {
      const shadows::Method* method = shadows::find_method(name).value();
      const auto values =
          registry::parse_assignments(method->entry.parameters, set + ",resolution=128,filter_radius_mm=" + footprint);
      request.candidates.push_back({method, values.value()});
    }
  const auto comparison = compare_with_truth(request, silent_progress());
  ASSERT_TRUE(comparison) << comparison.error().message;
  std::size_t first = 0;
  for (const auto& [name, sets] : sweeps) {
    expect_no_rise(*comparison, first, sets.size());
    first += sets.size();
  }
}

TEST(CompareWithTruth, WeightsPerVertex_ComeFromTheEnds) {
  const strands::Groom groom = study_coat(4000);
  ComparisonRequest request;
  request.groom = &groom;
  request.rays = 64;
  request.receivers = 300;
  const std::string methods[] = {"opacity_map", "deep_opacity"};
  request.candidates = candidates_of(methods, {{4}, {128}, {}, {}}).value();
  std::vector<double> errors;
  for (const Weights weights : {Weights::per_fragment, Weights::per_vertex, Weights::tents_per_vertex}) {
    request.weights = weights;
    const auto comparison = compare_with_truth(request, silent_progress());
    ASSERT_TRUE(comparison) << comparison.error().message;
    EXPECT_EQ(comparison->refused.size(), weights == Weights::tents_per_vertex ? 1u : 0u);
    ASSERT_EQ(comparison->rows[0].transmittance.size(), comparison->truth.size());
    errors.push_back(comparison->rows[0].error.mean);
  }
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_NE(errors[0], errors[i]);
    EXPECT_NEAR(errors[0], errors[i], 0.1);
  }
  EXPECT_NE(errors[1], errors[2]);
}

TEST(CompareWithTruth, Flicker_IsLessWithAFilter) {
  const strands::Groom groom = study_coat(2000);
  ComparisonRequest request;
  request.groom = &groom;
  request.rays = 64;
  request.receivers = 200;
  request.flicker = true;
  const std::string methods[] = {"none", "opacity_map"};
  request.candidates = candidates_of(methods, {{16}, {128}, {1e-6, 0.004}, {}}).value();
  const auto comparison = compare_with_truth(request, silent_progress());
  ASSERT_TRUE(comparison) << comparison.error().message;
  const auto& rows = comparison->rows;
  for (const ComparisonRow& row : rows) {
    std::printf("%s %s: light %.5f, motion %.5f\n", row.method.c_str(), row.settings.c_str(), row.flicker->light,
                row.flicker->motion.value_or(-1));
    EXPECT_GT(row.flicker->light, 0);
  }
  EXPECT_FALSE(rows[0].flicker->motion) << "none has no texels";
  EXPECT_GT(*rows[1].flicker->motion, 2 * *rows[2].flicker->motion);
  EXPECT_GT(rows[1].flicker->light, rows[2].flicker->light);
  EXPECT_NEAR(std::acos(std::min(1.0, glm::dot(turned_light(comparison->to_light), comparison->to_light))),
              0.1 * 3.14159265 / 180, 1e-7);
}

TEST(CompareWithTruth, NothingShadowed_IsRefused) {
  const strands::Groom groom = study_coat(3);
  ComparisonRequest request;
  request.groom = &groom;
  request.alpha = 0;
  const auto comparison = compare_with_truth(request, silent_progress());
  ASSERT_FALSE(comparison);
  EXPECT_EQ(comparison.error().kind, ErrorKind::bad_input);
}

TEST(Followers, OfASeed_AreTheSameAndWithinTheirBall) {
  const strands::Groom guides = study_coat(50), groom = with_followers(guides, 4, 0.002, 7);
  ASSERT_EQ(groom.strand_count(), 250u);
  EXPECT_EQ(groom, with_followers(guides, 4, 0.002, 7));
  EXPECT_NE(groom, with_followers(guides, 4, 0.002, 8));
  double largest = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t v = 0; v < 8; ++v) {
      const glm::dvec3 move = glm::dvec3(groom.strand(s)[v]) - glm::dvec3(guides.strand(s / 5)[v]);
      largest = std::max(largest, std::sqrt(move.x * move.x + move.y * move.y + move.z * move.z));
    }
  EXPECT_LE(largest, 0.002 + 1e-7);
  EXPECT_GT(largest, 0.0017);
}

namespace {

Result<std::vector<MarksFile>> marks_of(const std::string& marks) {
  const std::string path = testing::TempDir() + "/marks.json";
  EXPECT_TRUE(write_text_file(
      path, R"({"name": "small", "alpha": 0.4, "rays": 64, "receivers": 200, "lights": [[1, 1, 0.3], [0, 1, 0]],
    "hair": {"coat_strands": 2000, "fibre_radius_m": 0.0003}, "marks": [)" +
                marks + "]}"));
  return read_marks(path, ".");
}

}  // namespace

TEST(Marks, EachIsItsBestSettingWithinTheBytes) {
  const auto file = marks_of(R"(
    {"name": "lax", "method": "opacity_map", "error": 0.9, "settings": [{"slices": ["4", "32"], "resolution": ["64"]}]},
    {"name": "small", "method": "opacity_map", "error": 0.9, "bytes": 50000, "settings": [{"slices": ["4", "32"], "resolution": ["64"]}]},
    {"name": "strict", "method": "opacity_map", "error": 1e-9, "settings": [{"slices": ["4"]}]},
    {"name": "none", "method": "opacity_map", "error": 0.9, "bytes": 10, "settings": [{"slices": ["4"]}]})");
  ASSERT_TRUE(file) << file.error().message;
  const auto report = measure_marks(file->front(), silent_progress());
  ASSERT_TRUE(report) << report.error().message;
  ASSERT_EQ(report->results.size(), 4u);
  EXPECT_TRUE(report->results[0].met());
  EXPECT_NE(report->results[0].settings.find("slices=32"), std::string::npos);
  EXPECT_EQ(report->results[1].bytes, 3u * 64 * 64 * 4);
  EXPECT_GT(report->results[1].error, report->results[0].error);
  EXPECT_GT(report->results[0].interval, 0);
  EXPECT_FALSE(report->results[2].met());
  EXPECT_FALSE(report->results[3].met());
  EXPECT_EQ(Json::parse(to_json(file->front(), *report)).value()["lights"].size(), 2u);
}

TEST(Marks, BadFiles_AreRefusedByName) {
  for (const std::string marks :
       {R"({"name": "a"})", R"({"name": "a", "method": "opacity_mop", "error": 1, "settings": [{}]})",
        R"({"name": "a", "method": "opacity_map", "error": 1, "settings": [{"slices": ["1"]}]})", ""}) {
    const auto file = marks_of(marks);
    ASSERT_FALSE(file) << marks;
    EXPECT_NE(file.error().message.find("marks.json"), std::string::npos) << file.error().message;
  }
}

// One light, 400 receivers and 256 rays, whose noise adds to the errors.
TEST(Marks, OfTheRepository_HoldInAReducedForm) {
  const char* data = std::getenv("CUTICLE_TEST_DATA");
  for (const std::string name : {"coat", "ponytail"}) {
    if (name == "ponytail" && data == nullptr) GTEST_SKIP() << "CUTICLE_TEST_DATA is not set";
    const std::string path = std::string(CUTICLE_SOURCE_DIR "/scenes/shadow_marks/") + name + ".json";
    const auto files = read_marks(path, data == nullptr ? "" : data);
    ASSERT_TRUE(files) << files.error().message;
    MarksFile file = files->front();
    file.lights.resize(1);
    file.receivers = 400;
    file.rays = 256;
    for (Mark& mark : file.marks) mark.candidates.resize(1);
    const auto report = measure_marks(file, silent_progress());
    ASSERT_TRUE(report) << report.error().message;
    std::fputs(to_text(file, *report).c_str(), stdout);
    for (const MarkResult& result : report->results)
      EXPECT_LT(result.error, 1.15 * result.mark->error + 0.004) << name << ": " << result.mark->name;
  }
}

}  // namespace cuticle::study::slices_study_test
