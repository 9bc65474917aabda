#include "bsdf/materialx/materialx.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bsdf/model.h"

namespace cuticle::bsdf::materialx_test {
namespace {

using ::testing::HasSubstr;

const Model& chiang() { return **find_model("chiang"); }

std::string document(const std::string& hair, const std::string& others = "") {
  return "<?xml version=\"1.0\"?><materialx version=\"1.39\">" + others +
         "<chiang_hair_bsdf name=\"hair\" type=\"BSDF\">" + hair + "</chiang_hair_bsdf></materialx>";
}
std::string input(const std::string& name, const std::string& type, const std::string& value) {
  return "<input name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}
std::string link(const std::string& name, const std::string& type, const std::string& node, const std::string& output) {
  return "<input name=\"" + name + "\" type=\"" + type + "\" nodename=\"" + node + "\" output=\"" + output + "\"/>";
}

registry::ParameterValues values_of(const std::string& xml) {
  const auto mapping = parse_materialx(xml, "test.mtlx");
  EXPECT_TRUE(mapping.ok()) << (mapping.ok() ? "" : mapping.error().message);
  return *parse_settings(chiang(), "", mapping->settings);
}

TEST(MaterialX, HairWithoutInputs_HasTheStandardsDefaults) {
  const registry::ParameterValues values = values_of(document(""));
  EXPECT_EQ(values.real("eta"), 1.55);
  EXPECT_EQ(values.rgb("sigma_a"), glm::dvec3(0));
  EXPECT_EQ(values.real("alpha"), 0);
}

TEST(MaterialX, RoughnessNode_GivesItsNumbersBack) {
  const std::string node = "<chiang_hair_roughness name=\"r\" type=\"multioutput\">" +
                           input("longitudinal", "float", "0.37") + input("azimuthal", "float", "0.62") +
                           "</chiang_hair_roughness>";
  std::string hair;
  for (const char* output : {"roughness_R", "roughness_TT", "roughness_TRT"})
    hair += link(output, "vector2", "r", output);
  const std::string xml = document(hair, node);
  EXPECT_NEAR(values_of(xml).real("beta_m"), 0.37, 1e-14);
  EXPECT_NEAR(values_of(xml).real("beta_n"), 0.62, 1e-14);
  EXPECT_THAT(parse_materialx(xml, "test.mtlx")->words, testing::Not(HasSubstr("left out")));
}

// d'Eon et al. 2011: exp(-(0.419, 0.697, 1.37)) and exp(-(0.187, 0.4, 1.05)) are the default colours, to six digits.
TEST(MaterialX, MelaninNode_AbsorbsAsItsPigments) {
  const std::string node = "<deon_hair_absorption_from_melanin name=\"m\" type=\"vector3\">" +
                           input("melanin_concentration", "float", "0.5") + input("melanin_redness", "float", "0.25") +
                           "</deon_hair_absorption_from_melanin>";
  const glm::dvec3 sigma_a =
      values_of(document(link("absorption_coefficient", "vector3", "m", "absorption"), node)).rgb("sigma_a");
  const double eumelanin = 0.75 * std::log(2.0), pheomelanin = 0.25 * std::log(2.0);
  EXPECT_NEAR(sigma_a.x, eumelanin * 0.419 + pheomelanin * 0.187, 3e-6);
  EXPECT_NEAR(sigma_a.y, eumelanin * 0.697 + pheomelanin * 0.4, 3e-6);
  EXPECT_NEAR(sigma_a.z, eumelanin * 1.37 + pheomelanin * 1.05, 3e-6);
}

TEST(MaterialX, ColorNode_AbsorbsAsAnAssemblyOfThatColour) {
  const std::string node = "<chiang_hair_absorption_from_color name=\"c\" type=\"vector3\">" +
                           input("color", "color3", "0.5, 0.2, 0") + input("azimuthal_roughness", "float", "0.3") +
                           "</chiang_hair_absorption_from_color>";
  const glm::dvec3 sigma_a =
      values_of(document(link("absorption_coefficient", "vector3", "c", "absorption"), node)).rgb("sigma_a");
  const double scale = 5.969 - 0.215 * 0.3 + 2.532 * 0.09 - 10.73 * 0.027 + 5.574 * 0.0081 + 0.245 * 0.00243;
  EXPECT_NEAR(sigma_a.x, std::pow(std::log(0.5) / scale, 2), 1e-14);
  EXPECT_NEAR(sigma_a.z, std::pow(std::log(0.001) / scale, 2), 1e-14);
}

TEST(MaterialX, CuticleAngle_IsATiltFromOneHalf) {
  EXPECT_NEAR(values_of(document(input("cuticle_angle", "float", "0.51"))).real("alpha"), 0.01 * 3.14159265358979324,
              1e-15);
}

TEST(MaterialX, WhatTheModelLacks_IsSaidInWords) {
  const std::string words =
      parse_materialx(document(input("tint_TT", "color3", "1, 0.5, 1") + input("roughness_TT", "vector2", "0.9, 0.1")),
                      "a")
          ->words;
  EXPECT_THAT(words, testing::AllOf(HasSubstr("tint_TT"), HasSubstr("roughness_TT"), HasSubstr("left out")));
}

TEST(MaterialX, Written_IsReadBack) {
  const registry::ParameterValues values =
      *parse_settings(chiang(), "", "eta=1.4,sigma_a=0.1/0.75/3,beta_m=0.123,beta_n=0.456,alpha=-0.05");
  const registry::ParameterValues back = values_of(write_materialx(values));
  for (const char* name : {"eta", "beta_m", "beta_n", "alpha"})
    EXPECT_NEAR(back.real(name), values.real(name), 1e-14) << name;
  EXPECT_EQ(back.rgb("sigma_a"), values.rgb("sigma_a"));
}

struct Refusal {
  const char* what;
  std::string xml;
  std::vector<const char*> words;
};
class MaterialXRefusal : public testing::TestWithParam<Refusal> {};
INSTANTIATE_TEST_SUITE_P(
    Bad, MaterialXRefusal,
    testing::Values(
        Refusal{"xml", "<materialx><a>", {"bad.mtlx", "byte"}}, Refusal{"root", "<a/>", {"materialx"}},
        Refusal{"none", "<materialx/>", {"0 nodes chiang_hair_bsdf"}},
        Refusal{"value", document(input("ior", "float", "0.5")), {"'hair'", "ior", "0.5", "1.05 .. 3"}},
        Refusal{"nan", document(input("ior", "float", "nan")), {"ior", "nan", "1 number"}},
        Refusal{"count",
                document(input("absorption_coefficient", "vector3", "1, 2")),
                {"absorption_coefficient", "3 numbers"}},
        Refusal{"type", document(input("ior", "color3", "1,1,1")), {"ior", "color3", "float"}},
        Refusal{"input", document(input("iorr", "float", "1.5")), {"iorr", "ior"}},
        Refusal{"twice", document(input("ior", "float", "1.5") + input("ior", "float", "1.6")), {"ior", "twice"}},
        Refusal{"nowhere", document(link("roughness_R", "vector2", "gone", "roughness_R")), {"roughness_R", "gone"}},
        Refusal{"linked_type",
                document(link("absorption_coefficient", "vector3", "r", "roughness_R"),
                         "<chiang_hair_roughness name=\"r\"/>"),
                {"absorption_coefficient", "vector3", "vector2"}},
        Refusal{"itself", document(link("roughness_R", "vector2", "hair", "out")), {"roughness_R", "BSDF"}},
        Refusal{"tilt", document(input("cuticle_angle", "float", "0.9")), {"cuticle_angle", "0.9"}},
        Refusal{"node", document(link("roughness_R", "vector2", "x", ""), "<noise2d name=\"x\"/>"), {"noise2d"}},
        Refusal{"output",
                document(link("roughness_R", "vector2", "r", "roughness"), "<chiang_hair_roughness name=\"r\"/>"),
                {"roughness", "roughness_TT"}}),
    [](const auto& info) { return std::string(info.param.what); });
TEST_P(MaterialXRefusal, Document_IsRefusedByName) {
  const auto mapping = parse_materialx(GetParam().xml, "bad.mtlx");
  ASSERT_FALSE(mapping.ok());
  EXPECT_EQ(mapping.error().kind, ErrorKind::bad_input);
  for (const char* word : GetParam().words) EXPECT_THAT(mapping.error().message, HasSubstr(word));
}

TEST(MaterialX, MissingFile_IsNamed) {
  const auto mapping = read_materialx("/nonexistent/a.mtlx");
  ASSERT_FALSE(mapping.ok());
  EXPECT_THAT(mapping.error().message, HasSubstr("/nonexistent/a.mtlx"));
}

}  // namespace
}  // namespace cuticle::bsdf::materialx_test
