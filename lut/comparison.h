#pragma once
// What a table is compared with: the model's exact values on a grid of texture coordinates. Errors from that. For
// certify and lut/fit.
#include <cmath>

#include "lut/evaluate.h"

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

/// Four points a texel each way, at most 509 (a prime, so that a large table is not met at its texels); for cell
/// averages, bins half a texel wide on one row less than the table has, which sweeps the rows' offsets; one point less
/// than a row has texels where each costs a quadrature over the sphere.
ComparisonGrid grid_for(const TableLayout& table, const Channel& channel, int size);

/// The channel's exact values: at the grid's points, or, for cell averages, their means over the azimuths of its bins,
/// without bins that filter a texel on a caustic.
Result<ExactValues> exact_values(const Source& source, const Channel& channel, const Table& table,
                                 const ComparisonGrid& grid);

/// Whether any texel that filters into texture coordinates [u_begin, u_end] x v lies on a caustic.
bool touches_singular(const Table& table, double u_begin, double u_end, double v);
/// The filtered table at a point of the grid or, for cell averages, its mean over the azimuths of a bin.
double filtered_value(const Table& table, int channel, const ComparisonGrid& grid, std::size_t i);
/// Product of the angles (radians) that each bin of the grid covers: 0 where the axis is clamped.
std::vector<double> angle_weights(const TableLayout& table, int size, const ComparisonGrid& grid);

/// What is compared: absolute differences, exact values, and weights by angle.
struct Comparison {
  std::vector<double> error, signal, weight;
  void add(double difference, double exact, double angle) {
    error.push_back(std::abs(difference));
    signal.push_back(exact);
    weight.push_back(angle);
  }
};
/// `all`: how many there are with those left out.
ChannelError summarise(std::string_view name, const Comparison& comparison, std::size_t all);

/// `certify` without the mip levels.
Result<void> certify_without_levels(TableSet& set, const Format& format, Progress& progress);

/// Half as many texels each way (at least 1), each the mean of those it replaces, rounded to the format; and what each
/// such level costs: bilinear samples of it against the exact values' mean over one of its texels around the sample.
/// `exact`: on the channel's grid, for every channel.
void add_levels(Table& table, const Format& format, std::span<const ExactValues> exact);

/// Errors of S, sampled as a shader does: the layout's assumption and its stored tables. 16384 pairs of
/// directions evenly over the sphere; those that filter a texel on a caustic are left out.
Result<void> certify_scattering(const Source& source, TableSet& set);

/// What a layout's assumption alone costs S: rms over rms at a few hundred of these pairs of directions, before any
/// texel. A model whose kernel takes long is asked at fewer.
Result<double> assumption_error(const Source& source, const Layout& layout);

}  // namespace cuticle::lut
