#pragma once
// Lookup textures of scattering terms: layouts as data, tables, their measured error.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "bsdf/dual_scattering/dual_scattering.h"
#include "bsdf/model.h"
#include "core/image/image.h"
#include "core/progress.h"
#include "core/registry/entry.h"

namespace cuticle::lut {

/// What an axis of a table carries; `none`: the table has one row. `from_caustic` (u only, over theta_d): the table
/// holds N over a factor that is known (lut/caustic.glslh). `abs_theta_o`: N of models that have the viewer's
/// inclination in theta_d's place. `theta_between`: half the angle between light and viewer; `theta_half`, `phi_half`:
/// the half vector's inclination and its azimuth from the viewer's (lut/half_vector.glslh); `cos_normal`: the cosine
/// between the light and the normal that faces the viewer. Tables over these four are a layout's own to fill.
enum class AxisQuantity {
  sin_theta_i,
  sin_theta_o,
  cos_phi,
  cos_theta_d,
  theta_i,
  theta_o,
  phi,
  theta_d,
  from_caustic,
  abs_theta_o,
  theta_between,
  theta_half,
  phi_half,
  cos_normal,
  none
};
/// Whether light and viewer make it together (lut/half_vector.glslh): no single angle of a point.
constexpr bool is_of_half_vector(AxisQuantity quantity) {
  return quantity >= AxisQuantity::theta_between && quantity <= AxisQuantity::cos_normal;
}
/// One row of the table of quantities.
struct AxisInfo {
  AxisQuantity quantity;
  std::string_view name;             ///< "sin_theta_i"
  std::string_view formula;          ///< what a shader computes, in words
  double bsdf::Point::*angle;        ///< which angle of a point it fixes; null for none
  double (*to_angle)(double value);  ///< radians
  double (*from_angle)(double angle);
  double lower, upper;  ///< where it has a meaning; beyond, texels repeat the value at the end
};
const AxisInfo& axis_info(AxisQuantity quantity);
/// An axis, and how a texture coordinate in [0, 1] maps to its value.
struct Axis {
  AxisQuantity quantity;
  double lower, upper;  ///< value at the first and at the last texel centre (corner aligned), or at the borders
  bool corner_aligned;  ///< true: end points lie on texel centres; false: on texel borders
};
inline constexpr Axis k_no_axis{AxisQuantity::none, 0, 1, false};
/// What a texel holds: the value at its centre, or, where the lobe has an infinite peak (the caustic of TRT), its mean
/// over the azimuths that the texel covers: the integral of N over phi divided by the width in phi, at the row's cos
/// theta_d.
/// `for_filter`: the point's value less a twelfth of the second differences along both axes, but at the borders and
/// never less than half of it: of smooth values a bilinear filter then reads 0.4 times the error (rms).
enum class Texel { point, cell_average, for_filter };
/// Where a channel's texels come from: the model's quantity for a lobe; the auxiliary angle; the average fibre of dual
/// scattering; or the layout's own solver.
enum class ChannelSource { model, cos_theta_d, average_fibre, solver };
struct Channel {
  std::string_view name;  ///< "M_R", "N_TT.r", "cos_theta_d"
  bsdf::Quantity quantity;
  std::string_view lobe;  ///< "R", "TT", "TRT", or "TT+TRT" for summed, or "" where the source is not the model
  int component;          ///< 0, 1, 2 of the rgb
  Texel texel = Texel::point;
  ChannelSource source = ChannelSource::model;
  glm::dvec3 (*average)(const bsdf::DualScatteringRow&) = nullptr;  ///< of the average fibre
};
struct TableLayout {
  std::string_view name;  ///< file stem, "M", "N_TT_R"
  Axis u, v;
  std::span<const Channel> channels;
};
/// A product in a layout's composition: names of channels, or of rgb channels without their suffix: "N_TT" is N_TT.r
/// for red. S is the sum of a layout's terms.
struct Term {
  std::array<std::string_view, 3> factors;  ///< "" where there are fewer
};
struct Layout {
  registry::Entry entry;
  std::span<const TableLayout> tables;
  std::string_view composition;      ///< how a shader puts S together from the channels, in words
  std::span<const Term> terms = {};  ///< the same as data; empty: the tables do not make S
  bool over_cos2_theta_d = false;    ///< the shader divides the sum by cos^2 theta_d
  std::string_view family = {};      ///< layouts of one family hold the same terms along other axes
  std::string_view model = {};       ///< the one model whose S they are; empty: any that has their lobes
  int points_of_mean = 0;            ///< solved texels hold means over their azimuths, by so many points; 0: points
  /// Fills the texels of the channels whose source is `solver`; null: none has it.
  Result<void> (*solve)(const struct Source& source, struct TableSet& set, Progress& progress) = nullptr;
};
std::span<const Layout* const> layouts();
Result<const Layout*> find_layout(std::string_view name);
/// How scenes and `bake` name the layout that suits the model, their default.
inline constexpr std::string_view k_best_layout = "auto";
/// The layout of this name or, for k_best_layout, the model's own layout; else the one whose tables lose least of the
/// model's S for their bytes: `nalu_caustic`, `nalu_theta` or `deon`, whose own assumption is measured at random directions (in this order where
/// they are equal), and `factored` where that is more than 1 % rms (Layout.Best_HasTheLeastErrorOfItsBytes in
/// lut_best_layout_test). Error: usage for an unknown name.
Result<const Layout*> find_layout(std::string_view name, const bsdf::Model& model,
                                  const registry::ParameterValues& values);

/// Errors with every direction alike: weighted by the angles that a texture coordinate covers, so that what the axes
/// squeeze together counts for less.
struct AngleError {
  double rms = 0, percentile_99 = 0, signal_rms = 0;
};
/// Error of one channel after the engine's bilinear filter in the stored format, on a dense grid off the texels,
/// uniform in texture coordinates. A channel of cell averages is compared with averages over bins half a texel wide;
/// bins that filter a texel on the caustic are left out.
struct ChannelError {
  std::string channel;
  double maximum = 0, rms = 0, percentile_99 = 0;  ///< absolute
  double peak = 0, signal_rms = 0;  ///< of the exact values: relative errors are maximum/peak, rms/signal_rms
  double excluded = 0;              ///< share of the grid left out, 0 .. 1
  AngleError in_angle;
};
/// An error as a share of what it is an error of; 0 where that is nothing.
inline double relative_error(double error, double whole) { return whole > 0 ? error / whole : 0; }
/// A level below the first: half as many texels each way, and what it costs against the exact channel averaged over the
/// level's footprint (a texel of that level around any texture coordinate).
struct MipLevel {
  Image image;
  std::vector<ChannelError> errors;
};
struct Table {
  const TableLayout* layout = nullptr;
  Image image;                         ///< stored numbers, one channel per layout channel; row 0 = lower end of v
  std::vector<double> scale;           ///< per channel, 1 unless the format needs it: value = stored * scale
  double caustic_index = 0;            ///< of the fibre that an axis `from_caustic` belongs to
  std::vector<std::uint8_t> singular;  ///< per texel: 1 where a cell average covers a caustic
  std::vector<ChannelError> errors;    ///< filled by `certify`
  std::vector<MipLevel> levels;        ///< filled by `certify`; level 1 first; same scale
};
struct TableSet {
  const Layout* layout = nullptr;
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  int size = 128;
  std::vector<Table> tables;
  double bake_ms = 0;
  std::string baked_on;  ///< "cpu" or the device's name
  bool fitted = false;  ///< texels minimise the error after the filter (fit_texels); else they are samples of the model
  /// Of S for red, green and blue, light and eye evenly over the sphere; filled by `certify` where the layout has
  /// terms. `assumption`: put together from exact channels, so what the layout itself leaves out. `scattering`: from
  /// the stored tables, as a shader reads them.
  std::vector<ChannelError> assumption = {}, scattering = {};
};

/// Texture coordinate = value * scale + bias: what a shader multiplies and adds before it samples.
struct AxisMap {
  double scale = 1, bias = 0;
};
AxisMap axis_map(const Axis& axis, int size);
/// Texels each way: size x size, or size x 1 where v carries nothing.
glm::ivec2 table_size(const TableLayout& table, int size);
/// The value of the axis at a texture coordinate, clamped to its range.
double axis_value(const Axis& axis, int size, double coordinate);

/// Bakes on all CPU threads, in double: texel centres, or averages over the texel's azimuths (see Texel; the averages
/// hold to 2e-5 of themselves). Error: usage for a size outside 16 .. 1024 or a model without the layout's lobes.
Result<TableSet> bake(const bsdf::Model& model, const registry::ParameterValues& values, const Layout& layout, int size,
                      Progress& progress);
/// The model's value for a channel at fractions (u, v) in [0, 1]^2 of the two axes (0 = lower, 1 = upper end): what a
/// perfect table of points would return.
double exact_value(const bsdf::Model& model, const registry::ParameterValues& values, const TableLayout& table,
                   const Channel& channel, double u, double v);
struct Format;  ///< how a file holds the numbers, lut/format.h
struct Target;  ///< an engine's own files, lut/target.h
/// The value (stored times scale) at texture coordinates, filtered as an engine does: bilinear, clamped to the edge. A
/// coordinate that is NaN reads the last texel.
double sample(const Table& table, int channel, double u, double v);
/// The same for a level's stored numbers, without the scale.
double sample(const Image& image, int channel, double u, double v);
/// Rounds the stored numbers to the format and sets the scales (PNG: the channel's largest value; half: 1 while it can
/// hold the values). Error: internal when a value is negative or not finite.
Result<void> store_as(TableSet& set, const Format& format);
/// `store_as`, then measures the errors of every channel against the model in double.
Result<void> certify(TableSet& set, const Format& format, Progress& progress);
/// Writes the tables in the format, manifest.json, preview.png, the snippets (cuticle_hair.glsl, .hlsl, .wgsl) and the
/// files of the targets into the folder, first into a hidden folder inside it, so that a failure leaves nothing. The
/// set must hold the format's numbers (`store_as` or `certify`). EXR and KTX2 files carry the manifest as
/// "cuticle:manifest". Error: bad_input naming the file; usage when a target cannot read the format.
Result<void> write(const TableSet& set, const Format& format, const std::string& folder,
                   std::span<const Target* const> targets = {});
/// File name of a table, "M.exr".
std::string file_name(const Table& table, const Format& format);
/// The manifest as JSON text: tool version, model, conventions, parameters, axes with scale and bias, channels with
/// scale, texel rule and errors, unit, colour space, origin, terms, and ten probe values for each table (`probes_of`).
std::string manifest_json(const TableSet& set, const Format& format);

}  // namespace cuticle::lut
