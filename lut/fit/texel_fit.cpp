#include "lut/fit/texel_fit.h"

#include <algorithm>
#include <chrono>

#include "lut/fit/detail/texel_problem.h"

namespace cuticle::lut {
namespace {

using Clock = std::chrono::steady_clock;

/// Five points a texel each way, among which are texel centres; or the bins of `certify` on three rows a texel.
ComparisonGrid fitting_grid(const Channel& channel, int size) {
  return channel.texel == Texel::cell_average ? ComparisonGrid{2 * size, 3 * size} : ComparisonGrid{5 * size, 5 * size};
}

bool can_be_fitted(const Table& table, const Channel& channel) {
  return table.image.height > 1 && channel.source != ChannelSource::solver;
}

std::vector<double> values_of(const Table& table, int channel) {
  std::vector<double> values;
  for (std::size_t i = std::size_t(channel); i < table.image.pixels.size(); i += table.scale.size())
    values.push_back(double(table.image.pixels[i]) * table.scale[std::size_t(channel)]);
  return values;
}

void put_values(Table& table, int channel, const std::vector<double>& values) {
  std::size_t next = std::size_t(channel);
  for (double value : values) {
    table.image.pixels[next] = float(value / table.scale[std::size_t(channel)]);
    next += table.scale.size();
  }
}

/// The least-squares texels in the format's numbers, put into a set that holds samples in the format already.
Result<void> fit_channel(const TexelProblem& problem, TableSet& set, Table& table, int channel, const Format& format) {
  const std::size_t c = std::size_t(channel);
  const std::vector<double> samples = values_of(table, channel);
  put_values(table, channel, least_squares(problem, samples));
  CUTICLE_TRY(store_as(set, format));
  std::vector<double> texels = values_of(table, channel), own = samples;
  const double largest = *std::max_element(texels.begin(), texels.end()) / table.scale[c];
  round_with_neighbours(problem, format.round, table.scale[c], largest, texels);
  for (double& sample : own) sample = format.round(std::min(sample / table.scale[c], largest)) * table.scale[c];
  const bool held = keep_below(problem, own, largest_error(problem, samples), texels);
  put_values(table, channel, held ? texels : samples);
  return held ? Result<void>() : store_as(set, format);
}

Result<void> fit_table(const Source& source, TableSet& set, Table& table, const Format& format) {
  const Channel* evaluated = nullptr;
  ExactValues exact;
  for (int c = 0; c < int(table.layout->channels.size()); ++c) {
    const Channel& channel = table.layout->channels[std::size_t(c)];
    if (!can_be_fitted(table, channel)) continue;
    const ComparisonGrid grid = fitting_grid(channel, table.image.width);
    if (!evaluated || !same_lobes(*evaluated, channel)) {
      CUTICLE_ASSIGN(exact, exact_values(source, channel, table, grid));
      evaluated = &channel;
    }
    CUTICLE_TRY(fit_channel(make_problem(table, c, grid, exact), set, table, c, format));
  }
  return {};
}

/// Channels whose certified maximum the fit would raise get their samples back.
std::vector<ChannelFit> choose(const TableSet& unfitted, TableSet& fitted) {
  std::vector<ChannelFit> channels;
  for (std::size_t t = 0; t < fitted.tables.size(); ++t) {
    const Table& before = unfitted.tables[t];
    Table& after = fitted.tables[t];
    for (std::size_t c = 0; c < after.errors.size(); ++c) {
      ChannelFit fit{after.errors[c].channel, before.errors[c], after.errors[c]};
      fit.kept = fit.fitted.maximum <= fit.unfitted.maximum;
      if (!fit.kept) {
        after.scale[c] = before.scale[c];
        put_values(after, int(c), values_of(before, int(c)));
        fit.fitted = before.errors[c];
      }
      channels.push_back(fit);
    }
  }
  return channels;
}

}  // namespace

Result<TexelFit> fit_texels(const TableSet& baked, const Format& format, Progress& progress) {
  TableSet unfitted = baked;
  CUTICLE_TRY(certify(unfitted, format, progress));
  TexelFit fit{unfitted, {}, 0};
  fit.set.fitted = true;
  const auto start = Clock::now();
  const Source source = cpu_source(*baked.model, baked.values);
  for (std::size_t i = 0; i < fit.set.tables.size(); ++i) {
    progress.update("fit", i, fit.set.tables.size());
    CUTICLE_TRY(fit_table(source, fit.set, fit.set.tables[i], format));
  }
  fit.fit_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  CUTICLE_TRY(certify(fit.set, format, progress));
  fit.channels = choose(unfitted, fit.set);
  const bool all = std::ranges::all_of(fit.channels, &ChannelFit::kept);
  if (!all) CUTICLE_TRY(certify(fit.set, format, progress));
  return fit;
}

}  // namespace cuticle::lut
