// A measurement by our own Monte Carlo fibre, in the goniometers' format.
#include <cmath>
#include <numbers>

#include "study/lobes/lobes_study.h"
#include "study/measured/measured_study.h"
#include "study/oracle/rough_fibre.h"

namespace cuticle::study {
namespace {

/// Cells of 2 degrees of theta_i and 4 of phi; those that the gantry reaches.
constexpr oracle::DirectionBins k_cells{90, 90};
constexpr int k_orders = 20;  ///< crossings that are followed

double theta_of(int row) { return (row + 0.5) * std::numbers::pi / k_cells.thetas - std::numbers::pi / 2; }
double phi_of(int column) { return (column + 0.5) * 2 * std::numbers::pi / k_cells.phis - std::numbers::pi; }

}  // namespace

std::string synthetic_measurement(const bsdf::Fibre& fibre, const bsdf::Gantry& gantry, std::int64_t walks) {
  const auto orders = oracle::scattering_of(walked(fibre), {gantry.theta_o, 0, {}}, k_cells, k_orders, walks, 36);
  std::vector<bsdf::MeasuredDirection> directions;
  for (int row = 50; row < 70; ++row)        // theta_i 11 .. 49 degrees
    for (int step = 0; step < 55; ++step) {  // phi -18 .. 198 degrees
      const int column = (40 + step) % k_cells.phis;
      double sum = 0;
      for (const oracle::OrderScattering& order : orders)
        sum += order.density[std::size_t(row * k_cells.phis + column)].mean.y;
      const double turn = 40 + step >= k_cells.phis ? 2 * std::numbers::pi : 0;
      directions.push_back({theta_of(row), gantry.theta_o, phi_of(column) + turn, glm::dvec3(sum)});
    }
  return bsdf::gantry_text(directions);
}

}  // namespace cuticle::study
