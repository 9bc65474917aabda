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
  double caustic_index = 0;             ///< bsdf::Model::caustic_index
  /// S of all lobes for solvers that ask for millions of points (scattering_at_many); empty: `evaluate`.
  Evaluate at_many = {};
  /// The same with far more work, by which what is made from `at_many` is measured; empty: `evaluate`. Points of one
  /// viewer in a row are cheap.
  Evaluate measured_by = {};
  const Evaluate& many() const { return at_many ? at_many : evaluate; }
};
/// For Source::at_many: a viewer's lights together where the model does that, by its batch where every point is an
/// integral, else in double. For Source::measured_by: empty where one viewer's lights are not made together.
Evaluate scattering_at_many(const bsdf::Model& model, const registry::ParameterValues& values);
Evaluate scattering_to_measure_by(const bsdf::Model& model, const registry::ParameterValues& values);
/// What a table of these values holds: no table has an axis for phi_o, so a flat fibre's is the mean over turns of its
/// cross-section: over 128 where texels hold the model's own means over azimuths, else over 16, of dual scattering
/// over 2. Test: lut_turns_test.
registry::ParameterValues table_values(const bsdf::Model& model, const registry::ParameterValues& values,
                                       const Layout& layout);

/// The CPU in double.
Source cpu_source(const bsdf::Model& model, const registry::ParameterValues& values);

/// The model's point for two axis values of a table; `caustic_index`: of an axis `from_caustic`.
bsdf::Point make_point(const TableLayout& table, double u_value, double v_value, int size = 0,
                       double caustic_index = 0);
/// The point whose terms a table holds where a direction pair reads it: theta_d of an axis `abs_theta_o` is
/// abs(theta_o).
bsdf::Point point_read(const TableLayout& table, bsdf::Point point);
/// Texture coordinate at which a shader reads the axis for a point.
double axis_coordinate(const Axis& axis, int size, const bsdf::Point& point, double caustic_index = 0);
/// What a shader multiplies a table's values by at a point: 1 but for an axis `from_caustic`.
double left_out_factor(const TableLayout& table, const bsdf::Point& point, double caustic_index);
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
/// The same as a table holds them: without the factor that it leaves out.
Result<std::vector<glm::dvec3>> held_values(const Source& source, const TableLayout& table, const Channel& channel,
                                            std::span<const bsdf::Point> points);

/// Error: usage for a size outside 16 .. 1024.
Result<void> check_size(int size);
/// Error: usage where the layout does not suit the model: a near field, a lobe that it lacks, a caustic that it has
/// not.
Result<void> check_bakeable(const Source& source, const registry::ParameterValues& values, const Layout& layout);
/// How many points of the model a bake evaluates at that size.
std::size_t points_to_bake(const Layout& layout, int size);
/// What a bake takes on this machine, by the time of a few points. Errors: as the source.
Result<double> seconds_to_bake(const Source& source, const Layout& layout, int size);
/// A table of one size before it is baked: all 0, scales of 1.
Table empty_table(const TableLayout& layout, int size);
/// Suits channels of Texel::for_filter, which hold points, to the filter.
void suit_to_filter(Table& table);
/// One table; solved channels stay 0.
Result<Table> bake_table(const Source& source, const TableLayout& layout, int size);
/// `bake` from any source; bake_ms and baked_on are left to the caller.
Result<TableSet> bake_from(const Source& source, const registry::ParameterValues& values, const Layout& layout,
                           int size, Progress& progress);

}  // namespace cuticle::lut
