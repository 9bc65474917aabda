#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <boost/math/quadrature/gauss.hpp>

#include <cuticle/lut/cell_average.h>
#include <cuticle/lut/comparison.h>

namespace cuticle::lut {
namespace {

constexpr int k_most_points = 509;  ///< per axis; a prime, so that a large table is not met at its texels

/// Four points a texel each way, or bins half a texel wide on one row less than the table has, which sweeps the rows'
/// offsets.
ComparisonGrid grid_for(const Channel& channel, int size) {
  if (channel.texel == Texel::point) return {std::min(4 * size, k_most_points), std::min(4 * size, k_most_points)};
  return {2 * size, std::min(size - 1, k_most_points)};
}

Result<ExactValues> exact_points(const Source& source, const Channel& channel, const TableLayout& layout, int size,
                                 const ComparisonGrid& grid) {
  std::vector<bsdf::Point> points;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      points.push_back(
          make_point(layout, axis_value(layout.u, size, grid.middle(x)), axis_value(layout.v, size, grid.row(y))));
  CUTICLE_ASSIGN(std::vector<glm::dvec3> values, channel_values(source, channel, points));
  return ExactValues{std::move(values), {}};
}

/// Whether any texel that filters into the bin is singular.
bool touches_singular(const Table& table, double u_begin, double u_end, double v) {
  const int size = table.image.width;
  const auto texel = [size](double coordinate) {
    return std::clamp(int(std::floor(coordinate * size - 0.5)), 0, size - 1);
  };
  for (int y = texel(v); y <= std::min(texel(v) + 1, size - 1); ++y)
    for (int x = texel(u_begin); x <= std::min(texel(u_end) + 1, size - 1); ++x)
      if (table.singular[std::size_t(y) * size + x]) return true;
  return false;
}

/// Bins that lie beyond the outermost texel centres of a corner-aligned axis have no width; they are left out too.
Result<ExactValues> exact_bins(const Source& source, const Channel& channel, const Table& table,
                               const ComparisonGrid& grid) {
  const int size = table.image.width;
  ExactValues exact{{}, std::vector<std::uint8_t>(grid.size(), 0)};
  std::vector<PhiInterval> bins;
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const double begin = grid.begin(x), end = grid.begin(x + 1), v = grid.row(y);
      PhiInterval bin = phi_interval(*table.layout, size, begin, end, v);
      exact.left_out[bins.size()] = bin.end - bin.begin < 1e-9 || touches_singular(table, begin, end, v);
      if (exact.left_out[bins.size()]) bin = {0, 0, 1e-3};
      bins.push_back(bin);
    }
  CUTICLE_ASSIGN(PhiAverages averages, average_over_phi(source, channel, bins));
  exact.values = std::move(averages.values);
  for (std::size_t i = 0; i < bins.size(); ++i) exact.left_out[i] |= averages.singular[i];
  return exact;
}

/// The filtered table's mean over the azimuths of a bin: 3-point Gauss-Legendre (the table is piecewise linear in cos
/// phi).
double table_bin_mean(const Table& table, int channel, double u_begin, double u_end, double v) {
  using Rule = boost::math::quadrature::gauss<double, 3>;
  const AxisMap map = axis_map(table.layout->u, table.image.width);
  const PhiInterval bin = phi_interval(*table.layout, table.image.width, u_begin, u_end, v);
  const double middle = (bin.begin + bin.end) / 2, half = (bin.end - bin.begin) / 2;
  const auto at = [&](double node) {
    return sample(table, channel, std::cos(middle + node * half) * map.scale + map.bias, v);
  };
  return (Rule::weights()[0] * at(0) + Rule::weights()[1] * (at(Rule::abscissa()[1]) + at(-Rule::abscissa()[1]))) / 2;
}

ChannelError summarise(const Channel& channel, std::vector<double>& errors, const std::vector<double>& signal,
                       std::size_t all) {
  ChannelError result;
  result.channel = channel.name;
  result.excluded = 1 - double(errors.size()) / double(all);
  if (errors.empty()) return result;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    result.rms += errors[i] * errors[i] / double(errors.size());
    result.signal_rms += signal[i] * signal[i] / double(errors.size());
    result.peak = std::max(result.peak, std::abs(signal[i]));
  }
  result.rms = std::sqrt(result.rms);
  result.signal_rms = std::sqrt(result.signal_rms);
  std::sort(errors.begin(), errors.end());
  result.maximum = errors.back();
  result.percentile_99 = errors[std::size_t(0.99 * double(errors.size() - 1))];
  return result;
}

ChannelError compare(const Table& table, int c, const ComparisonGrid& grid, const ExactValues& exact) {
  const Channel& channel = table.layout->channels[c];
  std::vector<double> difference(grid.size());
  tbb::parallel_for(std::size_t(0), grid.size(), [&](std::size_t i) {
    if (exact.left_out.empty() || !exact.left_out[i])
      difference[i] = std::abs(filtered_value(table, c, grid, i) - exact.values[i][channel.component]);
  });
  std::vector<double> errors, signal;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (!exact.left_out.empty() && exact.left_out[i]) continue;
    errors.push_back(difference[i]);
    signal.push_back(exact.values[i][channel.component]);
  }
  return summarise(channel, errors, signal, grid.size());
}

}  // namespace

double filtered_value(const Table& table, int channel, const ComparisonGrid& grid, std::size_t i) {
  const int x = int(i % grid.columns), y = int(i / grid.columns);
  if (table.layout->channels[channel].texel == Texel::point) return sample(table, channel, grid.middle(x), grid.row(y));
  return table_bin_mean(table, channel, grid.begin(x), grid.begin(x + 1), grid.row(y));
}

Result<ExactValues> exact_values(const Source& source, const Channel& channel, const Table& table,
                                 const ComparisonGrid& grid) {
  if (channel.texel == Texel::cell_average) return exact_bins(source, channel, table, grid);
  return exact_points(source, channel, *table.layout, table.image.width, grid);
}

namespace {

Result<void> certify_table(const Source& source, Table& table) {
  table.errors.clear();
  const Channel* evaluated = nullptr;
  ExactValues exact;
  for (int c = 0; c < int(table.layout->channels.size()); ++c) {
    const Channel& channel = table.layout->channels[c];
    const ComparisonGrid grid = grid_for(channel, table.image.width);
    if (!evaluated || !same_lobes(*evaluated, channel)) {
      CUTICLE_ASSIGN(exact, exact_values(source, channel, table, grid));
      evaluated = &channel;
    }
    table.errors.push_back(compare(table, c, grid, exact));
  }
  return {};
}

}  // namespace

Result<void> certify(TableSet& set, const Format& format, Progress& progress) {
  CUTICLE_TRY(store_as(set, format));
  const Source source = cpu_source(*set.model, set.values);
  for (std::size_t i = 0; i < set.tables.size(); ++i) {
    progress.update("certify", i, set.tables.size());
    CUTICLE_TRY(certify_table(source, set.tables[i]));
  }
  progress.update("certify", set.tables.size(), set.tables.size());
  return {};
}

}  // namespace cuticle::lut
