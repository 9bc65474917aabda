#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cuticle/lut/format.h>
#include <cuticle/lut/table_set.h>

namespace cuticle::lut {
namespace {

using Json = nlohmann::ordered_json;

Json axis_json(const Axis& axis, int size) {
  const AxisMap map = axis_map(axis, size);
  return {{"quantity", axis_info(axis.quantity).name},
          {"formula", axis_info(axis.quantity).formula},
          {"range", {axis.lower, axis.upper}},
          {"sample_positions", axis.corner_aligned ? "end points on texel centres" : "end points on texel borders"},
          {"coordinate", "value * scale + bias"},
          {"scale", map.scale},
          {"bias", map.bias},
          {"address_mode", "clamp"}};
}

Json error_json(const ChannelError& error, Texel texel) {
  Json json{{"maximum", error.maximum},
            {"rms", error.rms},
            {"percentile_99", error.percentile_99},
            {"exact_peak", error.peak},
            {"exact_rms", error.signal_rms},
            {"maximum_over_peak", error.peak > 0 ? error.maximum / error.peak : 0},
            {"rms_over_rms", error.signal_rms > 0 ? error.rms / error.signal_rms : 0}};
  if (texel == Texel::cell_average) {
    json["compared_with"] = "the model's averages over bins half a texel wide in phi";
    json["excluded"] = error.excluded;
    json["excluded_because"] = "the bin filters a texel that touches the caustic";
  } else {
    json["compared_with"] = "the model at points off the texels";
  }
  return json;
}

Json channel_json(const Table& table, int c) {
  const Channel& channel = table.layout->channels[c];
  Json json{{"name", channel.name},
            {"stored_in", std::string(1, "RGBA"[c])},
            {"value", "stored * scale"},
            {"scale", table.scale[c]},
            {"unit", channel.lobe.empty() ? "1" : "1/rad"},
            {"texel", channel.texel == Texel::point ? "point" : "cell average"}};
  if (c < int(table.errors.size())) json["error"] = error_json(table.errors[c], channel.texel);
  return json;
}

Json probes_json(const Table& table) {
  const double low = 0.5 / table.image.width, high = 1 - low;
  const double at[5][2] = {{low, low}, {high, low}, {low, high}, {high, high}, {0.5, 0.5}};
  Json probes = Json::array();
  for (const auto& [u, v] : at) {
    Json values = Json::array();
    for (int c = 0; c < table.image.channels(); ++c) values.push_back(sample(table, c, u, v));
    probes.push_back({{"u", u}, {"v", v}, {"values", values}});
  }
  return probes;
}

Json table_json(const Table& table, const Format& format, int size) {
  Json channels = Json::array();
  for (int c = 0; c < table.image.channels(); ++c) channels.push_back(channel_json(table, c));
  return {{"name", table.layout->name},
          {"file", file_name(table, format)},
          {"size", {table.image.width, table.image.height}},
          {"u", axis_json(table.layout->u, size)},
          {"v", axis_json(table.layout->v, size)},
          {"channels", channels},
          {"probes", probes_json(table)}};
}

Json conventions_json(const bsdf::Conventions& conventions) {
  return {{"field", conventions.field},
          {"cosine", conventions.cosine},
          {"tilt_sign", conventions.tilt_sign},
          {"roughness", conventions.roughness},
          {"absorption", conventions.absorption}};
}

}  // namespace

std::string file_name(const Table& table, const Format& format) {
  return fmt::format("{}.{}", table.layout->name, format.extension);
}

std::string manifest_json(const TableSet& set, const Format& format) {
  Json json{{"schema_version", 1},
            {"tool", "cuticle"},
            {"tool_version", CUTICLE_VERSION},
            {"model", set.model->entry.name},
            {"source", set.model->entry.source},
            {"conventions", conventions_json(set.model->conventions)},
            {"parameters", Json::parse(registry::to_json(set.values))},
            {"layout", set.layout->entry.name},
            {"composition", set.layout->composition},
            {"size", set.size},
            {"format", format.summary},
            {"color_space", "data"},
            {"origin", "top_left"},
            {"baked_on", set.baked_on},
            {"bake_ms", set.bake_ms}};
  for (const Table& table : set.tables) json["tables"].push_back(table_json(table, format, set.size));
  return json.dump(2) + "\n";
}

}  // namespace cuticle::lut
