#include "core/json/json.h"
#include "core/json/position.h"

#include <ctime>
#include <limits>

#include <gtest/gtest.h>

namespace cuticle::json_test {
namespace {

TEST(Json, BracedLists_BecomeObjectsOnlyWhereEveryItemIsAPairWithAKey) {
  EXPECT_EQ(Json({{"a", 1}, {"b", {2, 3}}}).dump(), R"({"a":1,"b":[2,3]})");
  EXPECT_EQ(Json({{"a", 1}, {"b", 2, 3}}).dump(), R"([["a",1],["b",2,3]])");
  EXPECT_EQ(Json(std::vector<double>{1, 0.5}).dump(), "[1.0,0.5]");
}

TEST(Json, WrittenAndRead_IsEqual) {
  const Json json = {{"zebra", std::numeric_limits<std::uint64_t>::max()},
                     {"least", std::numeric_limits<std::int64_t>::min()},
                     {"third", 1.0 / 3},
                     {"tiny", 5e-324},
                     {"text", "a \"quoted\" \n line"},
                     {"nothing", nullptr},
                     {"truth", true},
                     {"empty", {{"list", Json::list()}, {"object", Json::object()}}}};
  EXPECT_EQ(Json::parse(json.dump()).value(), json);
  EXPECT_EQ(Json::parse(json.dump(2)).value(), json);
}

TEST(Json, Keys_KeepTheirOrder) {
  EXPECT_EQ(Json::parse(R"({"z": 1, "a": {"b": []}, "c": {}})").value().dump(), R"({"z":1,"a":{"b":[]},"c":{}})");
}

TEST(Json, KeyGivenTwice_IsRefused) {
  EXPECT_EQ(Json::parse(R"([{"z": 1, "a": 2, "z": 3}])").error().message, "the key 'z' is given twice");
  EXPECT_TRUE(Json::parse(R"({"z": {"z": 1}})")) << "in another object";
}

/// Processor seconds of reading and writing an object of so many keys.
double seconds_of(int keys) {
  std::string text = "{";
  for (int i = 0; i < keys; ++i) text += "\"key " + std::to_string(i) + "\": 0, ";
  text += "\"last\": 0}";
  const std::clock_t begin = std::clock();
  EXPECT_GT(Json::parse(text).value().dump().size(), 0u);
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

TEST(Json, ManyKeys_TakeTimeInProportion) {
  const double few = seconds_of(10'000), many = seconds_of(160'000);
  EXPECT_LT(many, 64 * few) << "16 times as many; 256 if every key were compared with every other";
}

TEST(Json, NumbersOfDifferentKinds_AreComparedByValue) {
  EXPECT_EQ(Json(1), Json(1u));
  EXPECT_EQ(Json(1), Json(1.0));
  EXPECT_NE(Json(-1), Json(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_NE(Json(true), Json(1));
}

TEST(Json, NumbersThatJsonLacks_AreWrittenAsNull) {
  EXPECT_EQ(Json({std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 1}).dump(),
            "[null,null,1]");
}

TEST(Json, BytesThatAreNoUtf8_AreReplaced) { EXPECT_EQ(Json("a\xff").dump(), "\"a\xef\xbf\xbd\""); }

TEST(Json, WhatIsNoJson_IsRefusedWithLineAndColumn) {
  EXPECT_EQ(Json::parse("{\"a\": }").error().message, "not JSON at line 1, column 7");
  EXPECT_FALSE(Json::parse("").ok());
  EXPECT_FALSE(Json::parse("1 2").ok());
  EXPECT_EQ(Json::parse(std::string(200'000, '[')).error().message, "more than 256 levels");
  EXPECT_TRUE(Json::parse(std::string(256, '[') + std::string(256, ']')));
}

TEST(Json, Comments_AreReadOnlyWhereTheyAreAllowed) {
  const char* text = "{ // a point light\n\"a\": [1, /* two */ 2]}";
  EXPECT_EQ(Json::parse(without_comments(text)).value()["a"].size(), 2u);
  EXPECT_FALSE(Json::parse(text).ok());
  EXPECT_EQ(without_comments("\"// kept\" /* open"), "\"// kept\"        ");
}

TEST(JsonPosition, OfKeysAndItems_CountsLinesAndSkipsComments) {
  std::string text = "{\n  // \"b\": 0,\n  \"a\": {\"b\": \"x\\\"}\"},\n  \"list\": [1, [2, 3], {\"b\": true}]\n}";
  text = without_comments(text);
  const auto place = [&](std::vector<std::string> steps) {
    const TextPosition found = position_of(text, find_in_json(text, steps));
    return std::pair(found.line, found.column);
  };
  EXPECT_EQ(place({}), std::pair(1ul, 1ul));
  EXPECT_EQ(place({"a", "b"}), std::pair(3ul, 9ul));
  EXPECT_EQ(place({"list", "1", "1"}), std::pair(4ul, 19ul));
  EXPECT_EQ(place({"list", "2", "b"}), std::pair(4ul, 24ul));
  EXPECT_EQ(place({"a", "none"}), std::pair(3ul, 3ul));
}

TEST(Json, AnotherKindThanAskedFor_IsAMismatchThatSaysBoth) {
  const Json json = {{"name", 3}};
  EXPECT_THROW(json["name"].text(), Json::Mismatch);
  EXPECT_THROW(json.at("age"), Json::Mismatch);
  EXPECT_THROW(json["name"].at(0), Json::Mismatch);
  EXPECT_THROW(json.value("name", true), Json::Mismatch);
  EXPECT_EQ(json.value("age", 7), 7);
}

TEST(Json, ChangedInPlace_HoldsWhatWasPut) {
  Json json;
  json["list"].push_back(1);
  json["gone"] = 2;
  json.erase("gone");
  json.update({{"list", {1, 2}}, {"more", "x"}});
  EXPECT_EQ(json.dump(), R"({"list":[1,2],"more":"x"})");
}

}  // namespace
}  // namespace cuticle::json_test
