#include "lut/max_error.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lut/comparison.h"

namespace cuticle::lut {
namespace {

constexpr std::string_view k_measures[] = {"rms", "max", "p99"};
constexpr int k_smallest_trend = 256;  ///< below, narrow lobes are not resolved and the error shrinks late

/// One layout at rising sizes.
struct Trend {
  const Layout* layout = nullptr;
  std::vector<WorstChannel> worst;  ///< in the finest format, size by size
  bool given_up = false;
};

class Search {
 public:
  Search(const bsdf::Model& model, const registry::ParameterValues& values, const TableChoices& choices, double wanted,
         ErrorMeasure measure, Progress& progress)
      : model_(model), values_(values), choices_(choices), wanted_(wanted), measure_(measure), progress_(progress) {}

  Result<ErrorSearch> run() {
    std::vector<Trend> trends;
    const Source source = cpu_source(model_, values_);
    for (const Layout* layout : choices_.layouts)
      if (check_bakeable(source, values_, *layout).ok()) trends.push_back({layout, {}, false});
    if (trends.empty()) CUTICLE_TRY(check_bakeable(source, values_, *choices_.layouts.front()));
    for (std::size_t i = 0; i < choices_.sizes.size() && !result_.reached; ++i)
      for (Trend& trend : trends)
        if (!trend.given_up) CUTICLE_TRY(try_size(trend, i));
    return std::move(result_);
  }

 private:
  Result<void> try_size(Trend& trend, std::size_t index) {
    const int size = choices_.sizes[index];
    CUTICLE_ASSIGN(const TableSet baked, bake(model_, values_, *trend.layout, size, progress_));
    CUTICLE_ASSIGN(trend.worst.emplace_back(), try_format(baked, *choices_.formats.front()));
    for (std::size_t f = 1; f < choices_.formats.size() && trend.worst.back().error <= wanted_; ++f) {
      CUTICLE_TRY(try_format(baked, *choices_.formats[f]));
    }
    give_up_if_hopeless(trend, index);
    return {};
  }
  Result<WorstChannel> try_format(TableSet set, const Format& format) {
    CUTICLE_TRY(certify_without_levels(set, format, progress_));
    const TableChoice choice{set.layout, set.size, &format, texture_bytes(*set.layout, set.size, format),
                             worst_channel(set, measure_)};
    result_.tried.push_back(choice);
    if (is_better(choice)) result_.best = choice;
    result_.reached = result_.reached || choice.worst.error <= wanted_;
    return choice.worst;
  }
  bool is_better(const TableChoice& choice) const {
    if (!result_.best.layout) return true;
    const bool reaches = choice.worst.error <= wanted_;
    if (reaches != result_.reached) return reaches;
    const TableChoice& best = result_.best;
    if (reaches && choice.bytes != best.bytes) return choice.bytes < best.bytes;
    return choice.worst.error < best.worst.error;
  }
  void give_up_if_hopeless(Trend& trend, std::size_t index) {
    const int size = choices_.sizes[index], largest = choices_.sizes.back();
    if (result_.reached || size < k_smallest_trend || trend.worst.size() < 2 || size == largest) return;
    const double before = trend.worst[trend.worst.size() - 2].error, now = trend.worst.back().error;
    const double doublings = std::log2(double(largest) / size);
    trend.given_up = now * std::pow(std::min(now / before, 1.0), doublings) > wanted_;
    if (trend.given_up)
      result_.stopped.push_back(fmt::format("{} beyond {}: {} went from {:.2e} to {:.2e} at the last doubling",
                                            trend.layout->entry.name, size, trend.worst.back().name, before, now));
  }

  const bsdf::Model& model_;
  const registry::ParameterValues& values_;
  const TableChoices& choices_;
  double wanted_;
  ErrorMeasure measure_;
  Progress& progress_;
  ErrorSearch result_;
};

}  // namespace

Result<ErrorMeasure> find_error_measure(std::string_view name) {
  for (int i = 0; i < 3; ++i)
    if (k_measures[i] == name) return ErrorMeasure(i);
  return usage_error(fmt::format("error kind: '{}' is not one of {}", name, fmt::join(k_measures, ", ")), "rms");
}

double relative_error(const ChannelError& error, ErrorMeasure measure) {
  if (measure == ErrorMeasure::rms) return relative_error(error.in_angle.rms, error.in_angle.signal_rms);
  return relative_error(measure == ErrorMeasure::maximum ? error.maximum : error.in_angle.percentile_99, error.peak);
}

WorstChannel worst_channel(const TableSet& set, ErrorMeasure measure) {
  WorstChannel worst;
  const auto see = [&](const ChannelError& each) {
    const double error = relative_error(each, measure);
    if (error >= worst.error) worst = {each.channel, error};
  };
  for (const Table& table : set.tables) std::for_each(table.errors.begin(), table.errors.end(), see);
  std::for_each(set.scattering.begin(), set.scattering.end(), see);
  return worst;
}

std::size_t texture_bytes(const Layout& layout, int size, const Format& format) {
  std::size_t numbers = 0;
  for (const TableLayout& table : layout.tables) {
    const glm::ivec2 texels = table_size(table, size);
    const std::size_t channels = table.channels.size() == 3 ? 4 : table.channels.size();
    numbers += std::size_t(texels.x) * texels.y * channels;
  }
  return numbers * std::size_t(format.bytes);
}

Result<ErrorSearch> search_tables(const bsdf::Model& model, const registry::ParameterValues& values,
                                  const TableChoices& choices, double wanted, ErrorMeasure measure,
                                  Progress& progress) {
  CUTICLE_EXPECT(!choices.layouts.empty() && !choices.sizes.empty() && !choices.formats.empty(),
                 "there is something to choose from");
  return Search(model, values, choices, wanted, measure, progress).run();
}

}  // namespace cuticle::lut
