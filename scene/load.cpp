// Reads a checked scene file into a Scene. What `check` has refused cannot appear here.
#include <filesystem>
#include <numbers>

#include <fmt/core.h>
#include <algorithm>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "core/registry/read_json.h"
#include "scene/reader.h"
#include "scene/specification.h"

namespace cuticle::scene {

namespace {

const registry::Entry& entry_of(std::span<const registry::Entry* const> entries, std::string_view name) {
  return **std::ranges::find(entries, name, &registry::Entry::name);
}

registry::ParameterValues values_of(registry::ParameterTable table, const Json& json) {
  return registry::values_from_object(table, json, "").value();
}

Block block_of(std::span<const registry::Entry* const> entries, const Json& json) {
  const auto [name, values] = json.items().front();
  return {name, values_of(entry_of(entries, name).parameters, values)};
}

std::map<std::string, registry::ParameterValues, std::less<>> blocks_of(std::span<const registry::Entry* const> entries,
                                                                        const Json& json) {
  std::map<std::string, registry::ParameterValues, std::less<>> blocks;
  for (const auto& [name, values] : json.items()) blocks[name] = values_of(entry_of(entries, name).parameters, values);
  return blocks;
}

strands::FollowHairs read_follow_hairs(const Reader& reader) {
  strands::FollowHairs hairs;
  int per_guide = 0;
  reader.get("per_guide", per_guide);
  hairs.per_guide = std::size_t(per_guide);
  reader.get("reach_m", hairs.reach);
  reader.get("tip_separation", hairs.tip_separation);
  return hairs;
}

Result<void> read_groom(const Reader& reader, Scene& scene) {
  CUTICLE_ASSIGN(scene.groom.file, reader.file("file", "groom.file"));
  reader.get("metres_per_unit", scene.groom.metres_per_unit);
  reader.get("radius_m", scene.groom.radius);
  reader.get("interpolate", scene.groom.interpolate);
  reader.get("segment_parts", scene.groom.segment_parts);
  reader.get("thickness_spread", scene.groom.thickness_spread);
  if (reader.has("follow_hairs")) scene.groom.follow_hairs = read_follow_hairs(reader.child("follow_hairs"));
  if (reader.has("taper")) scene.groom.taper = reader.value["taper"].number();
  if (scene.groom.interpolate && scene.groom.file.empty())
    return bad_input(fmt::format("{}: groom.interpolate without groom.file", reader.where),
                     "grown hair is drawn between control hairs already");
  scene.groom.grow = registry::from_values<strands::Style>(
      values_of(registry::table_of<strands::Style>(), reader.child("grow").value));
  CUTICLE_ASSIGN(const std::string specification, reader.file("specification", "groom.specification"));
  if (int(reader.has("file")) + int(reader.has("grow")) + int(reader.has("specification")) > 1)
    return bad_input(fmt::format("{}: groom has more than one of 'file', 'grow' and 'specification'", reader.where),
                     "keep one of them");
  if (specification.empty()) return {};
  CUTICLE_ASSIGN(scene.groom.specification, strands::load_specification(specification));
  scene.strand_vertices = scene.groom.specification->strands.vertices;
  return {};
}

Result<void> read_head(const Reader& root, Scene& scene) {
  const Reader reader = root.child("head");
  scene.head.present = scene.groom.file.empty() || root.has("head");
  reader.get("present", scene.head.present);
  reader.get("fit", scene.head.fit);
  reader.get("bust", scene.head.bust);
  reader.get("metres_per_unit", scene.head.metres_per_unit);
  bool or_procedural = false;
  reader.get("or_procedural", or_procedural);
  auto mesh = reader.file("mesh", "head.mesh");
  if (!mesh && or_procedural) {
    scene.notes.push_back(mesh.error().message + "; the procedural head is used");
    return {};
  }
  CUTICLE_ASSIGN(scene.head.mesh, std::move(mesh));
  return {};
}

Result<void> read_motion(const Reader& root, Scene& scene) {
  if (!root.has("motion")) return {};
  const Reader reader = root.child("motion");
  MotionSource motion;
  CUTICLE_ASSIGN(motion.bvh, reader.file("bvh", "motion.bvh"));
  reader.get("joint", motion.joint);
  reader.get("start_time_s", motion.start_time);
  reader.get("amplitude", motion.amplitude);
  reader.get("metres_per_unit", motion.metres_per_unit);
  scene.motion = motion;
  return {};
}

/// What a character takes the place of, or cannot have yet.
Result<void> check_character(const Reader& root) {
  for (const char* key : {"motion", "fins"})
    if (root.has(key))
      return bad_input(fmt::format("{}: a scene with 'character' has no '{}'", root.where, key),
                       "hair follows the character's skin; leave one of them out");
  for (const auto& [block, key] : {std::pair{"head", "mesh"}, {"colliders", "head"}})
    if (root.child(block).has(key))
      return bad_input(fmt::format("{}: a scene with 'character' has no '{}.{}'", root.where, block, key),
                       "leave one of them out");
  return {};
}

Result<void> read_character(const Reader& root, Scene& scene) {
  if (!root.has("character")) return {};
  CUTICLE_TRY(check_character(root));
  const Reader reader = root.child("character");
  CharacterSource character;
  CUTICLE_ASSIGN(character.file, reader.file("file", "character.file"));
  reader.get("clip", character.clip);
  reader.get("start_time_s", character.start_time);
  std::string skinning = "linear_blend";
  reader.get("skinning", skinning);
  character.dual_quaternions = skinning == "dual_quaternion";
  CUTICLE_ASSIGN(const std::string convention, reader.file("convention", "character.convention"));
  if (!convention.empty()) {
    CUTICLE_ASSIGN(character.convention, strands::read_convention(convention));
  }
  scene.character = std::move(character);
  scene.head.present = true;
  root.child("head").get("present", scene.head.present);
  return {};
}

/// The named entry with its defaults, or the first one registered.
Block default_block(std::span<const registry::Entry* const> entries, std::string_view name) {
  const auto found = std::ranges::find(entries, name, &registry::Entry::name);
  if (entries.empty()) return {};
  const registry::Entry& entry = found == entries.end() ? *entries.front() : **found;
  return {std::string(entry.name), registry::default_values(entry.parameters)};
}

void read_material(const Reader& reader, const Catalogue& catalogue, Scene& scene) {
  scene.material.model = reader.has("model") ? block_of(catalogue.models, reader.value["model"])
                                             : default_block(catalogue.models, "marschner");
  reader.get("evaluate", scene.material.evaluate);
  reader.get("layout", scene.material.layout);
  reader.get("lut_size", scene.material.lut_size);
}

void read_simulation(const Reader& root, const Catalogue& catalogue, Scene& scene) {
  if (!root.has("simulation")) return;
  const Reader reader = root.child("simulation");
  scene.simulation.solver = block_of(catalogue.solvers, reader.value["solver"]);
  scene.simulation.effects = blocks_of(catalogue.effects, reader.child("effects").value);
  reader.get("settle_time_s", scene.simulation.settle_time);
  reader.get("solve_on", scene.simulation.solve_on);
}

Result<void> read_fins(const Reader& root, Scene& scene) {
  if (!root.has("fins")) return {};
  const Reader reader = root.child("fins");
  FinSource fins;
  CUTICLE_ASSIGN(fins.mesh, reader.file("mesh", "fins.mesh"));
  CUTICLE_ASSIGN(fins.weights, reader.file("weights", "fins.weights"));
  reader.get("metres_per_unit", fins.metres_per_unit);
  scene.fins = std::move(fins);
  return {};
}

void read_budgets(const Reader& root, Scene& scene) {
  if (!root.has("budgets")) return;
  const Reader reader = root.child("budgets"), error = reader.child("error");
  Budgets& budgets = scene.budgets.emplace();
  reader.get("frame_ms", budgets.frame_ms);
  reader.get("memory_mb", budgets.memory_mb);
  error.get("shadow", budgets.shadow);
  error.get("shading", budgets.shading);
  error.get("coverage", budgets.coverage);
  error.get("motion", budgets.motion);
}

void read_floor(const Reader& root, Scene& scene) {
  if (!root.has("floor")) return;
  const Reader reader = root.child("floor");
  scene.floor.emplace();
  reader.get("height_m", scene.floor->height);
  reader.get("size_m", scene.floor->size);
  reader.get("albedo", scene.floor->albedo);
}

/// Some shadow methods take distant lights alone, and say so by demanding them.
Result<void> check_point_lights(const Reader& root, const registry::Entry& method, const Scene& scene) {
  const bool has_point_light =
      std::ranges::any_of(scene.lights, [](const Light& light) { return light.point_light.has_value(); });
  if (!has_point_light || std::ranges::find(method.demands, "distant_lights") == method.demands.end()) return {};
  return bad_input(fmt::format("{}: shadow.method: '{}' takes distant lights alone; the scene has point lights",
                               root.where, method.name),
                   "deep_opacity or shadow_map");
}

Result<void> read_shadow(const Reader& root, const Catalogue& catalogue, Scene& scene) {
  if (!root.has("shadow")) return {};
  const Reader reader = root.child("shadow");
  scene.shadow = block_of(catalogue.methods, reader.value["method"]);
  CUTICLE_TRY(check_point_lights(root, entry_of(catalogue.methods, scene.shadow->name), scene));
  if (reader.has("fibre_alpha")) reader.get_rgb("fibre_alpha", scene.fibre_alpha.emplace(1));
  reader.get("caster_share", scene.caster_share);
  return {};
}

/// A file's strands have counts of their own.
void note_unused_counts(const Reader& root, Scene& scene) {
  if (!draws_as_given(scene)) {
    if (scene.groom.segment_parts > 1)
      scene.notes.push_back(
          fmt::format("{}: groom.segment_parts is not used: drawn strands are made between control "
                      "hairs, with strand_vertices each",
                      root.where));
    return;
  }
  for (const char* key : {"strand_count", "strand_vertices"})
    if (root.has(key))
      scene.notes.push_back(
          fmt::format("{}: {} is not used: the strands of groom.file are drawn as they are; with "
                      "\"interpolate\": true in groom strands are made between them",
                      root.where, key));
}

void read_counts(const Reader& root, const Catalogue& catalogue, Scene& scene) {
  root.get("name", scene.name);
  root.get("strand_count", scene.strand_count);
  root.get("strand_vertices", scene.strand_vertices);
  root.get("fibre_count", scene.fibre_count);
  root.get("frames_per_second", scene.frames_per_second);
  const Reader outputs = root.child("outputs");
  outputs.get("color", scene.outputs.color);
  outputs.get("aovs", scene.outputs.aovs);
  outputs.get("deep", scene.outputs.deep);
  outputs.get("cryptomatte", scene.outputs.cryptomatte);
  outputs.get("exposure_stops", scene.outputs.exposure_stops);
  root.child("render").get("method", scene.render_method);
  scene.passes = blocks_of(catalogue.passes, root.child("passes").value);
  note_unused_counts(root, scene);
}

Result<Scene> read_scene(const Reader& root, const Catalogue& catalogue) {
  Scene scene;
  CUTICLE_TRY(read_groom(root.child("groom"), scene));
  CUTICLE_TRY(read_head(root, scene));
  CUTICLE_TRY(read_motion(root, scene));
  CUTICLE_TRY(read_character(root, scene));
  read_material(root.child("material"), catalogue, scene);
  read_simulation(root, catalogue, scene);
  CUTICLE_TRY(read_colliders(root.child("colliders"), scene));
  CUTICLE_TRY(read_fins(root, scene));
  read_floor(root, scene);
  read_budgets(root, scene);
  CUTICLE_TRY(read_lights(root, scene));
  CUTICLE_TRY(read_shadow(root, catalogue, scene));
  CUTICLE_TRY(read_camera(root.child("camera"), scene));
  read_counts(root, catalogue, scene);
  return scene;
}

std::string folder_of(const std::string& path) {
  std::error_code code;
  return std::filesystem::absolute(path, code).parent_path().string();
}

}  // namespace

Result<Scene> parse_scene(std::string_view json, const std::string& folder, const std::string& where,
                          const Catalogue& catalogue) {
  CUTICLE_ASSIGN(const CheckedJson checked, parse_checked(specification(catalogue), json, folder, where));
  CUTICLE_ASSIGN(Scene scene, read_scene({checked.value, where, folder}, catalogue));
  scene.notes.insert(scene.notes.begin(), checked.notes.begin(), checked.notes.end());
  return scene;
}

Result<Scene> load_scene(const std::string& path, const Catalogue& catalogue) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  return parse_scene(text, folder_of(path), path, catalogue);
}

std::vector<Error> check_scene(const std::string& path, const Catalogue& catalogue) {
  constexpr std::size_t k_most = 50;
  const auto text = read_text_file(path);
  if (!text) return {text.error()};
  std::vector<Error> errors = complaints_about(specification(catalogue), *text, folder_of(path), path, k_most);
  if (!errors.empty()) return errors;
  if (const auto scene = parse_scene(*text, folder_of(path), path, catalogue); !scene) errors.push_back(scene.error());
  return errors;
}

}  // namespace cuticle::scene
