#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/file.h"
#include "core/json/json.h"
#include "lut/format.h"
#include "lut/manifest.h"

namespace cuticle::lut {
namespace {

constexpr double k_largest_number = 1e12;  ///< that a manifest may name
constexpr int k_largest_side = 16384;

/// A value of the manifest, with the way to it for messages: "tables[0].channels[1].scale".
class Node {
 public:
  Node(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {}

  Error refuse(std::string_view wanted) const {
    const std::string found = json_->dump(-1, true).substr(0, 40);
    return bad_input(fmt::format("{} is {}; allowed: {}", path_, found, wanted), "write it again with cuticle bake");
  }
  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
  Result<Node> child(const char* key) const {
    if (!json_->is_object()) return refuse("an object");
    const Json* found = json_->find(key);
    if (!found)
      return bad_input(fmt::format("{}{}the key '{}' is missing", path_, path_.ends_with(": ") ? "" : ": ", key),
                       "write it again with cuticle bake");
    return Node(*found, fmt::format("{}{}{}", path_, path_.ends_with(": ") ? "" : ".", key));
  }
  Result<std::vector<Node>> items(std::size_t least, std::size_t most) const {
    if (!json_->is_list() || json_->size() < least || json_->size() > most)
      return refuse(fmt::format("a list of {} .. {}", least, most));
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < json_->size(); ++i) nodes.emplace_back((*json_)[i], fmt::format("{}[{}]", path_, i));
    return nodes;
  }
  Result<double> number(double lowest, double highest) const {
    const double value = json_->is_number() ? json_->number() : lowest - 1;
    if (!(value >= lowest && value <= highest)) return refuse(fmt::format("a number {} .. {}", lowest, highest));
    return value;
  }
  Result<int> whole(int lowest, int highest) const {
    CUTICLE_ASSIGN(const double value, number(lowest, highest));
    if (value != std::floor(value)) return refuse(fmt::format("a whole number {} .. {}", lowest, highest));
    return int(value);
  }
  Result<std::string> text() const {
    if (!json_->is_text()) return refuse("a text");
    return json_->text();
  }
  Result<bool> flag() const {
    if (!json_->is_boolean()) return refuse("true or false");
    return json_->boolean();
  }
  /// One of these texts.
  Result<std::string> one_of(std::initializer_list<std::string_view> words) const {
    CUTICLE_ASSIGN(std::string found, text());
    if (std::find(words.begin(), words.end(), found) == words.end())
      return refuse(fmt::format("{}", fmt::join(words, ", ")));
    return found;
  }

