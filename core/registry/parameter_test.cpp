#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json/json.h"
#include "core/registry/former_names.h"
#include "core/registry/parameter.h"

namespace cuticle::registry::parameter_test {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view k_shapes[] = {"sine", "square"};
constexpr Parameter k_table[] = {
    {"eta", ParameterType::real, "1", 1, 3, "1.55", {}, "index of refraction"},
    {"slices", ParameterType::integer, "1", 1, 64, "16", {}, "layers"},
    {"caustics", ParameterType::boolean, "", 0, 0, "true", {}, "smoothed"},
    {"shape", ParameterType::choice, "", 0, 0, "sine", k_shapes, "of the wave"},
    {"sigma_a", ParameterType::rgb, "1/radius", 0, 10, "0.2", {}, "absorption"},
};

TEST(Parameters, Defaults_AreTheTablesOwn) {
  const ParameterValues values = default_values(k_table);
  EXPECT_EQ(values.real("eta"), 1.55);
  EXPECT_EQ(values.integer("slices"), 16);
  EXPECT_TRUE(values.boolean("caustics"));
  EXPECT_EQ(values.choice("shape"), "sine");
  EXPECT_EQ(values.rgb("sigma_a"), glm::dvec3(0.2));
}

TEST(Parameters, Assignments_OverrideTheDefaults) {
  const ParameterValues values =
      parse_assignments(k_table, "eta=1.4, slices=8,shape=square,sigma_a=0.2/0.4/0.8,caustics=off").value();
  EXPECT_EQ(values.real("eta"), 1.4);
  EXPECT_EQ(values.integer("slices"), 8);
  EXPECT_FALSE(values.boolean("caustics"));
  EXPECT_EQ(values.choice("shape"), "square");
  EXPECT_EQ(values.rgb("sigma_a"), glm::dvec3(0.2, 0.4, 0.8));
}

// Read for one version more, with a message.
TEST(Parameters, FormerNames_AreReadAsThoseOfNow) {
  constexpr std::string_view variants[] = {"corrected", "as_published"};
  const Parameter table[] = {
      {"variant", ParameterType::choice, "", 0, 0, "corrected", variants, "of the model"},
      {"point_light_radius", ParameterType::real, "m", 0, 10, "0", {}, "of every point light"},
  };
  static std::vector<std::string> heard;
  set_former_name_listener([](std::string_view former, std::string_view now) {
    heard.push_back(fmt::format("{} is {}", former, now));
  });
  const auto typed = parse_assignments(table, "variant=literal,lamp_radius=0.5");
  EXPECT_THAT(heard, testing::UnorderedElementsAre("literal is as_published", "lamp_radius is point_light_radius"));
  ASSERT_TRUE(typed.ok());
  EXPECT_EQ(typed->choice("variant"), "as_published");
  EXPECT_EQ(typed->real("point_light_radius"), 0.5);
  const auto read = values_from_json(table, R"({"lamp_radius": 0.25, "variant": "literal"})", "s");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->real("point_light_radius"), 0.25);
  EXPECT_EQ(read->choice("variant"), "as_published");
  EXPECT_EQ(heard.size(), 2) << "once a process";
  set_former_name_listener(nullptr);
}

TEST(Parameters, EmptyAssignments_GiveTheDefaults) {
  EXPECT_EQ(parse_assignments(k_table, "").value(), default_values(k_table));
}

TEST(Parameters, UnknownName_IsRefusedWithTheNearest) {
  const Result<ParameterValues> values = parse_assignments(k_table, "sigma=1");
  ASSERT_FALSE(values);
  EXPECT_EQ(values.error().kind, ErrorKind::usage);
  EXPECT_THAT(values.error().message, HasSubstr("'sigma'"));
  EXPECT_THAT(values.error().hint, HasSubstr("sigma_a"));
}

