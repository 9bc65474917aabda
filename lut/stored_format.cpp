#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <cuticle/lut/table_set.h>

namespace cuticle::lut {
namespace {

constexpr double k_largest_half = 65504;

double round_to(Format format, double stored) {
  if (format == Format::exr) return round_to_half(float(stored));
  const double steps = format == Format::png8 ? 255 : 65535;
  return std::round(stored * steps) / steps;
}

/// The scale that lets the format hold values up to `peak`.
double format_scale(Format format, double peak) {
  if (format == Format::exr) return peak > k_largest_half ? peak / k_largest_half : 1;
  return peak > 0 ? peak : 1;
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

Result<void> store_channel(Table& table, int channel, Format format) {
  CUTICLE_ASSIGN(const double peak, channel_peak(table, channel));
  const double old_scale = table.scale[channel], scale = format_scale(format, peak);
  for (std::size_t i = channel; i < table.image.pixels.size(); i += table.scale.size())
    table.image.pixels[i] = float(round_to(format, double(table.image.pixels[i]) * old_scale / scale));
  table.scale[channel] = scale;
  return {};
}

}  // namespace

Result<void> store_as(TableSet& set, Format format) {
  for (Table& table : set.tables)
    for (int c = 0; c < int(table.scale.size()); ++c) CUTICLE_TRY(store_channel(table, c, format));
  return {};
}

double sample(const Table& table, int channel, double u, double v) {
  const int width = table.image.width, height = table.image.height;
  const double x = std::clamp(u * width - 0.5, 0.0, width - 1.0), y = std::clamp(v * height - 0.5, 0.0, height - 1.0);
  const int x0 = std::min(int(x), width - 2), y0 = std::min(int(y), height - 2);
  const double fx = x - x0, fy = y - y0;
  const auto texel = [&](int i, int j) { return double(table.image.at(x0 + i, y0 + j, channel)); };
  const double top = texel(0, 0) + fx * (texel(1, 0) - texel(0, 0)),
               bottom = texel(0, 1) + fx * (texel(1, 1) - texel(0, 1));
  return (top + fy * (bottom - top)) * table.scale[channel];
}

}  // namespace cuticle::lut
