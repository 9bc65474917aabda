#include "lut/check/readings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lut/table_set.h"

namespace cuticle::lut::check {
namespace {

constexpr double k_farthest = 1e6;
constexpr double k_least_tolerance = 1e-12;  ///< of a channel that is 0 everywhere

double distance(double found, double wanted, double tolerance) {
  const double ratio = std::abs(found - wanted) / std::max(tolerance, k_least_tolerance);
  return std::isfinite(ratio) ? std::min(ratio, k_farthest) : k_farthest;
}

}  // namespace

Reading reading_of(const Image& image) {
  return [&image](int channel, double u, double v) { return sample(image, channel, u, v); };
}

Misfit misfit_of(const ManifestTable& table, const Reading& reading) {
  Misfit misfit;
  const double count = double(table.probes.size() * table.channels.size());
  for (std::size_t p = 0; p < table.probes.size(); ++p)
    for (std::size_t c = 0; c < table.channels.size(); ++c) {
      const Probe& probe = table.probes[p];
      const double found = reading(int(c), probe.u, probe.v) * table.channels[c].scale;
      const double far = distance(found, probe.values[c], table.channels[c].tolerance);
      misfit.typical += std::log1p(far) / count;
      if (far < misfit.largest) continue;
      misfit.largest = far;
      misfit.worst = fmt::format("probe {}, channel {}: {:.6g}, wanted {:.6g}", p + 1, table.channels[c].name, found,
                                 probe.values[c]);
    }
  return misfit;
}

}  // namespace cuticle::lut::check