TEST(Parameters, ValueOutOfRange_NamesParameterValueAndRange) {
  const Result<ParameterValues> values = parse_assignments(k_table, "eta=0.5");
  ASSERT_FALSE(values);
  for (const char* part : {"eta", "0.5", "1 .. 3"}) EXPECT_THAT(values.error().message, HasSubstr(part));
}

class RefusedAssignment : public ::testing::TestWithParam<const char*> {};
TEST_P(RefusedAssignment, Text_IsAUsageError) {
  const Result<ParameterValues> values = parse_assignments(k_table, GetParam());
  ASSERT_FALSE(values);
  EXPECT_EQ(values.error().kind, ErrorKind::usage);
}
INSTANTIATE_TEST_SUITE_P(Texts, RefusedAssignment,
                         ::testing::Values("eta", "eta=", "eta=nan", "eta=inf", "eta=1.5x", "slices=2.5", "slices=65",
                                           "slices=99999999999999999999", "caustics=maybe", "shape=sin", "sigma_a=1/2",
                                           "sigma_a=1/2/3/4", "sigma_a=1/2/11", "sigma_a=/", "=1", "eta=1.5;slices=2"));

TEST(Parameters, EveryValueAsText_ParsesBack) {
  const ParameterValues values = parse_assignments(k_table, "eta=1.3333333333333333,sigma_a=0.1/0.2/0.3").value();
  for (const Parameter& parameter : k_table) {
    const Value& value = values.all().find(parameter.name)->second;
    EXPECT_EQ(parse_value(parameter, to_text(value)).value(), value) << parameter.name;
  }
}

TEST(NearestName, OneLetterOff_IsFound) {
  constexpr std::string_view known[] = {"gravity", "colliders", "wind"};
  EXPECT_EQ(nearest_name("gravty", known), "gravity");
  EXPECT_EQ(nearest_name("colider", known), "colliders");
  EXPECT_EQ(nearest_name("temperature", known), "");
  EXPECT_EQ(nearest_name("", {}), "");
}

TEST(NearestName, AnotherCaseOrAUnitLeftOff_IsFound) {
  constexpr std::string_view known[] = {"S", "M", "N", "fov_deg", "far"};
  EXPECT_EQ(nearest_name("n", known), "N");
  EXPECT_EQ(nearest_name("fov", known), "fov_deg");
}

TEST(ParameterSchema, OfATable_RefusesUnknownKeysAndStatesRanges) {
  const Json schema = Json::parse(json_schema(k_table)).value();
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["eta"]["maximum"], 3);
  EXPECT_EQ(schema["properties"]["slices"]["type"], "integer");
  EXPECT_EQ(schema["properties"]["shape"]["enum"].size(), 2u);
  EXPECT_EQ(schema["properties"]["sigma_a"]["default"].size(), 3u);
}

TEST(ParameterJson, Object_BecomesValues) {
  const auto values = values_from_json(k_table, R"({"eta": 1.5, "sigma_a": [0.1, 0.2, 0.3], "slices": 4, "caustics": false})", "x").value();
  EXPECT_EQ(values.real("eta"), 1.5);
  EXPECT_EQ(values.rgb("sigma_a"), glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(values.choice("shape"), "sine");
}

TEST(ParameterJson, ValuesWrittenAndRead_AreEqual) {
  const ParameterValues values = parse_assignments(k_table, "eta=1.1,shape=square,sigma_a=1/2/3").value();
  EXPECT_EQ(values_from_json(k_table, to_json(values), "x").value(), values);
}

TEST(ParameterJson, Errors_StartWithThePlaceAndAreBadInput) {
  for (const char* text : {"{\"eta\": 5}", "{\"eta\": \"1.5\"}", "{\"slices\": 2.0}", "{\"etta\": 1}", "[1]", "{", "{\"sigma_a\": [1, 2]}"}) {
    const Result<ParameterValues> values = values_from_json(k_table, text, "material.model");
    ASSERT_FALSE(values) << text;
    EXPECT_EQ(values.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(values.error().message, ::testing::StartsWith("material.model: "));
  }
}

}  // namespace
}  // namespace cuticle::registry::parameter_test
