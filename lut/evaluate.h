#pragma once
// Where baking takes the model's values from: the CPU or a device. For lut and viz.
#include <functional>
#include <memory>

#include "lut/table_set.h"

namespace cuticle::lut {

/// Evaluates one request of the model that is baked.
using Evaluate = std::function<Result<void>(const bsdf::Request&, std::span<glm::dvec3>)>;

/// The average fibre of dual scattering seen from theta_o (radians); what was asked before is remembered.
using AverageFibre = std::function<Result<bsdf::DualScatteringRow>(double theta_o)>;
AverageFibre average_fibre(const bsdf::Model& model, const registry::ParameterValues& values);

/// The model's own means of N over azimuths (bsdf::azimuthal_means); false where it has none.
using AzimuthalMeans =
    std::function<Result<bool>(int lobe, std::span<const bsdf::AzimuthInterval>, std::span<bsdf::AzimuthMean>)>;

/// A source of values. Float azimuths cannot resolve a caustic, so what is left of it after eight halvings of a cell is
/// evaluated in double.
struct Source {
  const bsdf::Model* model = nullptr;
  Evaluate evaluate;
  Evaluate evaluate_in_double;
  AverageFibre average = {};            ///< for the channels that need it
  AzimuthalMeans azimuthal_means = {};  ///< empty: none
};
/// The CPU in double.
Source cpu_source(const bsdf::Model& model, const registry::ParameterValues& values);

/// The model's point for two axis values.
bsdf::Point make_point(const TableLayout& table, double u_value, double v_value);
/// Texture coordinate at which a shader reads the axis for a point.
double axis_coordinate(const Axis& axis, int size, const bsdf::Point& point);
/// The angle (radians) behind a texture coordinate.
double axis_angle(const Axis& axis, int size, double coordinate);
/// Whether two channels differ in the colour component only, so that one evaluation serves both.
bool same_lobes(const Channel& a, const Channel& b);
/// Lobes of a channel ("TT+TRT" names two), as indices. Error: usage when the model lacks one.
Result<std::vector<int>> find_lobes(const bsdf::Model& model, std::string_view names);
/// Value of a channel's quantity, summed over its lobes, at many points.
Result<std::vector<glm::dvec3>> evaluate_points(const bsdf::Model& model, const Evaluate& evaluate,
                                                const Channel& channel, std::span<const bsdf::Point> points);

/// Exact values of a channel of points, whatever their source but the solver.
Result<std::vector<glm::dvec3>> channel_values(const Source& source, const Channel& channel,
                                               std::span<const bsdf::Point> points);

/// Error: usage for a size outside 16 .. 1024.
Result<void> check_size(int size);
/// A table of one size before it is baked: all 0, scales of 1.
Table empty_table(const TableLayout& layout, int size);
/// One table; solved channels stay 0.
Result<Table> bake_table(const Source& source, const TableLayout& layout, int size);
/// `bake` from any source; bake_ms and baked_on are left to the caller.
Result<TableSet> bake_from(const Source& source, const registry::ParameterValues& values, const Layout& layout,
                           int size, Progress& progress);

}  // namespace cuticle::lut
