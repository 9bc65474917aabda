// Walks a JSON value beside its specification and tells what is wrong.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/json/json.h"
#include "core/json/position.h"
#include "core/registry/read_json.h"
#include "core/text.h"
#include "scene/include.h"
#include "scene/migrate.h"
#include "scene/specification.h"

namespace cuticle::scene {

namespace {

/// Where a value stands: the path of keys to it, in the file and those that it includes.
struct Place {
  const IncludedJson* whole = nullptr;
  std::string path = {};
  std::vector<std::string> steps = {};

  Place at(const std::string& key) const { return child(path.empty() ? key : path + "." + key, key); }
  Place at(std::size_t index) const { return child(fmt::format("{}[{}]", path, index), std::to_string(index)); }
  Place child(std::string child_path, std::string step) const {
    Place place{whole, std::move(child_path), steps};
    place.steps.push_back(std::move(step));
    return place;
  }
  /// "scene.json:12:5: lights[0].irradiance": line and column as compilers write them.
  std::string text() const {
    const Origin origin = whole->origin_of(steps);
    const SourceText& source = whole->sources[origin.source];
    const TextPosition at = position_of(source.text, find_in_json(source.text, origin.steps));
    const std::string where = fmt::format("{}:{}:{}", source.name, at.line, at.column);
    return path.empty() ? where : where + ": " + path;
  }
  /// This place, with the line and column of one of its keys.
  std::string text_at(const std::string& key) const {
    Place place = at(key);
    place.path = path;
    return place.text();
  }
};

/// What was found wrong so far; the walk ends where so much was found.
class Complaints {
 public:
  explicit Complaints(std::size_t most) : most_(most) {}
  bool full() const { return found_.size() >= most_; }
  void add(Error error) { found_.push_back(std::move(error)); }
  std::vector<Error>& found() { return found_; }

