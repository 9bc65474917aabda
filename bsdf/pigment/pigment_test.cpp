#include "bsdf/pigment/pigment.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::bsdf::pigment_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(PigmentTable, EachByName_HasItsOwnNumbers) {
  EXPECT_EQ(absorption_of_pigments(*find_pigment_table("deon_pbrt"), 1, 0).value(), glm::dvec3(0.419, 0.697, 1.37));
  EXPECT_EQ(absorption_of_pigments(*find_pigment_table("deon_pbrt"), 0, 1).value(), glm::dvec3(0.187, 0.4, 1.05));
  EXPECT_EQ(absorption_of_pigments(*find_pigment_table("blender"), 1, 0).value(), glm::dvec3(0.506, 0.841, 1.653));
  EXPECT_EQ(absorption_of_pigments(*find_pigment_table("blender"), 0, 1).value(), glm::dvec3(0.343, 0.733, 1.924));
}

TEST(PigmentTable, Unknown_ListsThemAndOffersTheNearest) {
  const auto table = find_pigment_table("blendr");
  ASSERT_FALSE(table.ok());
  EXPECT_THAT(table.error().message, HasSubstr("deon_pbrt"));
  EXPECT_THAT(table.error().hint, HasSubstr("blender"));
}

TEST(Pigments, Mixture_IsTheSum) {
  const PigmentTable table = *find_pigment_table("deon_pbrt");
  const glm::dvec3 mixture = *absorption_of_pigments(table, 1.3, 0.4);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mixture[c], 1.3 * table.eumelanin[c] + 0.4 * table.pheomelanin[c], 1e-15);
}

TEST(Pigments, BadConcentration_IsNamedWithItsRange) {
  const auto absorption = absorption_of_pigments(*find_pigment_table("blender"), 1, -0.5);
  ASSERT_FALSE(absorption.ok());
  EXPECT_THAT(absorption.error().message, AllOf(HasSubstr("pheomelanin"), HasSubstr("-0.5"), HasSubstr("100")));
  EXPECT_FALSE(absorption_of_pigments(*find_pigment_table("blender"), std::nan(""), 0).ok());
}

TEST(MelaninConcentrations, ArtistsNumbers_AreTheirLogarithm) {
  const Melanin melanin = *melanin_concentrations(0.25, 0.5);
  EXPECT_NEAR(melanin.eumelanin, -0.5 * std::log(0.75), 1e-15);
  EXPECT_NEAR(melanin.pheomelanin, -0.5 * std::log(0.75), 1e-15);
  EXPECT_NEAR(melanin_concentrations(1, 0)->eumelanin, -std::log(1e-4), 1e-12);
  EXPECT_FALSE(melanin_concentrations(1.1, 0).ok());
  EXPECT_FALSE(melanin_concentrations(0.5, -1).ok());
}

// Chiang et al. 2016, equation 9, for beta_n = 0.3, whose polynomial is 5.8873...
TEST(AssemblyColour, KnownRoughness_IsThePapersFit) {
  const double scale = 5.969 - 0.215 * 0.3 + 2.532 * 0.09 - 10.73 * 0.027 + 5.574 * 0.0081 + 0.245 * 0.00243;
  const glm::dvec3 sigma_a = *absorption_of_assembly({0.5, 0.2, 1}, 0.3);
  EXPECT_NEAR(sigma_a.x, std::pow(std::log(0.5) / scale, 2), 1e-15);
  EXPECT_EQ(sigma_a.z, 0);
}

TEST(AssemblyColour, ThereAndBack_IsTheSame) {
  const glm::dvec3 color(0.9, 0.3, 0.004);
  const glm::dvec3 back = *color_of_assembly(*absorption_of_assembly(color, 0.7), 0.7);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], color[c], 1e-14);
}

TEST(AssemblyColour, Black_IsRefusedByComponent) {
  const auto sigma_a = absorption_of_assembly({0.5, 0, 0.5}, 0.3);
  ASSERT_FALSE(sigma_a.ok());
  EXPECT_THAT(sigma_a.error().message, AllOf(HasSubstr("color.g"), HasSubstr("0.001")));
}

TEST(FibreColour, ThereAndBack_IsTheSame) {
  const Model& model = **find_model("marschner");
  registry::ParameterValues values = registry::default_values(model.entry.parameters);
  const glm::dvec3 color(0.8, 0.5, 0.2);
  values.set("sigma_a", absorption_of_fibre(model, values, color, 0.4).value());
  const glm::dvec3 back = *color_of_fibre(model, values, 0.4);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], color[c], 1e-9);
}

// The same colour means far less absorption as an assembly, where light meets many fibres, than as one fibre.
TEST(FibreColour, AgainstAssembly_AbsorbsFarMore) {
  const Model& model = **find_model("marschner");
  const registry::ParameterValues values = registry::default_values(model.entry.parameters);
  const glm::dvec3 color(0.3);
  EXPECT_GT(absorption_of_fibre(model, values, color).value().x, 5 * absorption_of_assembly(color, 0.3).value().x);
}

TEST(FibreColour, BrighterThanTheFibreCanBe_IsRefusedWithItsAlbedos) {
  const Model& model = **find_model("marschner");
  const auto sigma_a =
      absorption_of_fibre(model, registry::default_values(model.entry.parameters), glm::dvec3(0.5, 1.5, 0.01));
  ASSERT_FALSE(sigma_a.ok());
  EXPECT_THAT(sigma_a.error().message, AllOf(HasSubstr("color.g"), HasSubstr("1.5"), HasSubstr("albedos")));
}

TEST(FibreColour, ModelWithoutAbsorption_IsRefused) {
  const Model& model = **find_model("kajiya_kay");
  const auto sigma_a = absorption_of_fibre(model, registry::default_values(model.entry.parameters), glm::dvec3(0.5));
  ASSERT_FALSE(sigma_a.ok());
  EXPECT_THAT(sigma_a.error().message, AllOf(HasSubstr("kajiya_kay"), HasSubstr("sigma_a")));
}

}  // namespace
}  // namespace cuticle::bsdf::pigment_test
