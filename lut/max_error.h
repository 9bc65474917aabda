#pragma once
// The smallest tables that reach a wanted error, among axes, sizes and formats.
#include "lut/format.h"
#include "lut/table_set.h"

namespace cuticle::lut {

/// Which error of a channel is meant: the rms error over the rms value; the largest, or the 99th percentile, over the
/// largest value. Rms and percentile are those with every direction alike (`in_angle`).
enum class ErrorMeasure { rms, maximum, percentile_99 };
/// "rms", "max", "p99". Error: usage, listing them.
Result<ErrorMeasure> find_error_measure(std::string_view name);
double relative_error(const ChannelError& error, ErrorMeasure measure);

/// The worst channel of a certified set; S read from the tables counts as one.
struct WorstChannel {
  std::string name;
  double error = 0;
};
WorstChannel worst_channel(const TableSet& set, ErrorMeasure measure);

/// Bytes of the tables as textures: texels times channels times the format's bytes, without mip levels. A table of
/// three channels counts four, because devices filter no texture of three.
std::size_t texture_bytes(const Layout& layout, int size, const Format& format);

/// What may be chosen from; sizes rising, formats with the finest first.
struct TableChoices {
  std::vector<const Layout*> layouts;
  std::vector<int> sizes;
  std::vector<const Format*> formats;
};
struct TableChoice {
  const Layout* layout = nullptr;
  int size = 0;
  const Format* format = nullptr;
  std::size_t bytes = 0;
  WorstChannel worst;
};
struct ErrorSearch {
  bool reached = false;
  TableChoice best;                  ///< reached: the fewest bytes; else the least error of those tried
  std::vector<TableChoice> tried;    ///< in the order in which they were measured
  std::vector<std::string> stopped;  ///< layouts whose larger sizes were left out, in words
};

/// Bakes on the CPU and certifies, size by size, until one reaches the error. Coarser formats are tried where the
/// finest reaches it. A layout is given up from 256 texels on when, going on to shrink as at the last doubling, its
/// worst channel would not reach the error at the largest size. Errors: as `bake`.
Result<ErrorSearch> search_tables(const bsdf::Model& model, const registry::ParameterValues& values,
                                  const TableChoices& choices, double wanted, ErrorMeasure measure, Progress& progress);

}  // namespace cuticle::lut