 private:
  std::size_t most_;
  std::vector<Error> found_;
};

void check_value(const Spec& spec, const Json& value, const Place& place, Complaints& complaints);

Error wrong_type(const Place& place, std::string_view expected, const Json& value) {
  return bad_input(fmt::format("{}: expected {}, found {}", place.text(), expected, value.type_name()));
}

Error unknown_key(const Place& place, const std::string& key, std::span<const std::string_view> known) {
  const std::string near = registry::nearest_name(key, known);
  return bad_input(
      fmt::format("{}: unknown key {}; allowed: {}", place.text_at(key), in_quotes(key), fmt::join(known, ", ")),
      near.empty() ? "" : fmt::format("write '{}'", near));
}

void check_number(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  const bool whole = spec.kind == SpecKind::integer;
  if (!value.is_number()) return complaints.add(wrong_type(place, whole ? "a whole number" : "a number", value));
  const double number = value.number();
  if (whole && number != std::floor(number))
    complaints.add(bad_input(fmt::format("{} = {} is not a whole number; allowed: {} .. {}", place.text(), number,
                                         spec.minimum, spec.maximum)));
  else if (!(number >= spec.minimum && number <= spec.maximum))
    complaints.add(
        bad_input(fmt::format("{} = {} is outside {} .. {}", place.text(), number, spec.minimum, spec.maximum)));
}

void check_numbers(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  if (!value.is_list() || value.size() != std::size_t(spec.count))
    return complaints.add(bad_input(
        fmt::format("{}: expected {} numbers in {} .. {}", place.text(), spec.count, spec.minimum, spec.maximum)));
  for (std::size_t i = 0; i < value.size() && !complaints.full(); ++i)
    check_number(spec, value[i], place.at(i), complaints);
}

void check_rgb(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  if (value.is_number()) return check_number(spec, value, place, complaints);
  if (!value.is_list()) return complaints.add(wrong_type(place, "a number or [r, g, b]", value));
  check_numbers(spec, value, place, complaints);
}

void check_text(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  if (!value.is_text()) return complaints.add(wrong_type(place, "a text", value));
  const auto text = value.text();
  if (spec.choices.empty() || std::ranges::find(spec.choices, text) != spec.choices.end()) return;
  complaints.add(
      bad_input(fmt::format("{} = '{}' is not known; allowed: {}", place.text(), text, fmt::join(spec.choices, ", "))));
}

void check_parameters(registry::ParameterTable table, const Json& value, const Place& place, Complaints& complaints) {
  if (!value.is_object()) return complaints.add(wrong_type(place, "an object", value));
  for (const auto& [key, item] : value.items()) {
    if (complaints.full()) return;
    if (auto read = registry::values_from_object(table, Json{{key, item}}, place.text_at(key)); !read)
      complaints.add({ErrorKind::bad_input, read.error().message, read.error().hint});
  }
}

void check_blocks(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  if (!value.is_object()) return complaints.add(wrong_type(place, "an object of named blocks", value));
  std::vector<std::string_view> known;
  for (const registry::Entry* entry : spec.entries) known.push_back(entry->name);
  if (spec.kind == SpecKind::block && value.size() != 1)
    return complaints.add(
        bad_input(fmt::format("{}: expected exactly one of: {}", place.text(), fmt::join(known, ", "))));
  for (const auto& [key, block] : value.items()) {
    if (complaints.full()) return;
    const auto found = std::ranges::find(spec.entries, key, &registry::Entry::name);
    if (found == spec.entries.end())
      complaints.add(unknown_key(place, key, known));
    else
      check_parameters((*found)->parameters, block, place.at(key), complaints);
  }
}

void check_known_keys(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  std::vector<std::string_view> known;
  for (const Spec& child : spec.children) known.push_back(child.key);
  for (const auto& [key, unused] : value.items()) {
    if (complaints.full()) return;
    if (std::ranges::find(known, key) == known.end()) complaints.add(unknown_key(place, key, known));
  }
}

void check_object(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  if (!value.is_object()) return complaints.add(wrong_type(place, "an object", value));
  check_known_keys(spec, value, place, complaints);
  for (const Spec& child : spec.children) {
    if (complaints.full()) return;
    if (const Json* found = value.find(child.key))
      check_value(child, *found, place.at(child.key), complaints);
    else if (child.required)
      complaints.add(bad_input(fmt::format("{}: missing ({})", place.at(child.key).text(), child.summary)));
  }
}

void check_array(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  if (!value.is_list()) return complaints.add(wrong_type(place, "a list", value));
  if (double(value.size()) > spec.maximum)
    return complaints.add(
        bad_input(fmt::format("{}: {} items; allowed: 0 .. {}", place.text(), value.size(), spec.maximum)));
  for (std::size_t i = 0; i < value.size() && !complaints.full(); ++i)
    check_value(spec.children[0], value[i], place.at(i), complaints);
}

void check_value(const Spec& spec, const Json& value, const Place& place, Complaints& complaints) {
  switch (spec.kind) {
    case SpecKind::object:
      return check_object(spec, value, place, complaints);
    case SpecKind::array:
      return check_array(spec, value, place, complaints);
    case SpecKind::block:
    case SpecKind::blocks:
      return check_blocks(spec, value, place, complaints);
    case SpecKind::parameters:
      return check_parameters(spec.table, value, place, complaints);
    case SpecKind::text:
    case SpecKind::file:
      return check_text(spec, value, place, complaints);
    case SpecKind::real:
    case SpecKind::integer:
      return check_number(spec, value, place, complaints);
    case SpecKind::numbers:
      return check_numbers(spec, value, place, complaints);
    case SpecKind::rgb:
      return check_rgb(spec, value, place, complaints);
    case SpecKind::boolean:
      break;
  }
  if (!value.is_boolean()) complaints.add(wrong_type(place, "true or false", value));
}

/// Files that an included file names are relative to it.
void resolve_files(const Spec& spec, Json& value, const Place& place) {
  if (spec.kind == SpecKind::object) {
    for (const Spec& child : spec.children)
      if (value.contains(child.key)) resolve_files(child, value[child.key], place.at(child.key));
  } else if (spec.kind == SpecKind::array) {
    for (std::size_t i = 0; i < value.size(); ++i) resolve_files(spec.children[0], value[i], place.at(i));
  } else if (spec.kind == SpecKind::file && !value.text().starts_with("${")) {
    const Origin origin = place.whole->origin_of(place.steps);
    if (origin.source > 0)
      value = (std::filesystem::path(place.whole->sources[origin.source].folder) / value.text()).string();
  }
}

/// Files of a later format are not read as if they were of this one.
Result<void> check_version(const IncludedJson& whole) {
  const Json* version = whole.value.find("schema_version");
  if (!version || !version->is_whole() || version->whole() <= k_schema_version) return {};
  const Place place{&whole, "schema_version", {"schema_version"}};
  return bad_input(fmt::format("{} = {} is newer than {}, which this program reads", place.text(), version->whole(),
                               k_schema_version),
                   "take a newer Cuticle");
}

}  // namespace

Result<CheckedJson> parse_checked(const Spec& spec, std::string_view json, const std::string& folder,
                                  const std::string& where) {
  CUTICLE_ASSIGN(IncludedJson whole, read_with_includes(json, folder, where));
  CUTICLE_TRY(check_version(whole));
  std::vector<std::string> notes = migrate(whole.value);
  Complaints complaints(1);
  check_value(spec, whole.value, {&whole}, complaints);
  if (complaints.full()) return complaints.found().front();
  resolve_files(spec, whole.value, {&whole});
  return CheckedJson{std::move(whole.value), std::move(notes)};
}

std::vector<Error> complaints_about(const Spec& spec, std::string_view json, const std::string& folder,
                                    const std::string& where, std::size_t most) {
  auto whole = read_with_includes(json, folder, where);
  if (!whole) return {whole.error()};
  if (const auto version = check_version(*whole); !version) return {version.error()};
  migrate(whole->value);
  Complaints complaints(most);
  check_value(spec, whole->value, {&*whole}, complaints);
  return std::move(complaints.found());
}

}  // namespace cuticle::scene
