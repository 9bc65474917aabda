#pragma once
// What a table is compared with: the model's exact values on a grid of texture coordinates. For certify and lut/fit.
#include <cuticle/lut/evaluate.h>

namespace cuticle::lut {

/// The grid on which a table is compared: bins of texture coordinates; points are their middles.
struct ComparisonGrid {
  int columns = 0, rows = 0;
  double begin(int column) const { return double(column) / columns; }
  double middle(int column) const { return (column + 0.5) / columns; }
  double row(int row) const { return (row + 0.5) / rows; }
  std::size_t size() const { return std::size_t(columns) * rows; }
};

/// Values row by row of the grid.
struct ExactValues {
  std::vector<glm::dvec3> values;
  std::vector<std::uint8_t> left_out;  ///< 1: not to be compared; empty: all are
};

/// The channel's exact values: at the grid's points, or, for cell averages, their means over the azimuths of its bins,
/// without bins that filter a texel on a caustic.
Result<ExactValues> exact_values(const Source& source, const Channel& channel, const Table& table,
                                 const ComparisonGrid& grid);

/// What the engine's filter makes of the table at that point, or of the bin's mean: exact_values' counterpart.
double filtered_value(const Table& table, int channel, const ComparisonGrid& grid, std::size_t index);

}  // namespace cuticle::lut
