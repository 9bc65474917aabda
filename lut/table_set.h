#pragma once
// Lookup textures of scattering terms: layouts as data, tables, their measured error.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <cuticle/bsdf/model.h>
#include <cuticle/core/image/image.h>
#include <cuticle/core/progress.h>
#include <cuticle/core/registry/entry.h>

namespace cuticle::lut {

/// What an axis of a table carries, and how a texture coordinate in [0, 1] maps to it.
enum class AxisQuantity { sin_theta_i, sin_theta_o, cos_phi, cos_theta_d };
struct Axis {
  AxisQuantity quantity;
  double lower, upper;  ///< value at the first and at the last texel centre (corner aligned), or at the borders
  bool corner_aligned;  ///< true: end points lie on texel centres; false: on texel borders
};
/// What a texel holds: the value at its centre, or, where the lobe has an infinite peak (the caustic of TRT), its mean
/// over the azimuths that the texel covers: the integral of N over phi divided by the width in phi, at the row's cos
/// theta_d.
enum class Texel { point, cell_average };
/// A channel: a quantity of the model for a lobe and a colour component; `cos_theta_d` stores the auxiliary angle.
struct Channel {
  std::string_view name;  ///< "M_R", "N_TT.r", "cos_theta_d"
  bsdf::Quantity quantity;
  std::string_view lobe;  ///< "R", "TT", "TRT", or "TT+TRT" for summed, or "" for cos_theta_d
  int component;          ///< 0, 1, 2 of the rgb
  Texel texel = Texel::point;
};
struct TableLayout {
  std::string_view name;  ///< file stem, "M", "N_TT_R"
  Axis u, v;
  std::span<const Channel> channels;
};
struct Layout {
  registry::Entry entry;
  std::span<const TableLayout> tables;
  std::string_view composition;  ///< how a shader puts S together from the channels
};
std::span<const Layout* const> layouts();
Result<const Layout*> find_layout(std::string_view name);

/// Error of one channel after the engine's bilinear filter in the stored format, on a dense grid off the texels. A
/// channel of cell averages is compared with averages over bins half a texel wide; bins that filter a texel on the
/// caustic are left out.
struct ChannelError {
  std::string channel;
  double maximum = 0, rms = 0, percentile_99 = 0;  ///< absolute
  double peak = 0, signal_rms = 0;  ///< of the exact values: relative errors are maximum/peak, rms/signal_rms
  double excluded = 0;              ///< share of the grid left out, 0 .. 1
};
struct Table {
  const TableLayout* layout = nullptr;
  Image image;                         ///< stored numbers, one channel per layout channel; row 0 = lower end of v
  std::vector<double> scale;           ///< per channel, 1 unless the format needs it: value = stored * scale
  std::vector<std::uint8_t> singular;  ///< per texel: 1 where a cell average covers a caustic
  std::vector<ChannelError> errors;    ///< filled by `certify`
};
struct TableSet {
  const Layout* layout = nullptr;
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  int size = 128;
  std::vector<Table> tables;
  double bake_ms = 0;
  std::string baked_on;  ///< "cpu" or the device's name
};

/// Texture coordinate = value * scale + bias: what a shader multiplies and adds before it samples.
struct AxisMap {
  double scale = 1, bias = 0;
};
AxisMap axis_map(const Axis& axis, int size);
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
enum class Format { exr, png8, png16 };
/// "exr", "png8", "png16". Error: usage, listing them.
Result<Format> find_format(std::string_view name);
/// The value (stored times scale) at texture coordinates, filtered as an engine does: bilinear, clamped to the edge.
double sample(const Table& table, int channel, double u, double v);
/// Rounds the stored numbers to the format and sets the scales (PNG: the channel's largest value; EXR: 1 while half can
/// hold the values). Error: internal when a value is negative or not finite.
Result<void> store_as(TableSet& set, Format format);
/// `store_as`, then measures the errors of every channel against the model in double.
Result<void> certify(TableSet& set, Format format, Progress& progress);
/// Writes EXR/PNG tables, manifest.json and preview.png into the folder, first into a hidden folder inside it, so that
/// a failure leaves nothing. The set must hold the format's numbers (`store_as` or `certify`). EXR files carry the
/// manifest as the attribute "cuticle:manifest". Error: bad_input naming the file.
Result<void> write(const TableSet& set, Format format, const std::string& folder);
/// File name of a table, "M.exr".
std::string file_name(const Table& table, Format format);
/// The manifest as JSON text: tool version, model, conventions, parameters, axes with scale and bias, channels with
/// scale, texel rule and errors, unit, colour space, origin, and five probe values (corners and centre) for each table.
std::string manifest_json(const TableSet& set, Format format);

}  // namespace cuticle::lut
