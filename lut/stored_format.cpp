#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lut/format.h"
#include "lut/table_set.h"

namespace cuticle::lut {
namespace {

/// The scale that lets the format hold values up to `peak`.
double format_scale(const Format& format, double peak) {
  if (format.scaled_to_peak) return peak > 0 ? peak / format.largest : 1;
  return peak > format.largest ? peak / format.largest : 1;
}

Result<double> channel_peak(const Table& table, int channel) {
  double peak = 0;
  const std::size_t stride = table.scale.size();
  for (std::size_t i = channel; i < table.image.pixels.size(); i += stride) {
    const double value = double(table.image.pixels[i]) * table.scale[channel];
    if (!std::isfinite(value) || value < 0)
      return internal_error(fmt::format("{}: channel {} holds {}, tables hold finite values from 0 up",
                                        table.layout->name, table.layout->channels[channel].name, value));
    peak = std::max(peak, value);
  }
  return peak;
}

Result<void> store_channel(Table& table, int channel, const Format& format) {
  CUTICLE_ASSIGN(const double peak, channel_peak(table, channel));
  const double old_scale = table.scale[channel], scale = format_scale(format, peak);
  for (std::size_t i = channel; i < table.image.pixels.size(); i += table.scale.size())
    table.image.pixels[i] = float(format.round(double(table.image.pixels[i]) * old_scale / scale));
  table.scale[channel] = scale;
  return {};
}

}  // namespace

Result<void> store_as(TableSet& set, const Format& format) {
  for (Table& table : set.tables)
    for (int c = 0; c < int(table.scale.size()); ++c) CUTICLE_TRY(store_channel(table, c, format));
  return {};
}

namespace {

/// From the first texel's centre, in texels; NaN becomes the last texel, since fmin leaves it out.
double texels_along(double coordinate, int texels) {
  return std::fmax(0.0, std::fmin(coordinate * texels - 0.5, texels - 1.0));
}

}  // namespace

double sample(const Image& image, int channel, double u, double v) {
  const int width = image.width, height = image.height;
  const double x = texels_along(u, width), y = texels_along(v, height);
  const int x0 = int(x), y0 = int(y), x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
  const auto row = [&](int j) {
    const double left = double(image.at(x0, j, channel));
    return left + (x - x0) * (double(image.at(x1, j, channel)) - left);
  };
  const double top = row(y0);
  return top + (y - y0) * (row(y1) - top);
}

double sample(const Table& table, int channel, double u, double v) {
  return sample(table.image, channel, u, v) * table.scale[channel];
}

}  // namespace cuticle::lut
