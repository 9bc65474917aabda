#include <algorithm>

#include <tbb/parallel_for.h>

#include "lut/comparison.h"

namespace cuticle::lut {
namespace {

ChannelError compare(const Table& table, int c, const ComparisonGrid& grid, const ExactValues& exact) {
  const Channel& channel = table.layout->channels[c];
  std::vector<double> difference(grid.size());
  tbb::parallel_for(std::size_t(0), grid.size(), [&](std::size_t i) {
    if (exact.left_out.empty() || !exact.left_out[i])
      difference[i] = filtered_value(table, c, grid, i) - exact.values[i][channel.component];
  });
  const std::vector<double> weight = angle_weights(*table.layout, table.image.width, grid);
  Comparison comparison;
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (exact.left_out.empty() || !exact.left_out[i])
      comparison.add(difference[i], exact.values[i][channel.component], weight[i]);
  return summarise(channel.name, comparison, grid.size());
}

/// The exact values of every channel; none where the channels are solved for.
Result<std::vector<ExactValues>> certify_table(const Source& source, Table& table) {
  table.errors.clear();
  std::vector<ExactValues> exact;
  for (int c = 0; c < int(table.layout->channels.size()); ++c) {
    const Channel& channel = table.layout->channels[c];
    if (channel.source == ChannelSource::solver) return exact;
    const ComparisonGrid grid = grid_for(*table.layout, channel, table.image.width);
    if (c > 0 && same_lobes(table.layout->channels[c - 1], channel)) {
      exact.push_back(exact.back());
    } else {
      CUTICLE_ASSIGN(exact.emplace_back(), exact_values(source, channel, table, grid));
    }
    table.errors.push_back(compare(table, c, grid, exact.back()));
  }
  return exact;
}

/// `finish` sees every table with the exact values of its channels.
template <class Finish>
Result<void> certify_then(TableSet& set, const Format& format, Progress& progress, const Finish& finish) {
  CUTICLE_TRY(store_as(set, format));
  const Source source = cpu_source(*set.model, set.values);
  for (std::size_t i = 0; i < set.tables.size(); ++i) {
    progress.update("certify", i, set.tables.size());
    CUTICLE_ASSIGN(const std::vector<ExactValues> exact, certify_table(source, set.tables[i]));
    finish(set.tables[i], exact);
  }
  CUTICLE_TRY(certify_scattering(source, set));
  progress.update("certify", set.tables.size(), set.tables.size());
  return {};
}

}  // namespace

Result<void> certify(TableSet& set, const Format& format, Progress& progress) {
  return certify_then(set, format, progress,
                      [&](Table& table, const std::vector<ExactValues>& exact) { add_levels(table, format, exact); });
}

Result<void> certify_without_levels(TableSet& set, const Format& format, Progress& progress) {
  return certify_then(set, format, progress, [](Table&, const std::vector<ExactValues>&) {});
}

}  // namespace cuticle::lut
