// Scenes of earlier formats are read as those of this one, and say what has changed.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/migrate.h"
#include "scene/scene.h"

namespace cuticle::scene::migrate_test {
namespace {

TEST(Migration, EarlierVersion_IsBroughtUpAndSaysWhatChanged) {
  const auto scene = parse_scene(R"({"schema_version": 0, "strands": {"count": 321, "vertices": 7}, "name": "old"})",
                                 "/", "s.json", Catalogue());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->strand_count, 321);
  EXPECT_EQ(scene->strand_vertices, 7);
  EXPECT_THAT(scene->notes, testing::ElementsAre("the scene is of format 0; it is read as format 1",
                                                 "'strands.count' is called 'strand_count' now",
                                                 "'strands.vertices' is called 'strand_vertices' now"));
  const auto as_now = parse_scene(R"({"schema_version": 1, "strand_count": 321, "strand_vertices": 7, "name": "old"})",
                                  "/", "s.json", Catalogue());
  EXPECT_EQ(as_now->strand_count, scene->strand_count);
  EXPECT_TRUE(as_now->notes.empty());
}

TEST(Migration, FormerNameOfThisVersion_IsReadAndSaid) {
  constexpr std::string_view k_light = R"([{"position_m": [0, 2, 0], "intensity": [1, 2, 3]}])";
  const auto scene =
      parse_scene(fmt::format(R"({{"schema_version": 1, "lamps": {}}})", k_light), "/", "s.json", Catalogue());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->lights.back().point_light);
  EXPECT_THAT(scene->notes, testing::ElementsAre("'lamps' is called 'point_lights' now"));
  EXPECT_FALSE(parse_scene(fmt::format(R"({{"schema_version": 1, "lamps": {0}, "point_lights": {0}}})", k_light), "/",
                           "s.json", Catalogue()));
}

TEST(Migration, FormerWayOfDrawing_IsReadAndSaid) {
  const auto scene =
      parse_scene(R"({"schema_version": 1, "render": {"method": "truth"}})", "/", "s.json", Catalogue());
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->render_method, "supersampled");
  EXPECT_THAT(scene->notes, testing::ElementsAre("'render.method': 'truth' is called 'supersampled' now"));
  Json with_pass = *Json::parse(R"({"schema_version": 1, "passes": {"truth": {"samples": 4}, "tiles": {}}})");
  EXPECT_THAT(migrate(with_pass), testing::ElementsAre("'passes.truth' is called 'supersampled' now"));
  EXPECT_EQ(with_pass, *Json::parse(R"({"schema_version": 1, "passes": {"tiles": {}, "supersampled": {"samples": 4}}})"));
}

TEST(Migration, KeyOfAnEarlierVersion_IsRefusedInThisOneAndBesideItsNewName) {
  for (const char* text : {R"({"schema_version": 1, "strands": {"count": 3}})",
                           R"({"schema_version": 0, "strands": {"count": 3}, "strand_count": 5})",
                           R"({"schema_version": 0, "strands": {"count": 3, "colour": 5}})",
                           R"({"schema_version": -1, "strands": {"count": 3}})"}) {
    const auto scene = parse_scene(text, "/", "s.json", Catalogue());
    ASSERT_FALSE(scene) << text;
  }
}

}  // namespace
}  // namespace cuticle::scene::migrate_test
