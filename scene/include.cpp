#include "scene/include.h"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "core/file.h"
#include "core/json/position.h"

namespace cuticle::scene {

namespace {

using Steps = std::vector<std::string>;
constexpr int k_deepest = 16;
constexpr std::size_t k_max_files = 256;   ///< read for one scene
constexpr std::size_t k_max_keys = 10000;  ///< of an object that keys are looked up in: each look-up is linear

Steps longer(Steps steps, std::string step) {
  steps.push_back(std::move(step));
  return steps;
}

class Including {
 public:
  explicit Including(IncludedJson& into) : into_(into) {}

  /// A file's text as a source, and its value.
  Result<Json> parse(std::string_view json, const std::string& folder, const std::string& name) {
    into_.sources.push_back({name, folder, without_comments(json)});
    Result<Json> value = Json::parse(into_.sources.back().text);
    if (!value) return bad_input(fmt::format("{}: {}", name, value.error().message), value.error().hint);
    return value;
  }

  /// Puts what the objects of `value` include in the place of `$include`. The value is of this source, at `own` there
  /// and at `whole` in the whole.
  Result<void> expand(Json& value, std::size_t source, const Steps& own, const Steps& whole, int depth) {
    if (value.is_list())
      for (std::size_t i = 0; i < value.size(); ++i)
        CUTICLE_TRY(expand(value[i], source, longer(own, std::to_string(i)), longer(whole, std::to_string(i)), depth));
    if (!value.is_object()) return {};
    Steps keys;
    for (const auto& [key, item] : value.items()) keys.push_back(key);
    std::size_t place = 0;
    for (Json& item : value) {
      const std::string& key = keys[place++];
      if (key != k_include && (item.is_list() || item.is_object()))
        CUTICLE_TRY(expand(item, source, longer(own, key), longer(whole, key), depth));
    }
    const Json* asked = value.find(k_include);
    if (!asked) return {};
    const Json files = asked->is_list() ? *asked : Json::list({*asked});
    value.erase(k_include);
    for (const Json& file : files) CUTICLE_TRY(include(value, file, source, own, whole, depth));
    return {};
  }

 private:
  std::string place(std::size_t source, const Steps& own) const {
    const SourceText& text = into_.sources[source];
    const TextPosition at = position_of(text.text, find_in_json(text.text, longer(own, std::string(k_include))));
    return fmt::format("{}:{}:{}: $include", text.name, at.line, at.column);
  }

  Result<void> include(Json& value, const Json& file, std::size_t source, const Steps& own, const Steps& whole,
                       int depth) {
    if (!file.is_text())
      return bad_input(fmt::format("{}: expected the name of a file or a list of them, found {}", place(source, own),
                                   file.type_name()));
    if (depth == k_deepest)
      return bad_input(
          fmt::format("{}: '{}' is the {}th file within another", place(source, own), file.text(), k_deepest),
          "a file that includes itself never ends");
    if (into_.sources.size() > k_max_files)
      return bad_input(fmt::format("{}: more than {} files are included", place(source, own), k_max_files));
    const std::filesystem::path path =
        (std::filesystem::path(into_.sources[source].folder) / file.text()).lexically_normal();
    const auto text = read_text_file(path.string());
    if (!text)
      return bad_input(fmt::format("{}: {}", place(source, own), text.error().message),
                       "names are relative to the file that includes them");
    const std::size_t added = into_.sources.size();
    CUTICLE_ASSIGN(Json more, parse(*text, path.parent_path().string(), path.string()));
    if (!more.is_object())
      return bad_input(fmt::format("{}: expected an object, found {}", path.string(), more.type_name()));
    std::map<Steps, Origin> within;
    std::swap(into_.origins, within);
    CUTICLE_TRY(expand(more, added, {}, whole, depth + 1));
    std::swap(into_.origins, within);
    return merge(value, more, {added, {}}, whole, within);
  }

  /// Keys that the value does not have. `within`: origins of what the file included itself.
  Result<void> merge(Json& value, const Json& more, const Origin& from, const Steps& whole,
                     const std::map<Steps, Origin>& within) {
    if (std::max(value.size(), more.size()) > k_max_keys)
      return bad_input(fmt::format("{}: {} keys in one object that includes or is included, allowed at most {}",
                                   into_.sources[from.source].name, std::max(value.size(), more.size()), k_max_keys));
    for (const auto& [key, item] : more.items()) {
      const Steps here = longer(whole, key);
      const Origin there{from.source, longer(from.steps, key)};
      const Json* mine = value.find(key);
      if (mine && mine->is_object() && item.is_object()) {
        CUTICLE_TRY(merge(value[key], item, there, here, within));
      } else if (!mine) {
        value[key] = item;
        into_.origins.emplace(here, there);
        for (const auto& [steps, origin] : within)
          if (steps.size() >= here.size() && std::equal(here.begin(), here.end(), steps.begin()))
            into_.origins.insert_or_assign(steps, origin);
      }
    }
    return {};
  }

  IncludedJson& into_;
};

}  // namespace

Origin IncludedJson::origin_of(const Steps& steps) const {
  for (std::size_t length = steps.size(); length > 0; --length) {
    const auto found = origins.find(Steps(steps.begin(), steps.begin() + std::ptrdiff_t(length)));
    if (found == origins.end()) continue;
    Origin origin = found->second;
    origin.steps.insert(origin.steps.end(), steps.begin() + std::ptrdiff_t(length), steps.end());
    return origin;
  }
  return {0, steps};
}

Result<IncludedJson> read_with_includes(std::string_view json, const std::string& folder, const std::string& where) {
  IncludedJson made;
  Including including(made);
  CUTICLE_ASSIGN(made.value, including.parse(json, folder, where));
  CUTICLE_TRY(including.expand(made.value, 0, {}, {}, 0));
  return made;
}

}  // namespace cuticle::scene
