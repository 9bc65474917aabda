#include "viz/tables/tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/file.h"
#include "core/json/json.h"
#include "lut/cell_average.h"
#include "lut/evaluate.h"
#include "lut/manifest.h"
#include "viz/files/vtk_xml.h"

namespace cuticle::viz {
namespace {

/// The axis' value at a texture coordinate.
double value_along(const lut::Axis& axis, int size, double coordinate) {
  const double share = axis.corner_aligned ? (coordinate * size - 0.5) / (size - 1) : coordinate;
  return axis.lower + share * (axis.upper - axis.lower);
}

bool is_angle(const lut::Axis& axis) {
  const std::string_view name = lut::axis_info(axis.quantity).name;
  return name == "theta_i" || name == "theta_o" || name == "phi" || name == "theta_d" || name == "abs_theta_o" ||
         name == "theta_between" || name == "theta_half" || name == "phi_half";
}
/// Angles are shown in degrees.
double shown_value(const lut::Axis& axis, int size, double coordinate) {
  return value_along(axis, size, coordinate) * (is_angle(axis) ? 180 / std::numbers::pi : 1);
}
std::string axis_title(const lut::Axis& axis, char letter) {
  return fmt::format("{}: {}{}", letter, lut::axis_info(axis.quantity).name, is_angle(axis) ? " [deg]" : "");
}

std::string unit_of(const lut::Channel& channel) {
  if (channel.source == lut::ChannelSource::cos_theta_d) return "1";
  if (channel.quantity == bsdf::Quantity::S) return "1/sr";
  if (channel.quantity == bsdf::Quantity::M || channel.quantity == bsdf::Quantity::N) return "1/rad";
  return "1";
}

std::vector<float> values_of(const lut::Table& table, int channel) {
  std::vector<float> values;
  for (int y = 0; y < table.image.height; ++y)
    for (int x = 0; x < table.image.width; ++x)
      values.push_back(float(double(table.image.at(x, y, channel)) * table.scale[std::size_t(channel)]));
  return values;
}

/// Exact values between texels: at their corners, or over the texel around each.
Result<std::vector<glm::dvec3>> exact_values(const lut::Source& source, const lut::Table& table,
                                             const lut::Channel& channel) {
  const int width = table.image.width, height = table.image.height;
  const lut::TableLayout& layout = *table.layout;
  std::vector<bsdf::Point> points;
  std::vector<lut::PhiInterval> cells;
  for (int y = 1; y < height; ++y)
    for (int x = 1; x < width; ++x) {
      const double u = double(x) / width, v = double(y) / height, half = 0.5 / width;
      if (channel.texel == lut::Texel::cell_average)
        cells.push_back(lut::phi_interval(layout, width, u - half, u + half, v));
      else
        points.push_back(lut::make_point(layout, value_along(layout.u, width, u), value_along(layout.v, height, v),
                                         width, table.caustic_index));
    }
  if (cells.empty()) return lut::held_values(source, layout, channel, points);
  CUTICLE_ASSIGN(lut::PhiAverages averages, lut::average_over_phi(source, channel, cells));
  return std::move(averages.values);
}

Result<void> add_errors(const lut::Source& source, const lut::Table& table, int index, TableChannel& shown) {
  const lut::Channel& channel = table.layout->channels[std::size_t(index)];
  const bool is_known =
      channel.source == lut::ChannelSource::model || channel.source == lut::ChannelSource::cos_theta_d;
  if (!is_known || table.image.height < 2) return {};
  CUTICLE_ASSIGN(const std::vector<glm::dvec3> exact, exact_values(source, table, channel));
  shown.error_width = table.image.width - 1;
  shown.error_height = table.image.height - 1;
  for (int y = 0; y < shown.error_height; ++y)
    for (int x = 0; x < shown.error_width; ++x) {
      const double read =
          lut::sample(table, index, double(x + 1) / table.image.width, double(y + 1) / table.image.height);
      const std::size_t at = std::size_t(y) * std::size_t(shown.error_width) + std::size_t(x);
      shown.errors.push_back(float(read - exact[at][channel.component]));
    }
  return {};
}

TableChannel channel_of(const lut::Table& table, int index) {
  const lut::TableLayout& layout = *table.layout;
  const lut::Channel& channel = layout.channels[std::size_t(index)];
  TableChannel shown;
  shown.name = channel.name;
  shown.unit = unit_of(channel);
  shown.u_title = axis_title(layout.u, 'u');
  shown.v_title = axis_title(layout.v, 'v');
  shown.width = table.image.width;
  shown.height = table.image.height;
  shown.u_lower = shown_value(layout.u, shown.width, 0);
  shown.u_upper = shown_value(layout.u, shown.width, 1);
  if (shown.height > 1) {
    shown.v_lower = shown_value(layout.v, shown.height, 0);
    shown.v_upper = shown_value(layout.v, shown.height, 1);
  }
  shown.values = values_of(table, index);
  for (const float value : shown.values) shown.peak = std::max(shown.peak, std::abs(double(value)));
  return shown;
}

Result<const lut::Table*> table_named(const lut::TableSet& set, const std::string& name) {
  std::vector<std::string_view> names;
  for (const lut::Table& table : set.tables) {
    if (name.empty() || table.layout->name == name) return &table;
    names.push_back(table.layout->name);
  }
  return usage_error(fmt::format("--table {}: the set has {}", name, fmt::join(names, ", ")), "one of these");
}

Result<registry::ParameterValues> manifest_parameters(const std::string& folder, const bsdf::Model& model) {
  const std::string file = folder + "/manifest.json";
  CUTICLE_ASSIGN(const std::string text, read_text_file(file));
  CUTICLE_ASSIGN(const Json json, Json::parse(text));
  if (!json.contains("parameters")) return bad_input(file + ": key 'parameters' is missing");
  return registry::values_from_json(model.entry.parameters, json["parameters"].dump(), file);
}

}  // namespace

Result<lut::TableSet> read_tables(const std::string& folder) {
  CUTICLE_ASSIGN(const lut::Manifest manifest, lut::read_manifest(folder));
  lut::TableSet set;
  CUTICLE_ASSIGN(set.model, bsdf::find_model(manifest.model));
  CUTICLE_ASSIGN(set.layout, lut::find_layout(manifest.layout));
  CUTICLE_ASSIGN(set.values, manifest_parameters(folder, *set.model));
  const lut::Source source = lut::cpu_source(*set.model, set.values);
  for (std::size_t k = 0; k < manifest.tables.size() && k < set.layout->tables.size(); ++k) {
    const lut::ManifestTable& described = manifest.tables[k];
    lut::Table table;
    table.layout = &set.layout->tables[k];
    const std::string file = folder + "/" + described.file;
    CUTICLE_ASSIGN(table.image, described.file.ends_with(".exr") ? read_exr(file) : read_image(file));
    if (table.image.channels() < int(described.channels.size()))
      return bad_input(fmt::format("{}: {} channels, the manifest names {}", file, table.image.channels(),
                                   described.channels.size()));
    for (const lut::ManifestChannel& channel : described.channels) table.scale.push_back(channel.scale);
    table.caustic_index = source.caustic_index;
    set.tables.push_back(std::move(table));
  }
  return set;
}

Result<std::vector<TableChannel>> table_channels(const TablesView& view) {
  CUTICLE_ASSIGN(const lut::Table* table, table_named(view.set, view.table));
  const lut::Source source = lut::cpu_source(*view.set.model, view.set.values);
  std::vector<TableChannel> shown;
  for (int index = 0; index < int(table->layout->channels.size()); ++index) {
    shown.push_back(channel_of(*table, index));
    CUTICLE_TRY(add_errors(source, *table, index, shown.back()));
  }
  return shown;
}

Result<void> write_tables(const lut::TableSet& set, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  for (const lut::Table& table : set.tables) {
    std::vector<NamedArray> arrays;
    for (int index = 0; index < int(table.layout->channels.size()); ++index)
      arrays.push_back({std::string(table.layout->channels[std::size_t(index)].name),
                        unit_of(table.layout->channels[std::size_t(index)]), 1, values_of(table, index)});
    const glm::ivec3 size(table.image.width, table.image.height, 1);
    const glm::dvec3 step(1.0 / size.x, 1.0 / size.y, 1);
    CUTICLE_TRY(write_text_file(fmt::format("{}/{}.vti", folder, table.layout->name),
                                format_vti(size, {step.x / 2, step.y / 2, 0}, step, arrays)));
  }
  return {};
}

}  // namespace cuticle::viz
