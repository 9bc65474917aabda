#pragma once
// The points that `cuticle eval` evaluates at: a grid of the coordinates given as options, or a CSV file.
#include <array>
#include <string>
#include <vector>

#include "bsdf/model.h"
#include "core/points/points_file.h"

namespace cuticle::cli {

/// Columns of points in the order of bsdf::Point; angles in degrees.
constexpr std::array<PointColumn, bsdf::coordinate_count> eval_columns = {{{"theta_i", -90, 90, "deg"},
                                                                           {"theta_o", -90, 90, "deg"},
                                                                           {"theta_d", -90, 90, "deg"},
                                                                           {"phi", -1e6, 1e6, "deg"},
                                                                           {"h", -1, 1, "1"},
                                                                           {"phi_o", -1e6, 1e6, "deg"}}};

/// The option of a coordinate, "--theta-i".
std::string coordinate_flag(std::size_t coordinate);

/// What was given on the command line, and which coordinates must be given. One that no model has a use for is refused
/// where `refuse_unused`; phi_o, which only some cross-sections use, never is.
struct CoordinateRequest {
  std::array<std::string, bsdf::coordinate_count> grid;  ///< a number, a,b,c or from:to:count; empty: not given
  std::string points_file;
  std::array<bool, bsdf::coordinate_count> needed{};
  bool refuse_unused = true;
  std::string quantity;  ///< for messages
};

/// The table of points. Errors: usage, naming the option that is missing, unused or out of range; bad_input of the
/// file.
Result<PointsTable> read_coordinates(const CoordinateRequest& request);

/// Whether the angles look like radians: none, of at least one that is not 0, is beyond pi.
bool all_below_pi(const PointsTable& table);
/// The same points in radians; coordinates that were not given are 0.
std::vector<bsdf::Point> in_radians(const PointsTable& table);

}  // namespace cuticle::cli
