#pragma once
// Scattering of real fibres as goniometers measured it, in our angles (docs/conventions.md).
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"

namespace cuticle::bsdf {

/// One direction: angles in radians, what was measured there, and its standard deviation (0: not known).
struct MeasuredDirection {
  double theta_i = 0, theta_o = 0, phi = 0;
  glm::dvec3 value{0};
  double sigma = 0;
};

/// A fibre's measured directions, in the order of the file.
struct MeasuredFibre {
  std::vector<MeasuredDirection> directions;
  bool one_number = true;      ///< grey: value.x alone; else r, g, b
  bool sigma_known = false;    ///< every direction has its sigma
  std::size_t unmeasured = 0;  ///< places that the file names without a value
};

/// `gantry`: the text that Yan et al. 2015 share (parse_gantry); `csv`; `slices`: a binary table (parse_slices).
enum class MeasuredFormat { gantry, csv, slices };
/// "gantry", "csv", "slices". Error: usage, listing them.
Result<MeasuredFormat> find_measured_format(std::string_view name);

/// What the gantry's angles are in ours: theta_i = 90 - theta, phi = phi - 90 degrees (the project's page: theta 40 ..
/// 80 is 50 .. 10, phi 70 .. 290 is -20 .. 200). The other arm stands still, at an inclination that files do not name.
struct Gantry {
  double theta_o =
      -0.52359877559829887;  ///< of the arm that stands still [rad]; -30 degrees mirrors the middle of 10 .. 50
};

/// Lines `phi theta value` in degrees of the gantry, `?` where nothing was measured; blank lines are skipped. `file`
/// names the text in errors. Error: bad_input with file and line, for a line of another form, a number that is not
/// finite, a theta outside 0 .. 180 or a phi outside -360 .. 720 degrees, and a file without a measured value.
Result<MeasuredFibre> parse_gantry(std::string_view text, std::string_view file, const Gantry& gantry);
/// The same directions as such a text; NaN becomes `?`. Angles read back to 1e-14 rad, values to the same bits.
std::string gantry_text(std::span<const MeasuredDirection> directions);

/// CSV with columns theta_i, theta_o, phi (degrees), value or r, g, b, and sigma (optional; above 0). Errors: those of
/// parse_points; bad_input for a missing column.
Result<MeasuredFibre> parse_measured_csv(std::string_view text, std::string_view file);

/// A table as MERL's are laid out: three little-endian 32-bit counts, then doubles, all of red, all of green, all of
/// blue, phi fastest; below 0: not measured. The counts are of theta_i and theta_o (cells of equal width over -90 .. 90
/// degrees) and phi (over 0 .. 180); a value stands for the middle of its cell. Error: bad_input with the byte's place,
/// for counts outside 1 .. 1440, a file of another length than they say, and a number that is not finite.
Result<MeasuredFibre> parse_slices(std::span<const std::byte> bytes, std::string_view file);

/// A file in one of the formats; by its name where none is given: .csv, .bin and .binary (slices), others are gantry.
Result<MeasuredFibre> read_measured(const std::string& path, std::string_view format, const Gantry& gantry);

}  // namespace cuticle::bsdf
