#pragma once
// What passes take on one device, measured once and stored: from it a plan says what each would take here.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace cuticle::plan {

/// Milliseconds: fixed + per_pixel * pixels + per_unit * units, none below 0.
struct PassTime {
  double fixed = 0, per_pixel = 0, per_unit = 0;
};
struct CostTable {
  std::string device, driver, made;  ///< `made`: date and seconds that it took
  std::map<std::string, PassTime, std::less<>> passes;
  /// What a frame takes at most, over what is expected, with 95 %: from frames of scenes whose times are not in
  /// `passes`.
  double most_over_expected = 1;
};
/// What one more value of the kind stays below with 95 %: mean + t s sqrt(1 + 1 / n), of at least two; of fewer
/// endless.
double upper_bound(std::span<const double> values);
/// With 95 % below, of a ratio of which these were measured: exp(mean + t s sqrt(1 + 1 / n)) of the logarithms; of
/// fewer than two, the largest, and 1 at least.
double most_of(std::span<const double> ratios);

/// What a pass's time grows with beside pixels: control vertices times substeps of what simulates; segments times
/// lights of a shadow method; else drawn vertices.
double units_of(const registry::Entry& entry, const registry::FrameShape& shape);
double pixels_of(const scene::Scene& scene);
/// Empty where the table has nothing of the pass.
std::optional<double> predicted_ms(const CostTable& table, const registry::Entry& entry,
                                   const registry::FrameShape& shape, double pixels);

/// One measurement, and the coefficients of least squares with none below 0. Of fewer than three those that they
/// determine: per_unit first.
struct TimedPass {
  double pixels = 0, units = 0, ms = 0;
};
PassTime fit_time(std::span<const TimedPass> measured);

/// Where the table of a device is kept: below CUTICLE_CACHE, else XDG_CACHE_HOME/cuticle, else ~/.cache/cuticle.
std::string cost_table_path(std::string_view device, std::string_view driver);
/// Errors: bad_input where there is no such file or it is none.
Result<CostTable> read_cost_table(const std::string& path);
Result<void> write_cost_table(const std::string& path, const CostTable& table);

}  // namespace cuticle::plan
