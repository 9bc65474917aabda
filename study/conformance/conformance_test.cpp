// The tables of `cuticle conformance`: what stands in them, and that a tolerance tells a fault from rounding.
#include <cmath>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "study/conformance/conformance.h"

namespace cuticle::conformance_test {
namespace {

std::vector<study::ConformanceRow> rows_of(const char* name) {
  auto rows = study::conformance_rows(**bsdf::find_model(name));
  EXPECT_TRUE(rows.ok());
  return *rows;
}

TEST(Conformance, EveryModel_HasFiniteValuesAtEasyAndHardPoints) {
  for (const bsdf::Model* model : bsdf::models()) {
    if (model->entry.name == "huang") continue;  // walks: a minute
    const auto rows = study::conformance_rows(*model);
    ASSERT_TRUE(rows.ok()) << model->entry.name;
    int hard = 0;
    for (const study::ConformanceRow& row : *rows) {
      EXPECT_TRUE(std::isfinite(row.value.x + row.value.y + row.value.z)) << model->entry.name << " " << row.settings;
      EXPECT_GE(row.tolerance, 0);
      hard += row.hard;
    }
    EXPECT_GT(hard, 50) << model->entry.name;
  }
}

TEST(Conformance, ModelOfTwoFields_IsListedInBoth) {
  std::set<bool> near;
  for (const auto& row : rows_of("chiang")) near.insert(row.settings.find("field=near") != std::string::npos);
  EXPECT_EQ(near.size(), 2u);
}

// A cosine too many moves more than half of the values past their tolerance.
TEST(Conformance, CosineTooMany_LeavesTheTolerance) {
  int off = 0, all = 0;
  for (const auto& row : rows_of("chiang")) {
    if (row.quantity != bsdf::Quantity::S || row.lobe != -1) continue;
    ++all;
    off += std::abs(row.value.x * (1 - std::cos(row.point.theta_i))) > row.tolerance;
  }
  EXPECT_GT(off, all / 2);
}

TEST(Conformance, Csv_HasARowForEachValueAndNamesEveryParameter) {
  const bsdf::Model& model = **bsdf::find_model("karis");
  const auto rows = rows_of("karis");
  std::istringstream text(study::conformance_csv(model, rows));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ(line, "model,settings,quantity,lobe,theta_i_deg,theta_o_deg,phi_deg,h,r,g,b,tolerance,hard");
  std::size_t lines = 0;
  for (; std::getline(text, line); ++lines)
    for (const registry::Parameter& parameter : model.entry.parameters)
      EXPECT_NE(line.find(std::string(parameter.name) + "="), std::string::npos) << parameter.name;
  EXPECT_EQ(lines, rows.size());
}

}  // namespace
}  // namespace cuticle::conformance_test
