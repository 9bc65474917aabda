#include "scene/migrate.h"

#include <span>

#include <fmt/core.h>

#include "core/registry/former_names.h"

namespace cuticle::scene {

namespace {

/// A key that a format renamed: of an object of the scene (empty: of the scene itself), to a key of the scene or,
/// `within`, of the same object.
struct Renamed {
  std::string_view object, from, to;
  bool within = false;
};
/// What leads from one format to the next; of the newest: names that it has changed and reads for one version more.
struct Migration {
  std::int64_t from;
  std::span<const Renamed> renamed;
};

/// Format 0, before the first release, kept the counts of drawn strands in an object of their own.
constexpr Renamed k_from_0[] = {{"strands", "count", "strand_count"}, {"strands", "vertices", "strand_vertices"}};
constexpr Renamed k_in_1[] = {{"", "lamps", "point_lights"}};
constexpr Migration k_migrations[] = {{0, k_from_0}, {1, k_in_1}};

void rename(Json& scene, const Renamed& renamed, std::vector<std::string>& notes) {
  const Json* object = renamed.object.empty() ? &scene : scene.find(renamed.object);
  const Json* value = object ? object->find(renamed.from) : nullptr;
  if (!value || (renamed.within ? object : &scene)->contains(renamed.to)) return;
  const Json moved = *value;
  Json& holder = renamed.object.empty() ? scene : scene[renamed.object];
  holder.erase(renamed.from);
  if (renamed.within) {
    holder[renamed.to] = moved;
  } else {
    if (!renamed.object.empty() && holder.empty()) scene.erase(renamed.object);
    scene[renamed.to] = moved;
  }
  notes.push_back(fmt::format("'{}{}{}' is called '{}' now", renamed.object, renamed.object.empty() ? "" : ".",
                              renamed.from, renamed.to));
}

/// A way of drawing that was called otherwise, and the parameters of its pass.
void rename_method(Json& scene, std::vector<std::string>& notes) {
  constexpr std::string_view k_key = "render.method";
  std::vector<std::string> former;
  if (const Json* const passes = scene.find("passes"); passes && passes->is_object())
    for (const auto& [name, values] : passes->items())
      if (registry::current_name(k_key, name) != name) former.push_back(name);
  for (const std::string& name : former)
    rename(scene, {"passes", name, registry::current_name(k_key, name), true}, notes);
  const Json* const render = scene.find("render");
  const Json* const method = render ? render->find("method") : nullptr;
  if (!method || !method->is_text()) return;
  const std::string name = method->text();
  const std::string_view now = registry::current_name(k_key, name);
  if (now == name) return;
  scene["render"]["method"] = Json(std::string(now));
  notes.push_back(fmt::format("'{}': '{}' is called '{}' now", k_key, name, now));
}

}  // namespace

std::vector<std::string> migrate(Json& scene) {
  const Json* const version = scene.find("schema_version");
  if (!version || !version->is_whole() || version->whole() > k_schema_version) return {};
  const std::int64_t given = version->whole();
  if (given < k_migrations[0].from) return {};
  std::vector<std::string> notes;
  for (const Migration& migration : k_migrations)
    if (migration.from >= given)
      for (const Renamed& renamed : migration.renamed) rename(scene, renamed, notes);
  rename_method(scene, notes);
  if (given == k_schema_version) return notes;
  scene["schema_version"] = Json(k_schema_version);
  notes.insert(notes.begin(),
               fmt::format("the scene is of format {}; it is read as format {}", given, k_schema_version));
  return notes;
}

}  // namespace cuticle::scene
