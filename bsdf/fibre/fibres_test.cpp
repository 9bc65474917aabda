#include "bsdf/fibre/fibres.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cuticle::bsdf::fibres_test {
namespace {

using ::testing::HasSubstr;

TEST(Fibres, Blond_AbsorbsWhatItsPigmentsDo) {
  const NamedFibre blond = *find_fibre("blond");
  EXPECT_NEAR(blond.fibre.sigma_a.x, 0.3 * 0.419, 1e-15);
  EXPECT_NEAR(blond.fibre.sigma_a.z, 0.3 * 1.37, 1e-15);
}

TEST(Fibres, AllOfThem_AreWithinTheirRanges) {
  for (const NamedFibre& named : fibres()) {
    const Fibre& fibre = named.fibre;
    EXPECT_TRUE(fibre.radius > 5e-6 && fibre.radius < 1e-4) << named.name;
    EXPECT_TRUE(fibre.aspect > 0.5 && fibre.aspect <= 1) << named.name;
    EXPECT_TRUE(fibre.scale_tilt > 0 && fibre.scale_tilt < 0.1) << named.name;
    EXPECT_EQ(named.name.starts_with("fur_"), fibre.medulla_ratio > 0) << named.name;
  }
}

TEST(Fibres, MappedNumbers_AreWrittenWithoutTheLastBitsOfAProduct) {
  const FibreMapping mapping = (*find_model("marschner"))->from_fibre(find_fibre("blond")->fibre);
  EXPECT_THAT(mapping.settings, HasSubstr("sigma_a=0.1257/0.2091/0.411,"));
}

TEST(Fibres, Unknown_ListsThemAndOffersTheNearest) {
  const auto fibre = find_fibre("blonde");
  ASSERT_FALSE(fibre.ok());
  EXPECT_THAT(fibre.error().message, HasSubstr("black"));
  EXPECT_THAT(fibre.error().hint, HasSubstr("blond"));
}

TEST(Fibres, EveryModelThatMapsAFibre_TakesEachOfThem) {
  for (const Model* model : models()) {
    if (!model->from_fibre) continue;
    for (const NamedFibre& named : fibres()) {
      const FibreMapping mapping = model->from_fibre(named.fibre);
      const auto values = parse_settings(*model, "", mapping.settings);
      EXPECT_TRUE(values.ok()) << model->entry.name << " " << named.name << ": " << mapping.settings << "\n"
                               << (values.ok() ? "" : values.error().message);
      EXPECT_FALSE(mapping.words.empty()) << model->entry.name;
    }
  }
}

}  // namespace
}  // namespace cuticle::bsdf::fibres_test
