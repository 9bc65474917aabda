#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/json/json.h"
#include "core/registry/entry.h"

namespace cuticle::registry::registry_entry_test {
namespace {

using ::testing::HasSubstr;

constexpr std::string_view k_demands[] = {"light", "colliders"};
constexpr std::string_view k_systems[] = {"N17"};
constexpr Parameter k_parameters[] = {{"slices", ParameterType::integer, "1", 1, 64, "16", {}, "layers"}};

Entry entry() {
  return {.kind = EntryKind::method, .name = "opacity_map", .summary = "slices", .source = "a paper",
          .parameters = k_parameters, .demands = k_demands, .stage = Stage::shadow, .systems = k_systems};
}

TEST(Judge, AllFactsHold_GivesTheirReasons) {
  const Verdict verdict = judge(entry(), {{"light", {true, "1 light"}}, {"colliders", {true, "2 spheres"}}});
  EXPECT_TRUE(verdict.demanded);
  EXPECT_EQ(verdict.reason, "1 light; 2 spheres");
}

TEST(Judge, OneFactFails_GivesItsReason) {
  const Verdict verdict = judge(entry(), {{"light", {true, "1 light"}}, {"colliders", {false, "no collider"}}});
  EXPECT_FALSE(verdict.demanded);
  EXPECT_EQ(verdict.reason, "no collider");
}

TEST(Judge, AFactThatNobodyStates_IsNotDemanded) {
  const Verdict verdict = judge(entry(), {{"light", {true, "1 light"}}});
  EXPECT_FALSE(verdict.demanded);
  EXPECT_THAT(verdict.reason, HasSubstr("colliders"));
}

TEST(Judge, NoDemands_RunsAlways) { EXPECT_TRUE(judge(Entry{}, {}).demanded); }

TEST(Entries, AsJson_StateParametersDemandsAndSystems) {
  const Entry one = entry();
  const Entry* list[] = {&one};
  const Json parsed = Json::parse(to_json(list)).value();
  EXPECT_EQ(parsed[0]["name"], "opacity_map");
  EXPECT_EQ(parsed[0]["stage"], "shadow");
  EXPECT_EQ(parsed[0]["parameters"][0]["range"][1], 64);
  EXPECT_EQ(parsed[0]["demands"][1], "colliders");
  EXPECT_EQ(parsed[0]["systems"][0], "N17");
}

TEST(Entries, AsText_NameEveryParameterWithItsRange) {
  const Entry one = entry();
  const Entry* list[] = {&one};
  const std::string text = to_text(list);
  for (const char* part : {"opacity_map", "a paper", "slices", "1 .. 64", "16"}) EXPECT_THAT(text, HasSubstr(part));
}

}  // namespace
}  // namespace cuticle::registry::registry_entry_test
