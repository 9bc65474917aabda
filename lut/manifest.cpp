#include <fmt/format.h>

#include "core/json/json.h"
#include "lut/format.h"
#include "lut/probes.h"
#include "lut/table_set.h"

namespace cuticle::lut {
namespace {

Json axis_json(const Axis& axis, int size, double caustic_index) {
  const AxisMap map = axis_map(axis, size);
  Json json{{"quantity", axis_info(axis.quantity).name},
          {"formula", axis_info(axis.quantity).formula},
          {"range", {axis.lower, axis.upper}},
          {"sample_positions", axis.corner_aligned ? "end points on texel centres" : "end points on texel borders"},
          {"coordinate", "value * scale + bias"},
          {"scale", map.scale},
          {"bias", map.bias},
          {"address_mode", "clamp"}};
  if (axis.quantity == AxisQuantity::from_caustic) {
    json["eta"] = caustic_index;
    json["gap"] = 1.0 / (size - 1);
  }
  return json;
}

Json measures_json(const ChannelError& error) {
  return {{"maximum", error.maximum},
          {"rms", error.rms},
          {"percentile_99", error.percentile_99},
          {"exact_peak", error.peak},
          {"exact_rms", error.signal_rms},
          {"maximum_over_peak", relative_error(error.maximum, error.peak)},
          {"percentile_99_over_peak", relative_error(error.percentile_99, error.peak)},
          {"rms_over_rms", relative_error(error.rms, error.signal_rms)},
          {"uniform_in_angle",
           {{"rms", error.in_angle.rms},
            {"percentile_99", error.in_angle.percentile_99},
            {"exact_rms", error.in_angle.signal_rms},
            {"rms_over_rms", relative_error(error.in_angle.rms, error.in_angle.signal_rms)}}}};
}

Json error_json(const ChannelError& error, Texel texel) {
  Json json = measures_json(error);
  if (texel == Texel::cell_average) {
    json["compared_with"] = "the model's averages over bins half a texel wide in phi";
    json["excluded"] = error.excluded;
    json["excluded_because"] = "the bin filters a texel that touches the caustic";
  } else {
    json["compared_with"] = "the model at points off the texels";
  }
  return json;
}

Json level_json(const MipLevel& level) {
  Json channels;
  for (const ChannelError& error : level.errors)
    channels[error.channel] = {{"rms_over_rms", relative_error(error.rms, error.signal_rms)},
                               {"maximum_over_peak", relative_error(error.maximum, error.peak)},
                               {"percentile_99_over_peak", relative_error(error.percentile_99, error.peak)}};
  return {{"size", {level.image.width, level.image.height}},
          {"compared_with", "the model averaged over one texel of this level around each sample"},
          {"errors", channels}};
}

Json scattering_json(const std::vector<ChannelError>& errors, std::string_view words) {
  Json json{{"compared_with", words}};
  for (const ChannelError& error : errors) {
    json[error.channel] = measures_json(error);
    json[error.channel]["excluded"] = error.excluded;
  }
  return json;
}

std::string_view texel_words(Texel texel) {
  if (texel == Texel::for_filter) return "point, suited to a bilinear filter";
  return texel == Texel::point ? "point" : "cell average";
}

Json channel_json(const Table& table, const Format& format, int c) {
  const Channel& channel = table.layout->channels[c];
  const double maximum = channel_maximum(table, c);
  Json json{{"name", channel.name},
            {"stored_in", std::string(1, "RGBA"[c])},
            {"value", "stored * scale"},
            {"scale", table.scale[c]},
            {"maximum", maximum},
            {"probe_tolerance", probe_tolerance(format, maximum)},
            {"unit", channel.source == ChannelSource::model ? "1/rad" : "1"},
            {"texel", texel_words(channel.texel)}};
  if (c < int(table.errors.size())) json["error"] = error_json(table.errors[c], channel.texel);
  return json;
}

Json probes_json(const Table& table) {
  Json probes = Json::list();
  for (const Probe& probe : probes_of(table))
    probes.push_back({{"u", probe.u},
                      {"v", probe.v},
                      {"at", probe.interpolated ? "between texels" : "texel centre"},
                      {"values", probe.values}});
  return probes;
}

Json terms_json(const Layout& layout) {
  Json terms = Json::list();
  for (const Term& term : layout.terms) {
    Json factors = Json::list();
    for (const std::string_view factor : term.factors)
      if (!factor.empty()) factors.push_back(factor);
    terms.push_back(factors);
  }
  return terms;
}

Json table_json(const Table& table, const Format& format, int size) {
  Json channels = Json::list();
  for (int c = 0; c < table.image.channels(); ++c) channels.push_back(channel_json(table, format, c));
  Json levels = Json::list();
  for (const MipLevel& level : table.levels) levels.push_back(level_json(level));
  return {{"name", table.layout->name},
          {"file", file_name(table, format)},
          {"size", {table.image.width, table.image.height}},
          {"u", axis_json(table.layout->u, size, table.caustic_index)},
          {"v", axis_json(table.layout->v, size, table.caustic_index)},
          {"mip_maps", "none"},
          {"compression", "none"},
          {"channels", channels},
          {"levels", levels},
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
  Json json{{"schema_version", 2},
            {"tool", "cuticle"},
            {"tool_version", CUTICLE_VERSION},
            {"model", set.model->entry.name},
            {"source", set.model->entry.source},
            {"conventions", conventions_json(set.model->conventions)},
            {"parameters", Json::parse(registry::to_json(set.values)).value()},
            {"layout", set.layout->entry.name},
            {"composition", set.layout->composition},
            {"terms", terms_json(*set.layout)},
            {"over_cos2_theta_d", set.layout->over_cos2_theta_d},
            {"size", set.size},
            {"format", format.name},
            {"format_summary", format.summary},
            {"color_space", "data"},
            {"origin", "top_left"},
            {"licence", "the tables are the output of a program and belong to whoever ran it"},
            {"baked_on", set.baked_on},
            {"texels", set.fitted ? "fitted" : "samples"}};
  if (!set.assumption.empty())
    json["assumption"] = scattering_json(set.assumption, "S composed of exact channels, with the model's S");
  if (!set.scattering.empty())
    json["scattering"] = scattering_json(set.scattering, "S read from the stored tables, with the model's S");
  for (const Table& table : set.tables) json["tables"].push_back(table_json(table, format, set.size));
  return json.dump(2) + "\n";
}

Result<std::string> with_digests(const std::string& manifest, const std::string& folder) {
  Json json = Json::parse(manifest).value();
  for (Json& table : json["tables"]) {
    CUTICLE_ASSIGN(table["sha256"], sha256_of_file(folder + "/" + table["file"].text()));
  }
  return json.dump(2) + "\n";
}

}  // namespace cuticle::lut
