#include "lut/target.h"

#include <algorithm>

#include <fmt/format.h>

#include "lut/snippets/snippet.h"

namespace cuticle::lut {
namespace {

Result<const Target*> find_target(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Target* target : targets()) {
    if (target->name == name) return target;
    known.push_back(target->name);
  }
  return usage_error(fmt::format("target: '{}' is not one of {}", name, fmt::join(known, ", ")));
}

}  // namespace

Result<std::vector<const Target*>> find_targets(std::string_view names) {
  std::vector<const Target*> found;
  while (!names.empty()) {
    const std::string_view name = names.substr(0, names.find(','));
    CUTICLE_ASSIGN(found.emplace_back(), find_target(name));
    names.remove_prefix(std::min(name.size() + 1, names.size()));
  }
  return found;
}

Result<std::string> engine_snippet(const Manifest& manifest, std::string_view dialect, const std::string& before) {
  CUTICLE_ASSIGN(const snippets::Dialect* found, snippets::find_dialect(dialect));
  CUTICLE_ASSIGN(const std::string text, snippets::snippet(manifest, *found));
  return before + text;
}

Result<void> check_readable(const Manifest& manifest, std::string_view target,
                            std::span<const std::string_view> formats) {
  if (std::find(formats.begin(), formats.end(), manifest.format) != formats.end()) return {};
  return usage_error(
      fmt::format("target {}: it cannot read {}; allowed: {}", target, manifest.format, fmt::join(formats, ", ")),
      fmt::format("--format {}", formats.front()));
}

std::string names_of_tables(const Manifest& manifest) {
  std::string names;
  for (std::size_t i = 0; i < manifest.tables.size(); ++i)
    names += (i == 0 ? "" : i + 1 == manifest.tables.size() ? " and " : ", ") + manifest.tables[i].file;
  return names;
}

std::string filled(std::string text, std::span<const std::pair<std::string_view, std::string>> values) {
  for (const auto& [key, value] : values) {
    const std::string mark = fmt::format("@{}@", key);
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  return text;
}

}  // namespace cuticle::lut