 private:
  const Json* json_;
  std::string path_;
};

Result<double> number(const Node& node, const char* key, double lowest, double highest) {
  CUTICLE_ASSIGN(const Node child, node.child(key));
  return child.number(lowest, highest);
}

Result<std::string> text(const Node& node, const char* key) {
  CUTICLE_ASSIGN(const Node child, node.child(key));
  return child.text();
}

Result<std::vector<Node>> items(const Node& node, const char* key, std::size_t least, std::size_t most) {
  CUTICLE_ASSIGN(const Node child, node.child(key));
  return child.items(least, most);
}

Result<void> expect_word(const Node& node, const char* key, std::initializer_list<std::string_view> words) {
  CUTICLE_ASSIGN(const Node child, node.child(key));
  CUTICLE_TRY(child.one_of(words));
  return {};
}

/// Names become names of files and of variables in shaders.
Result<std::string> plain_name(const Node& node, const char* key, std::string_view more) {
  CUTICLE_ASSIGN(const Node child, node.child(key));
  CUTICLE_ASSIGN(std::string name, child.text());
  const auto allowed = [more](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || more.find(c) != more.npos;
  };
  if (name.empty() || name.size() > 64 || name[0] == '.' || !std::all_of(name.begin(), name.end(), allowed))
    return child.refuse(fmt::format("1 .. 64 letters, digits, _{}", more.empty() ? "" : fmt::format(" and {}", more)));
  return name;
}

Result<ManifestAxis> axis_of(const Node& table, const char* key) {
  CUTICLE_ASSIGN(const Node node, table.child(key));
  ManifestAxis axis;
  CUTICLE_ASSIGN(axis.quantity, plain_name(node, "quantity", ""));
  CUTICLE_ASSIGN(axis.scale, number(node, "scale", -k_largest_number, k_largest_number));
  CUTICLE_ASSIGN(axis.bias, number(node, "bias", -k_largest_number, k_largest_number));
  CUTICLE_TRY(expect_word(node, "address_mode", {"clamp"}));
  if (axis.quantity == "from_caustic") {
    CUTICLE_ASSIGN(axis.eta, number(node, "eta", 1 + 1e-6, 10));
    CUTICLE_ASSIGN(axis.gap, number(node, "gap", 0, 0.1));
  }
  return axis;
}

Result<ManifestChannel> channel_of(const Node& node) {
  ManifestChannel channel;
  CUTICLE_ASSIGN(channel.name, plain_name(node, "name", ".+"));
  CUTICLE_ASSIGN(channel.scale, number(node, "scale", 1e-12, k_largest_number));
  CUTICLE_ASSIGN(channel.maximum, number(node, "maximum", 0, k_largest_number));
  CUTICLE_ASSIGN(channel.tolerance, number(node, "probe_tolerance", 0, k_largest_number));
  return channel;
}

Result<Probe> probe_of(const Node& node, std::size_t channels) {
  Probe probe;
  CUTICLE_ASSIGN(probe.u, number(node, "u", 0, 1));
  CUTICLE_ASSIGN(probe.v, number(node, "v", 0, 1));
  CUTICLE_ASSIGN(const Node at, node.child("at"));
  CUTICLE_ASSIGN(const std::string word, at.one_of({"texel centre", "between texels"}));
  probe.interpolated = word == "between texels";
  CUTICLE_ASSIGN(const std::vector<Node> values, items(node, "values", channels, channels));
  for (const Node& value : values) {
    CUTICLE_ASSIGN(probe.values.emplace_back(), value.number(0, k_largest_number));
  }
  return probe;
}

Result<glm::ivec2> size_of(const Node& node) {
  CUTICLE_ASSIGN(const std::vector<Node> sides, items(node, "size", 2, 2));
  glm::ivec2 size{0};
  CUTICLE_ASSIGN(size.x, sides[0].whole(1, k_largest_side));
  CUTICLE_ASSIGN(size.y, sides[1].whole(1, k_largest_side));
  return size;
}

Result<void> read_rows(const Node& node, ManifestTable& table) {
  CUTICLE_ASSIGN(const std::vector<Node> channels, items(node, "channels", 1, 4));
  for (const Node& channel : channels) {
    CUTICLE_ASSIGN(table.channels.emplace_back(), channel_of(channel));
  }
  CUTICLE_ASSIGN(const std::vector<Node> probes, items(node, "probes", 1, 64));
  for (const Node& probe : probes) {
    CUTICLE_ASSIGN(table.probes.emplace_back(), probe_of(probe, table.channels.size()));
  }
  return {};
}

Result<std::string> digest_of(const Node& node) {
  if (!node.has("sha256")) return std::string();
  CUTICLE_ASSIGN(const Node child, node.child("sha256"));
  CUTICLE_ASSIGN(std::string digest, child.text());
  if (digest.size() != 64 || digest.find_first_not_of("0123456789abcdef") != digest.npos)
    return child.refuse("64 digits 0 .. 9, a .. f");
  return digest;
}

Result<ManifestTable> table_of(const Node& node) {
  ManifestTable table;
  CUTICLE_ASSIGN(table.name, plain_name(node, "name", ""));
  CUTICLE_ASSIGN(table.file, plain_name(node, "file", "."));
  CUTICLE_ASSIGN(table.sha256, digest_of(node));
  CUTICLE_ASSIGN(table.size, size_of(node));
  CUTICLE_ASSIGN(table.u, axis_of(node, "u"));
  CUTICLE_ASSIGN(table.v, axis_of(node, "v"));
  CUTICLE_TRY(read_rows(node, table));
  return table;
}

bool holds(const Manifest& manifest, const std::string& factor) {
  for (const ManifestTable& table : manifest.tables)
    for (const ManifestChannel& channel : table.channels)
      if (channel.name == factor || channel.name == factor + ".r") return true;
  return false;
}

Result<void> read_terms(const Node& root, Manifest& manifest) {
  CUTICLE_ASSIGN(const std::vector<Node> terms, items(root, "terms", 0, 16));
  for (const Node& term : terms) {
    CUTICLE_ASSIGN(const std::vector<Node> factors, term.items(1, 3));
    std::vector<std::string>& names = manifest.terms.emplace_back();
    for (const Node& factor : factors) {
      CUTICLE_ASSIGN(names.emplace_back(), factor.text());
      if (!holds(manifest, names.back()))
        return factor.refuse("the name of a channel, or of an rgb group without its suffix");
    }
  }
  CUTICLE_ASSIGN(const Node over, root.child("over_cos2_theta_d"));
  CUTICLE_ASSIGN(manifest.over_cos2_theta_d, over.flag());
  return {};
}

Result<std::string> format_of(const Node& root) {
  CUTICLE_ASSIGN(const Node node, root.child("format"));
  CUTICLE_ASSIGN(std::string name, node.text());
  std::vector<std::string_view> known;
  for (const Format* format : formats()) known.push_back(format->name);
  if (std::find(known.begin(), known.end(), name) == known.end())
    return node.refuse(fmt::format("{}", fmt::join(known, ", ")));
  return name;
}

Result<void> read_head(const Node& root, Manifest& manifest) {
  CUTICLE_ASSIGN(const Node version, root.child("schema_version"));
  CUTICLE_TRY(version.whole(2, 2));
  CUTICLE_TRY(expect_word(root, "color_space", {"data"}));
  CUTICLE_TRY(expect_word(root, "origin", {"top_left"}));
  CUTICLE_ASSIGN(manifest.tool_version, text(root, "tool_version"));
  CUTICLE_ASSIGN(manifest.model, plain_name(root, "model", ""));
  CUTICLE_ASSIGN(manifest.layout, plain_name(root, "layout", ""));
  CUTICLE_ASSIGN(manifest.composition, text(root, "composition"));
  CUTICLE_ASSIGN(manifest.format, format_of(root));
  return {};
}

}  // namespace

Result<Manifest> parse_manifest(std::string_view text, const std::string& file) {
  const Result<Json> json = Json::parse(text);
  if (!json) return bad_input(fmt::format("{}: not JSON", file), "write it again with cuticle bake");
  const Node root(*json, file + ": ");
  Manifest manifest;
  CUTICLE_TRY(read_head(root, manifest));
  CUTICLE_ASSIGN(const std::vector<Node> tables, items(root, "tables", 1, 16));
  for (const Node& table : tables) {
    CUTICLE_ASSIGN(manifest.tables.emplace_back(), table_of(table));
  }
  CUTICLE_TRY(read_terms(root, manifest));
  return manifest;
}

Result<Manifest> read_manifest(const std::string& folder) {
  const std::string file = folder + "/manifest.json";
  CUTICLE_ASSIGN(const std::string text, read_text_file(file));
  return parse_manifest(text, file);
}

}  // namespace cuticle::lut
