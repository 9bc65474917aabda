#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "plan/plan.h"
#include "render/passes/cull_strands/cull_strands.h"
#include "render/passes/seen_vertices/seen_vertices.h"
#include "render/passes/strands_in_sight/strands_in_sight.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/passes/tile_sort/tile_sort.h"
#include "shadows/channels.h"

namespace cuticle::plan {

namespace {

std::string counted(std::size_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

registry::Fact strands_fact(const scene::Scene& scene) {
  if (scene.groom.file.empty()) return {true, fmt::format("hair grown on the {}", scene.character ? "skin" : "head")};
  return {true, fmt::format("hair of {}", std::filesystem::path(scene.groom.file).filename().string())};
}

/// Whether drawn strands are those of a file, or between control hairs.
void add_ways_of_strands(const scene::Scene& scene, registry::Facts& facts) {
  const bool as_given = scene::draws_as_given(scene);
  std::string why = as_given ? "grown strands and the hairs that follow them are drawn as they are"
                             : "the hair is grown between control hairs";
  if (!scene.groom.file.empty())
    why = as_given                  ? "a file's strands are drawn as they are"
          : scene.groom.interpolate ? "the scene asks for strands between those of the file"
                                    : "hair cards are made of resampled strands";
  facts["strands_as_given"] = {as_given, why};
  facts["strands_interpolated"] = {!as_given, why};
}

registry::Fact colliders_fact(const scene::Scene& scene) {
  const bool own = scene.head_colliders;
  std::string what;
  const auto add = [&](std::size_t count, std::string_view thing) {
    if (count > 0) what += (what.empty() ? "" : ", ") + counted(count, thing);
  };
  add(scene.colliders.size(), "sphere collider");
  add(scene.boxes.size(), "capsule or box collider");
  add(scene.mesh_colliders.size(), "mesh collider");
  add(scene.moving_colliders.size(), "moving collider");
  if (what.empty()) return {own, own ? "the head collides" : "the scene has no colliders"};
  return {true, what + (own ? " and the head's" : "")};
}

registry::Fact fins_fact(const scene::Scene& scene) {
  if (!scene.fins) return {false, "the scene has no fins"};
  return {true, fmt::format("fins of {}", std::filesystem::path(scene.fins->mesh).filename().string())};
}

registry::Fact motion_fact(const scene::Scene& scene) {
  if (!scene.motion) return {false, "the head does not move"};
  return {true, fmt::format("joint '{}' moves the head", scene.motion->joint)};
}

registry::Fact head_fact(const scene::Scene& scene) {
  if (!scene.head.present) return {false, "the scene has no head"};
  return {true, scene.character ? "the character is drawn" : "the scene has a head"};
}

/// Whether channels are shadowed apart, by a method that the catalogue has.
registry::Fact opacities_fact(const scene::Scene& scene) {
  const glm::dvec3 alpha = scene.fibre_alpha.value_or(glm::dvec3(1));
  const shadows::Channels channels = shadows::different_channels(alpha);
  if (channels.count == 1) return {false, "one opacity for all channels"};
  const auto method = shadows::find_method(scene.shadow->name);
  const bool by_powers = method && shadows::root_opacity(**method, scene.shadow->values, channels);
  return {true, fmt::format("{} a light: opacity {}, {}, {} of red, green, blue",
                            by_powers ? "once, by powers," : fmt::format("{} times", channels.count), alpha.x, alpha.y,
                            alpha.z)};
}

registry::Fact shadow_fact(const scene::Scene& scene) {
  if (!scene.shadow) return {false, "the scene names no shadow method"};
  const registry::Fact apart = opacities_fact(scene);
  return {true, fmt::format("shadows by '{}'{}", scene.shadow->name, apart.holds ? ", " + apart.why : "")};
}

registry::Fact character_fact(const scene::Scene& scene) {
  if (!scene.character) return {false, "the scene has no character"};
  const std::string file = std::filesystem::path(scene.character->file).filename().string();
  return {true, scene.character->clip.empty() ? fmt::format("hair follows the skin of {}", file)
                                              : fmt::format("'{}' moves the skin of {}", scene.character->clip, file)};
}

registry::Fact asked(bool asks, std::string_view name) {
  return {asks, fmt::format("the scene {} '{}'", asks ? "asks for" : "does not ask for", name)};
}

/// Effects, and passes that demand themselves, run where the scene names them.
void add_named(const scene::Scene& scene, registry::Facts& facts) {
  for (const registry::Entry* effect : catalogue().effects)
    facts[std::string(effect->name)] = asked(scene.simulation.effects.contains(effect->name), effect->name);
  for (const registry::Entry* pass : catalogue().passes)
    if (std::ranges::find(pass->demands, pass->name) != pass->demands.end())
      facts[std::string(pass->name)] = asked(scene.passes.contains(pass->name), pass->name);
}

void add_render_method(const scene::Scene& scene, registry::Facts& facts) {
  const std::string why = fmt::format("strands are drawn by '{}'", scene.render_method);
  for (std::string_view method : scene::k_render_methods)
    facts[fmt::format("drawn_by_{}", method)] = {scene.render_method == method, why};
  const bool on_device = scene.render_method != "supersampled" && scene.render_method != "reference";
  facts["drawn_on_device"] = {on_device, why};
  const bool direct = scene.material.evaluate == "direct";
  facts["shaded_from_tables"] = {
      !direct, direct ? "the material is evaluated by its formulas" : "the material is evaluated by lookup tables"};
}

/// Whether the scene says that it does not want a pass which runs unless it is refused.
template <class Parameters>
bool is_refused(const scene::Scene& scene) {
  const auto asked = scene.passes.find(Parameters::name);
  return asked != scene.passes.end() && !registry::from_values<Parameters>(asked->second).wanted;
}

bool is_sliced(const scene::Scene& scene) {
  const auto given = scene.passes.find(render::tile_sort::Parameters::name);
  return given != scene.passes.end() && registry::from_values<render::tile_sort::Parameters>(given->second).slices > 0;
}

/// By default with every shadow method, also with `none`, which is about hair on hair alone.
registry::Fact surfaces_cast_fact(const scene::Scene& scene) {
  using Parameters = render::surface_shadow::Parameters;
  if (is_refused<Parameters>(scene)) return {false, "the scene wants no shadows between hair and surfaces"};
  if (scene.passes.contains(Parameters::name)) return asked(true, Parameters::name);
  return {scene.shadow.has_value(), scene.shadow ? "the scene has shadows" : "the scene names no shadow method"};
}

void add_culling(const scene::Scene& scene, registry::Facts& facts) {
  const bool as_primitives = scene.render_method == "lines" || scene.render_method == "quads",
             strand_by_strand = as_primitives || scene.render_method == "tiles",
             draws_all = is_refused<render::cull_strands::Parameters>(scene),
             shades_all = is_refused<render::strands_in_sight::Parameters>(scene);
  const std::string method = fmt::format("strands are drawn by '{}'", scene.render_method);
  facts["culled_strands"] = {as_primitives && !draws_all,
                             draws_all ? "the scene wants strands drawn that are not seen" : method};
  const bool shades_hidden = is_refused<render::seen_vertices::Parameters>(scene),
             by_formulas = scene.render_method == "tiles" && scene.material.evaluate == "direct",
             by_slices = is_sliced(scene);
  facts["hidden_vertices_unshaded"] = {
      by_formulas && !by_slices && !shades_hidden,
      shades_hidden ? "the scene wants vertices shaded that do not show"
      : by_slices   ? "strands are blended by slices"
      : by_formulas ? "formulas at a vertex cost more than to find out whether it shows"
                    : "shading costs less than to find out what shows, or other passes than 'tiles' draw"};
  facts["strands_by_sight"] = {strand_by_strand && !shades_all,
                               shades_all ? "the scene wants strands shaded that are out of view" : method};
}

/// Whether any two of a camera's keys differ.
bool travels(const std::vector<scene::CameraKey>& keys) {
  return std::ranges::any_of(keys, [&](const scene::CameraKey& key) {
    return key.position != keys[0].position || key.target != keys[0].target ||
           key.vertical_field_of_view != keys[0].vertical_field_of_view;
  });
}

/// What can move a pixel from one frame to the next.
registry::Fact movement_fact(const scene::Scene& scene) {
  if (scene.motion) return {true, "the head moves"};
  if (scene.character && !scene.character->clip.empty()) return {true, "the character moves"};
  if (scene.simulation.solver) return {true, "the hair is simulated"};
  const bool moves = scene.camera.turntable_degrees_per_frame != 0 || travels(scene.camera.keys);
  return {moves, moves ? "the camera moves" : "nothing moves: neither head, hair nor camera"};
}

}  // namespace

registry::Facts facts_of(const scene::Scene& scene) {
  registry::Facts facts;
  add_named(scene, facts);
  add_render_method(scene, facts);
  add_culling(scene, facts);
  facts["strands"] = strands_fact(scene);
  add_ways_of_strands(scene, facts);
  facts["light"] = {!scene.lights.empty(),
                    scene.lights.empty() ? "the scene has no light" : counted(scene.lights.size(), "light")};
  const auto point_lights =
      std::ranges::count_if(scene.lights, [](const Light& light) { return light.point_light.has_value(); });
  facts["distant_lights"] = {point_lights == 0, point_lights == 0 ? "all lights are far away"
                                                                  : counted(std::size_t(point_lights), "point light")};
  facts["shadow_method"] = shadow_fact(scene);
  facts["coloured_shadow"] = facts["shadow_method"].holds ? opacities_fact(scene) : facts["shadow_method"];
  facts["motion"] = motion_fact(scene);
  facts["simulation"] = {scene.simulation.solver.has_value(),
                         scene.simulation.solver
                             ? fmt::format("the hair is simulated by '{}'", scene.simulation.solver->name)
                             : "the hair is not simulated"};
  facts["colliders"] = colliders_fact(scene);
  facts["fins"] = fins_fact(scene);
  facts["head"] = head_fact(scene);
  facts["floor"] = {scene.floor.has_value(), scene.floor ? "the scene has a floor" : "the scene has no floor"};
  facts["surfaces_cast"] = surfaces_cast_fact(scene);
  facts["surfaces"] = facts[facts["floor"].holds ? "floor" : "head"];
  facts["character"] = character_fact(scene);
  facts["output_color"] = {scene.outputs.color, scene.outputs.color ? "a picture is wanted" : "no picture is wanted"};
  facts["movement"] = movement_fact(scene);
  facts["fins_drawn"] = facts["fins"];
  return facts;
}

}  // namespace cuticle::plan
