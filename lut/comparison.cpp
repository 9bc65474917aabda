#include "lut/comparison.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <boost/math/quadrature/gauss.hpp>

#include "lut/cell_average.h"

namespace cuticle::lut {
namespace {

constexpr int k_max_points = 509;  ///< per axis; a prime, so that a large table is not met at its texels

Result<ExactValues> exact_points(const Source& source, const Channel& channel, const TableLayout& layout, int size,
                                 const ComparisonGrid& grid) {
  std::vector<bsdf::Point> points;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      points.push_back(make_point(layout, axis_value(layout.u, size, grid.middle(x)),
                                  axis_value(layout.v, size, grid.row(y)), size, source.caustic_index));
  CUTICLE_ASSIGN(std::vector<glm::dvec3> values, held_values(source, layout, channel, points));
  return ExactValues{std::move(values), {}};
}

bool has_width(const PhiInterval& bin) { return bin.end - bin.begin > 1e-9; }

/// Bins that lie beyond the outermost texel centres of a corner-aligned axis have no width; they are left out too, and
/// hold the mean of the nearest bin that has one.
Result<ExactValues> exact_bins(const Source& source, const Channel& channel, const Table& table,
                               const ComparisonGrid& grid) {
  const int size = table.image.width;
  ExactValues exact{{}, std::vector<std::uint8_t>(grid.size(), 0)};
  std::vector<PhiInterval> bins;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const double begin = grid.begin(x), end = grid.begin(x + 1), v = grid.row(y);
      PhiInterval bin = phi_interval(*table.layout, size, begin, end, v);
      exact.left_out[bins.size()] = !has_width(bin) || touches_singular(table, begin, end, v);
      const int inward = x < grid.columns / 2 ? 1 : -1;
      if (!has_width(bin))
        bin = phi_interval(*table.layout, size, grid.begin(x + inward), grid.begin(x + inward + 1), v);
      bins.push_back(bin);
    }
  CUTICLE_ASSIGN(PhiAverages averages, average_over_phi(source, channel, bins));
  exact.values = std::move(averages.values);
  for (std::size_t i = 0; i < bins.size(); ++i) exact.left_out[i] |= averages.singular[i];
  return exact;
}

/// The filtered table's mean over the azimuths of a bin: 3-point Gauss-Legendre (the table is piecewise linear along
/// u).
double table_bin_mean(const Table& table, int channel, double u_begin, double u_end, double v) {
  using Rule = boost::math::quadrature::gauss<double, 3>;
  const Axis& u = table.layout->u;
  const PhiInterval bin = phi_interval(*table.layout, table.image.width, u_begin, u_end, v);
  const double middle = (bin.begin + bin.end) / 2, half = (bin.end - bin.begin) / 2;
  const auto at = [&](double node) {
    return sample(table, channel, axis_coordinate(u, table.image.width, {.phi = middle + node * half}), v);
  };
  return (Rule::weights()[0] * at(0) + Rule::weights()[1] * (at(Rule::abscissa()[1]) + at(-Rule::abscissa()[1]))) / 2;
}

/// Radians that each of `count` equal parts of the texture coordinate covers; 1 for an axis without an angle.
std::vector<double> widths(const Axis& axis, int size, int count) {
  std::vector<double> result(std::size_t(count), 1.0);
  if (axis.quantity == AxisQuantity::none) return result;
  for (int k = 0; k < count; ++k)
    result[std::size_t(k)] =
        std::abs(axis_angle(axis, size, (k + 1.0) / count) - axis_angle(axis, size, double(k) / count));
  return result;
}

/// The smallest error that 99 % of the weight does not exceed; by_size: indices by rising error.
double percentile_99(const std::vector<std::size_t>& by_size, const std::vector<double>& error,
                     const std::vector<double>& weight, double total) {
  double sum = 0;
  for (std::size_t i : by_size)
    if ((sum += weight[i]) >= 0.99 * total) return error[i];
  return 0;
}

double root(double sum, double weight) { return weight > 0 ? std::sqrt(sum / weight) : 0; }

}  // namespace

bool touches_singular(const Table& table, double u_begin, double u_end, double v) {
  const glm::ivec2 size(table.image.width, table.image.height);
  const auto texel = [](double coordinate, int count) {
    return std::clamp(int(std::floor(coordinate * count - 0.5)), 0, count - 1);
  };
  const int first = texel(u_begin, size.x), last = std::min(texel(u_end, size.x) + 1, size.x - 1);
  for (int y = texel(v, size.y); y <= std::min(texel(v, size.y) + 1, size.y - 1); ++y)
    for (int x = first; x <= last; ++x)
      if (table.singular[std::size_t(y) * size.x + x]) return true;
  return false;
}

double filtered_value(const Table& table, int channel, const ComparisonGrid& grid, std::size_t i) {
  const int x = int(i % grid.columns), y = int(i / grid.columns);
  if (table.layout->channels[channel].texel != Texel::cell_average)
    return sample(table, channel, grid.middle(x), grid.row(y));
  return table_bin_mean(table, channel, grid.begin(x), grid.begin(x + 1), grid.row(y));
}

std::vector<double> angle_weights(const TableLayout& table, int size, const ComparisonGrid& grid) {
  const std::vector<double> u = widths(table.u, size, grid.columns), v = widths(table.v, size, grid.rows);
  std::vector<double> result;
  result.reserve(grid.size());
  for (double height : v)
    for (double width : u) result.push_back(width * height);
  return result;
}

ChannelError summarise(std::string_view name, const Comparison& comparison, std::size_t all) {
  const std::vector<double>&error = comparison.error, &signal = comparison.signal, &weight = comparison.weight;
  ChannelError result;
  result.channel = name;
  result.excluded = 1 - double(error.size()) / double(all);
  if (error.empty()) return result;
  double total = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    total += weight[i];
    result.rms += error[i] * error[i];
    result.signal_rms += signal[i] * signal[i];
    result.in_angle.rms += weight[i] * error[i] * error[i];
    result.in_angle.signal_rms += weight[i] * signal[i] * signal[i];
    result.peak = std::max(result.peak, std::abs(signal[i]));
  }
  result.rms = root(result.rms, double(error.size()));
  result.signal_rms = root(result.signal_rms, double(error.size()));
  result.in_angle.rms = root(result.in_angle.rms, total);
  result.in_angle.signal_rms = root(result.in_angle.signal_rms, total);
  std::vector<std::size_t> by_size(error.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t(0));
  std::sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) { return error[a] < error[b]; });
  result.maximum = error[by_size.back()];
  result.percentile_99 = error[by_size[std::size_t(0.99 * double(error.size() - 1))]];
  result.in_angle.percentile_99 = percentile_99(by_size, error, weight, total);
  return result;
}

ComparisonGrid grid_for(const TableLayout& table, const Channel& channel, int size) {
  if (channel.texel == Texel::cell_average) return {2 * size, std::min(size - 1, k_max_points)};
  const glm::ivec2 texels = table_size(table, size);
  if (channel.source == ChannelSource::average_fibre) return {texels.x - 1, std::max(1, texels.y - 1)};
  return {std::min(4 * texels.x, k_max_points), texels.y > 1 ? std::min(4 * texels.y, k_max_points) : 1};
}

Result<ExactValues> exact_values(const Source& source, const Channel& channel, const Table& table,
                                 const ComparisonGrid& grid) {
  if (channel.texel == Texel::cell_average) return exact_bins(source, channel, table, grid);
  return exact_points(source, channel, *table.layout, table.image.width, grid);
}

}  // namespace cuticle::lut
