// Tables of flat fibres hold the mean over turns of the cross-section.
#include <numbers>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "lut/cell_average.h"
#include "lut/evaluate.h"

namespace cuticle::lut::lut_turns_test {
namespace {

const bsdf::Model& marschner() { return **bsdf::find_model("marschner"); }
registry::ParameterValues values_of(const std::string& settings) {
  return *bsdf::parse_settings(marschner(), "", settings);
}
std::int64_t turns_of(std::string_view layout, const std::string& settings) {
  return table_values(marschner(), values_of(settings), **find_layout(layout)).integer("turns");
}

TEST(TableValues, FlatFibre_AsksForAsManyTurnsAsItsTexelsNeed) {
  EXPECT_EQ(turns_of("nalu_theta", "aspect=0.85"), 128);
  EXPECT_EQ(turns_of("factored", "aspect=0.85"), 16);
  EXPECT_EQ(turns_of("dual_scattering", "aspect=0.85"), 2);
  EXPECT_EQ(turns_of("nalu_theta", "aspect=0.85,caustic=smoothed"), 16);
  EXPECT_EQ(turns_of("nalu_theta", "aspect=0.85,turns=3"), 3);
  EXPECT_EQ(turns_of("nalu_theta", ""), 0);
}

/// The share of the light that TRT of a round fibre scatters near one theta_d.
double energy(double eta, double theta_d) {
  const bsdf::Point at{.theta_o = theta_d};
  glm::dvec3 out(0);
  const auto values = values_of(fmt::format("eta={:.17g},beta=0.001,alpha=0", eta));
  EXPECT_TRUE(bsdf::evaluate(marschner(), values, bsdf::Precision::f64, {bsdf::Quantity::albedo, 2, std::span(&at, 1)},
                             std::span(&out, 1))
                  .ok());
  return out.x;
}

/// The mean over turns: 2 phi_h is even on the circle, so that the paper's index is mean + swing cos of an even angle.
double mean_energy(double eta, double aspect, double theta_d) {
  const double twice = 2 * (eta - 1), e1 = twice * aspect * aspect - eta + 2, e2 = twice / (aspect * aspect) - eta + 2;
  double sum = 0;
  for (int k = 0; k < 300; ++k)
    sum += energy(((e1 + e2) + std::cos(2 * std::numbers::pi * (k + 0.5) / 300) * (e2 - e1)) / 2, theta_d) / 300;
  return sum;
}

TEST(TablesOfFlatFibres, RowOverAzimuths_HasTheMeanEnergyOfAllTurns) {
  const TableSet set = *bake(marschner(), values_of("aspect=0.85"), **find_layout("nalu_theta"), 32, silent_progress());
  for (const Table& table : set.tables)
    for (int c = 0; c < int(table.layout->channels.size()); ++c) {
      if (table.layout->channels[std::size_t(c)].name != "N_TRT.g") continue;
      for (int y : {0, 10, 20}) {
        double sum = 0;
        for (int x = 0; x < table.image.width; ++x) {
          const PhiInterval cell = phi_interval(*table.layout, 32, x / 32.0, (x + 1) / 32.0, (y + 0.5) / 32);
          sum += double(table.image.at(x, y, c)) * (cell.end - cell.begin);
        }
        const double theta_d = axis_angle(table.layout->v, 32, (y + 0.5) / 32);
        const double truth = mean_energy(1.55, 0.85, theta_d);
        EXPECT_NEAR(2 * sum, truth, 3e-4 * truth) << y;
      }
    }
}

}  // namespace
}  // namespace cuticle::lut::lut_turns_test
