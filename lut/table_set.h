#pragma once
// Lookup textures of scattering terms: layouts as data, tables, their measured error.
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
  double lower, upper;        ///< value at the first and at the last texel centre (corner aligned), or at the borders
  bool corner_aligned;        ///< true: end points lie on texel centres; false: on texel borders
};
/// A channel: a quantity of the model for a lobe and a colour component; `cos_theta_d` stores the auxiliary angle.
struct Channel {
  std::string_view name;      ///< "M_R", "N_TT.r", "cos_theta_d"
  bsdf::Quantity quantity;
  std::string_view lobe;      ///< "R", "TT", "TRT", or "TT+TRT" for summed, or "" for cos_theta_d
  int component;              ///< 0, 1, 2 of the rgb
};
struct TableLayout {
  std::string_view name;      ///< file stem, "M", "N_TT_R"
  Axis u, v;
  std::span<const Channel> channels;
};
struct Layout {
  registry::Entry entry;
  std::span<const TableLayout> tables;
};
std::span<const Layout* const> layouts();
Result<const Layout*> find_layout(std::string_view name);

/// Error of one channel after the engine's bilinear filter in the stored format, on a dense grid off the texels.
struct ChannelError {
  std::string channel;
  double maximum = 0, rms = 0, percentile_99 = 0;  ///< absolute
  double peak = 0, signal_rms = 0;                 ///< of the exact values: relative errors are maximum/peak, rms/signal_rms
};
struct Table {
  const TableLayout* layout = nullptr;
  Image image;                       ///< values, one channel per layout channel
  std::vector<double> scale;         ///< per channel, 1 unless an integer format needs it: value = stored * scale
  std::vector<ChannelError> errors;  ///< filled by `certify`
};
struct TableSet {
  const Layout* layout = nullptr;
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  int size = 128;
  std::vector<Table> tables;
  double bake_ms = 0;
  std::string baked_on;              ///< "cpu" or the device's name
};

/// Bakes by point sampling at texel centres, on all CPU threads, in double.
Result<TableSet> bake(const bsdf::Model& model, const registry::ParameterValues& values, const Layout& layout, int size,
                      Progress& progress);
/// The model's value for a channel at table coordinates (u, v) in [0, 1]^2: what a perfect table would return.
double exact_value(const bsdf::Model& model, const registry::ParameterValues& values, const TableLayout& table, const Channel& channel,
                   double u, double v);
/// Sample as an engine does: bilinear, clamped, after rounding to the stored format.
enum class Format { exr, png8, png16 };
double sample(const Table& table, int channel, double u, double v);
/// Rounds the stored values to the format (and sets scales), then measures the errors.
Result<void> certify(TableSet& set, Format format, Progress& progress);
/// Writes EXR/PNG tables, manifest.json, preview.png into the folder; all or nothing per file.
Result<void> write(const TableSet& set, Format format, const std::string& folder);
/// The manifest as JSON text.
std::string manifest_json(const TableSet& set, Format format);

}  // namespace cuticle::lut
