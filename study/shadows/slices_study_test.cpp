#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cuticle/core/file.h>
#include <cuticle/study/shadows/slices_study.h>

using namespace cuticle;
using namespace cuticle::study;

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
  for (int i = 0; i < 6; ++i) std::printf("%s %s: %.4f\n", rows[i].method.c_str(), rows[i].settings.c_str(), rows[i].error.mean);
  EXPECT_LT(rows[4].error.mean, 0.5 * rows[3].error.mean) << "4 layers against 1";
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
  const auto json = nlohmann::json::parse(read_text_file(folder + "/study.json").value());
  for (const char* key : {"name", "title", "x", "y", "series", "label", "groom", "alpha", "to_light", "footprint_m", "truth", "device", "baselines", "rows"})
    EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"method", "settings", "layers", "resolution", "mean_error", "p95_error", "max_error", "bias", "total_ms", "bytes", "device"})
    EXPECT_TRUE(json["rows"][0].contains(key)) << key;
  EXPECT_TRUE(std::filesystem::exists(folder + "/study.csv"));
}

TEST(BestChoice, Limits_AreKeptOrNoneDoes) {
  Comparison comparison;
  comparison.rows.resize(3);
  for (int i = 0; i < 3; ++i) {
    comparison.rows[std::size_t(i)].error.mean = 0.3 / (i + 1);
    comparison.rows[std::size_t(i)].cost.lookup_ms = 10.0 * (i + 1);
  }
  EXPECT_EQ(best_choice(comparison, 0.2, 0), &comparison.rows[1]);
  EXPECT_EQ(best_choice(comparison, 0, 25), &comparison.rows[1]);
  EXPECT_EQ(best_choice(comparison, 0, 0), &comparison.rows[2]);
  EXPECT_EQ(best_choice(comparison, 0.1, 25), nullptr);
}

TEST(Candidates, SweptMethods_TakeWhatTheyKnow) {
  const std::string methods[] = {"none", "opacity_map"};
  const auto candidates = candidates_of(methods, {{4, 8}, {64, 128, 256}, 0.001});
  ASSERT_TRUE(candidates);
  ASSERT_EQ(candidates->size(), 7u);
  EXPECT_EQ(settings_text((*candidates)[0]), "");
  EXPECT_EQ(settings_text((*candidates)[1]), "filter_radius_mm=1,resolution=64,slices=4");
  EXPECT_FALSE(candidates_of(methods, {{1}, {}, 0}));
  const auto fewer = candidates_of(methods, {{1, 4}, {}, 0});
  ASSERT_TRUE(fewer);
  EXPECT_EQ(fewer->size(), 2u) << "one is no number of slices";
  const std::string unknown[] = {"opacity"};
  EXPECT_FALSE(candidates_of(unknown, {}));
}

TEST(ErrorStatistics, KnownValues_CountOnlyPartlyLitReceivers) {
  const std::vector<float> truth{0.5f, 0.25f, 0.01f, 0.99f}, values{0.75f, 0.125f, 1, 0};
  const ErrorStatistics statistics = error_statistics(values, truth);
  EXPECT_DOUBLE_EQ(statistics.mean, 0.1875);
  EXPECT_DOUBLE_EQ(statistics.bias, 0.0625);
  EXPECT_DOUBLE_EQ(statistics.maximum, 0.25);
}

TEST(Probes, MoreThanThereAre_AreAllVerticesWithTheirStrands) {
  const strands::Groom groom = study_coat(3);
  const Probes probes = spread_probes(groom, 1000);
  ASSERT_EQ(probes.points.size(), 24u);
  EXPECT_EQ(probes.strands[7], 0u);
  EXPECT_EQ(probes.strands[8], 1u);
  EXPECT_EQ(probes.strands[23], 2u);
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
