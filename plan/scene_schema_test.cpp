// The published JSON Schema is the one that the registries give, it is a valid draft-7 schema, and it agrees with the
// loader.
#include <fstream>
#include <sstream>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "plan/plan.h"

namespace cuticle::plan::scene_schema_test {
namespace {

std::string text_of(const std::string& name) {
  std::ifstream file(fmt::format("{}/{}", CUTICLE_SOURCE_DIR, name));
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

bool schema_accepts(const std::string& text) {
  static const auto schema = [] {
    auto parsed = std::make_unique<valijson::Schema>();
    const auto json = nlohmann::json::parse(scene::scene_schema(catalogue()));
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(json), *parsed);
    return parsed;
  }();
  const auto json = nlohmann::json::parse(text);
  return valijson::Validator().validate(*schema, valijson::adapters::NlohmannJsonAdapter(json), nullptr);
}

bool loader_accepts(const std::string& text) {
  return scene::parse_scene(text, CUTICLE_SOURCE_DIR "/scenes", "test", catalogue()).ok();
}

TEST(SceneSchema, Published_IsUpToDate) {
  EXPECT_TRUE(text_of("docs/scene.schema.json") == scene::scene_schema(catalogue()))
      << "run: cuticle plan --schema > docs/scene.schema.json";
}

class OurScene : public testing::TestWithParam<const char*> {};
TEST_P(OurScene, InTheRepository_IsAcceptedBySchemaAndLoader) {
  const std::string text = text_of(fmt::format("scenes/{}", GetParam()));
  EXPECT_TRUE(schema_accepts(text));
  EXPECT_TRUE(loader_accepts(text));
}
INSTANTIATE_TEST_SUITE_P(SceneSchema, OurScene,
                         testing::Values("demo.json", "demo_groom.json", "frostbite.json", "hairworks.json",
                                         "hairworks_split.json", "head_turn.json", "loose_hair.json", "clumped.json",
                                         "nalu.json", "red_hair.json", "still.json", "straight.json", "waves.json",
                                         "curls.json", "mermaid.json"));

class BadScene : public testing::TestWithParam<const char*> {};
TEST_P(BadScene, OfAnyKind_IsRefusedBySchemaAndLoader) {
  EXPECT_FALSE(schema_accepts(GetParam())) << GetParam();
  EXPECT_FALSE(loader_accepts(GetParam())) << GetParam();
}
INSTANTIATE_TEST_SUITE_P(
    SceneSchema, BadScene,
    testing::Values("{}", R"({"schema_version": 2})", R"({"schema_version": 1, "lihgts": []})",
                    R"({"schema_version": 1, "strand_vertices": 257})", R"({"schema_version": 1, "strand_count": 1.5})",
                    R"({"schema_version": 1, "camera": {"position_m": [0, 0]}})",
                    R"({"schema_version": 1, "shadow": {"method": {}}})",
                    R"({"schema_version": 1, "shadow": {"method": {"opacity_map": {"slices": 1}}}})",
                    R"({"schema_version": 1, "shadow": {"method": {"none": {}}, "fibre_alpha": 1.2}})",
                    R"({"schema_version": 1, "shadow": {"method": {"none": {}}, "fibre_alpha": [0.1, 1.2, 0.1]}})",
                    R"({"schema_version": 1, "shadow": {"method": {"none": {}}, "fibre_alpha": [0.1, 0.2]}})",
                    R"({"schema_version": 1, "material": {"model": {"marschner": {"eta": 9}}}})",
                    R"({"schema_version": 1, "material": {"model": {"marschner": {"etta": 1.5}}}})",
                    R"({"schema_version": 1, "material": {"layout": "nalo"}})",
                    R"({"schema_version": 1, "lights": [{"to_light": [0, 1, 0]}]})",
                    R"({"schema_version": 1, "point_lights": [{"intensity": [1, 1, 1]}]})",
                    R"({"schema_version": 1, "outputs": {"color": 1}})"));

}  // namespace
}  // namespace cuticle::plan::scene_schema_test
