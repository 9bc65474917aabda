// What a plan takes: times fitted to measurements, settings that keep a budget, and ways to bring a pass in.
#include "plan/budgets.h"

#include <filesystem>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/plan_report.h"

namespace cuticle::plan::budgets_test {
namespace {

using testing::HasSubstr;

scene::Scene scene_of(std::string_view fields) {
  const auto scene =
      scene::parse_scene(fmt::format(R"({{"schema_version": 1, {}}})", fields), "/", "test", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  return *scene;
}

registry::FrameShape shape() {
  registry::FrameShape shape;
  shape.strands = 100;
  shape.vertices = 1000;
  shape.segments = 900;
  shape.lights = 1;
  return shape;
}

constexpr std::string_view k_shadowed = R"("lights": [{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}],
  "shadow": {"method": {"opacity_map": {}}}, "render": {"method": "tiles"})";

AccuracyTable accuracy() {
  return {"test",
          {{"shadow", "opacity_map", "slices=8", 0.05, 0.06, 4},
           {"shadow", "deep_opacity", "layers=8", 0.01, 0.015, 4},
           {"shadow", "deep_opacity", "layers=16", 0.005, 0.007, 4}}};
}

/// Every pass takes 1 ms, of shadow methods those settings that the table has.
CostTable costs() {
  CostTable table;
  for (const registry::Entry* pass : catalogue().passes) table.passes[std::string(pass->name)] = {1, 0, 0};
  table.passes["opacity_map slices=8"] = {1, 0, 0};
  table.passes["deep_opacity layers=8"] = {3, 0, 0};
  table.passes["deep_opacity layers=16"] = {9, 0, 0};
  return table;
}

BudgetChoice chosen(std::string_view budgets) {
  const scene::Scene scene = scene_of(fmt::format(R"({}, "budgets": {})", k_shadowed, budgets));
  return choose(scene, shape(), {}, accuracy(), costs());
}

TEST(Budgets, ErrorWanted_TakesTheQuickestThatKeepsIt) {
  const BudgetChoice choice = chosen(R"({"error": {"shadow": 0.02}})");
  ASSERT_EQ(choice.refused, "");
  ASSERT_EQ(choice.rows.size(), 1u);
  EXPECT_EQ(cost_name(choice.rows[0]), "deep_opacity layers=8");
  EXPECT_EQ(choice.scene.shadow->values.integer("layers"), 8);
}

TEST(Budgets, ErrorThatNoneKeeps_IsRefusedWithTheNearest) {
  EXPECT_THAT(chosen(R"({"error": {"shadow": 0.001}})").refused,
              HasSubstr("deep_opacity layers=16, stays below 0.007"));
  EXPECT_THAT(chosen(R"({"error": {"coverage": 0.1}})").refused, HasSubstr("nothing of it"));
}

TEST(Budgets, TimeTooShort_IsRefusedWithTheQuickest) {
  const BudgetChoice choice = chosen(R"({"frame_ms": 0.5, "error": {"shadow": 0.02}})");
  EXPECT_THAT(choice.refused, HasSubstr("the quickest settings take"));
}

TEST(Budgets, MemoryWanted_TakesTheMostExactThatKeepsIt) {
  const scene::Scene scene = scene_of(fmt::format(R"({}, "budgets": {{"memory_mb": 3}})", k_shadowed));
  const MemoryTable memory{2e6,
                           {{"shadow opacity_map slices=8", 0},
                            {"shadow deep_opacity layers=8", 5e5},
                            {"shadow deep_opacity layers=16", 2e6}}};
  const BudgetChoice choice = choose(scene, shape(), {}, accuracy(), costs(), memory);
  ASSERT_EQ(choice.refused, "");
  EXPECT_EQ(cost_name(choice.rows.at(0)), "deep_opacity layers=8");
  EXPECT_EQ(choice.expected_bytes, 2.5e6);
}

TEST(Budgets, MemoryTooLittle_IsRefusedWithTheLeanest) {
  const scene::Scene scene = scene_of(fmt::format(R"({}, "budgets": {{"memory_mb": 1}})", k_shadowed));
  EXPECT_THAT(choose(scene, shape(), {}, accuracy(), costs(), {2e6, {}}).refused,
              HasSubstr("the leanest settings take 2 MB"));
}

TEST(Budgets, DeviceWithoutTimes_IsRefused) {
  const scene::Scene scene = scene_of(fmt::format(R"({}, "budgets": {{"error": {{"shadow": 0.02}}}})", k_shadowed));
  EXPECT_THAT(choose(scene, shape(), {}, accuracy(), {}).refused, HasSubstr("--calibrate"));
}

TEST(Budgets, PassWithoutATime_IsRefusedByItsName) {
  const scene::Scene scene = scene_of(fmt::format(
      R"({0}, "fins": {{"mesh": "{1}/fins/ear_fins.obj", "weights": "{1}/fins/ear_fins.png"}}, "budgets": {{"frame_ms": 100}})",
      k_shadowed, CUTICLE_SOURCE_DIR "/scenes"));
  CostTable without_fins = costs();
  without_fins.passes.erase("fins");
  const std::string refused = choose(scene, shape(), {}, accuracy(), without_fins).refused;
  EXPECT_THAT(refused, HasSubstr("no time of 'fins' is measured on this device"));
  EXPECT_THAT(refused, HasSubstr("all passes but those of fins"));
}

TEST(Budgets, UpperBound_IsThatOfStudent) {
  EXPECT_NEAR(upper_bound(std::vector{1.0, 2.0, 3.0}), 2 + 2.920 * std::sqrt(1 + 1 / 3.0), 1e-9);
  EXPECT_TRUE(std::isinf(upper_bound(std::vector{1.0})));
}

// In a table whose truth is lost in rounding, or in noise, they do not.
TEST(Budgets, ErrorsOfTheTableThatIsShipped_FallWithFinerSettings) {
  const AccuracyTable table = read_accuracy_table(CUTICLE_SOURCE_DIR "/scenes/accuracy.json").value();
  const auto error_of = [&](std::string_view part, std::string_view settings) {
    for (const AccuracyRow& row : table.rows)
      if (row.part == part && row.settings == settings) return row.error;
    ADD_FAILURE() << "no row of " << part << " with " << settings;
    return 0.0;
  };
  const auto falls = [&](std::string_view part, double factor, std::initializer_list<std::string_view> settings) {
    double before = 1;
    for (std::string_view each : settings) {
      EXPECT_LT(error_of(part, each), factor * before) << part << " with " << each;
      before = error_of(part, each);
    }
  };
  falls("motion", 0.6,
        {"inner_step=0.00833333", "inner_step=0.00416667", "inner_step=0.00208333", "inner_step=0.00104167"});
  falls("shadow", 0.75,
        {"resolution=256", "resolution=512", "resolution=1024", "resolution=2048"});  // deep shadow maps
  falls("shading", 0.6, {"lut_size=16", "lut_size=32", "lut_size=64", "lut_size=128"});
}

TEST(CostTable, Fit_FindsWhatMadeTheTimes) {
  std::vector<TimedPass> measured;
  for (const auto& [pixels, units] : {std::pair{1e4, 1e5}, {4e4, 1e5}, {1e4, 4e5}})
    measured.push_back({pixels, units, 0.5 + 1e-5 * pixels + 2e-6 * units});
  const PassTime time = fit_time(measured);
  EXPECT_NEAR(time.fixed, 0.5, 1e-6);
  EXPECT_NEAR(time.per_pixel, 1e-5, 1e-11);
  EXPECT_NEAR(time.per_unit, 2e-6, 1e-12);
}

TEST(CostTable, NoFactorIsBelowNothing) {
  const PassTime time = fit_time(std::vector<TimedPass>{{1, 1, 3}, {1, 2, 2}, {2, 1, 1}});
  EXPECT_GE(time.fixed, 0);
  EXPECT_GE(time.per_pixel, 0);
  EXPECT_GE(time.per_unit, 0);
}

TEST(CostTable, File_ReadsBack) {
  const std::string path = (std::filesystem::temp_directory_path() / "cuticle_costs_test" / "a.json").string();
  ASSERT_TRUE(write_cost_table(path, {"a device", "a driver", "today", {{"lines", {1, 2e-6, 3}}}}));
  const auto read = read_cost_table(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->passes.at("lines").per_pixel, 2e-6);
  std::filesystem::remove_all(std::filesystem::path(path).parent_path());
}

/// Every entry but those that nothing in a scene alone brings in.
TEST(WayIn, OfEveryEntryLeftOut_BringsItIn) {
  const scene::Scene scene = scene_of(k_shadowed);
  const Plan plan = make_plan(scene, shape());
  for (const LeftOut& left : plan.left_out) {
    const auto way = way_in(scene, shape(), {}, *left.entry);
    if (!way) {
      std::printf("no way in: %s (%s)\n", std::string(left.entry->name).c_str(), left.reason.c_str());
      continue;
    }
    EXPECT_TRUE(find_pass(way->plan, left.entry->name)) << left.entry->name;
    EXPECT_LE(way->changes.size(), 3u) << left.entry->name;
  }
}

}  // namespace
}  // namespace cuticle::plan::budgets_test
