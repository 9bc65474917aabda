#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "lut/comparison.h"
#include "lut/format.h"

namespace cuticle::lut {
namespace {

Image halved(const Image& image, const Format& format) {
  Image half = make_image(std::max(1, image.width / 2), std::max(1, image.height / 2), image.channel_names);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < half.channels(); ++c) {
        const int x1 = std::min(2 * x + 1, image.width - 1), y1 = std::min(2 * y + 1, image.height - 1);
        const double sum = double(image.at(2 * x, 2 * y, c)) + double(image.at(x1, 2 * y, c)) +
                           double(image.at(2 * x, y1, c)) + double(image.at(x1, y1, c));
        half.at(x, y, c) = float(format.round(sum / 4));
      }
  return half;
}

/// The integral of a row of equal steps over [0, 1], from 0 to anywhere; beyond the ends it goes on with the end's
/// value.
class RunningSum {
 public:
  explicit RunningSum(const std::vector<double>& steps) : steps_(steps), sum_(steps.size() + 1, 0.0) {
    for (std::size_t i = 0; i < steps.size(); ++i) sum_[i + 1] = sum_[i] + steps[i] / double(steps.size());
  }
  double mean(double middle, double width) const { return (to(middle + width / 2) - to(middle - width / 2)) / width; }

 private:
  double to(double x) const {
    if (x <= 0) return x * steps_.front();
    if (x >= 1) return sum_.back() + (x - 1) * steps_.back();
    const double place = x * double(steps_.size());
    const std::size_t step = std::min(std::size_t(place), steps_.size() - 1);
    return sum_[step] + (place - double(step)) * steps_[step] / double(steps_.size());
  }
  const std::vector<double>& steps_;
  std::vector<double> sum_;
};

/// The mean of the exact values over a rectangle around each point of a coarser grid.
std::vector<double> footprint_means(const ExactValues& exact, int component, const ComparisonGrid& fine,
                                    const ComparisonGrid& coarse, double width, double height) {
  std::vector<std::vector<double>> columns(std::size_t(coarse.columns), std::vector<double>(std::size_t(fine.rows)));
  tbb::parallel_for(0, fine.rows, [&](int y) {
    std::vector<double> row;
    for (int x = 0; x < fine.columns; ++x) row.push_back(exact.values[std::size_t(y) * fine.columns + x][component]);
    const RunningSum sum(row);
    for (int x = 0; x < coarse.columns; ++x) columns[x][y] = sum.mean(coarse.middle(x), width);
  });
  std::vector<double> means(coarse.size());
  tbb::parallel_for(0, coarse.columns, [&](int x) {
    const RunningSum sum(columns[x]);
    for (int y = 0; y < coarse.rows; ++y) means[std::size_t(y) * coarse.columns + x] = sum.mean(coarse.row(y), height);
  });
  return means;
}

ChannelError level_error(const Table& table, const MipLevel& level, int c, const ExactValues& exact) {
  const Channel& channel = table.layout->channels[c];
  const ComparisonGrid fine = grid_for(*table.layout, channel, table.image.width);
  const ComparisonGrid coarse{std::min(4 * level.image.width, fine.columns),
                              std::min(4 * level.image.height, fine.rows)};
  const std::vector<double> means =
      footprint_means(exact, channel.component, fine, coarse, 1.0 / level.image.width, 1.0 / level.image.height);
  const std::vector<double> weight = angle_weights(*table.layout, table.image.width, coarse);
  Comparison comparison;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const double u = coarse.middle(int(i % coarse.columns)), v = coarse.row(int(i / coarse.columns));
    comparison.add(sample(level.image, c, u, v) * table.scale[c] - means[i], means[i], weight[i]);
  }
  return summarise(channel.name, comparison, coarse.size());
}

}  // namespace

void add_levels(Table& table, const Format& format, std::span<const ExactValues> exact) {
  table.levels.clear();
  for (const Image* finer = &table.image; finer->width > 1 || finer->height > 1; finer = &table.levels.back().image) {
    MipLevel level{halved(*finer, format), {}};
    for (int c = 0; c < int(exact.size()); ++c) level.errors.push_back(level_error(table, level, c, exact[c]));
    table.levels.push_back(std::move(level));
  }
}

}  // namespace cuticle::lut
