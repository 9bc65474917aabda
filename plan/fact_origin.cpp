#include "plan/fact_origin.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/core.h>

#include "plan/plan.h"

namespace cuticle::plan {

namespace {

constexpr std::pair<std::string_view, std::string_view> k_origins[] = {
    {"character", "character"},
    {"coloured_shadow", "shadow.fibre_alpha"},
    {"colliders", "colliders"},
    {"colliders_in_reach", "measured: places of colliders, roots and lengths of control hairs"},
    {"culled_strands", "render.method, passes.cull_strands"},
    {"distant_lights", "lights, point_lights"},
    {"drawn_on_device", "render.method"},
    {"fins", "fins"},
    {"fins_drawn", "fins"},
    {"floor", "floor"},
    {"hair_awake", "measured: strands that sleep, and what acts on them"},
    {"hair_changed", "measured: a hash of the control hairs' places"},
    {"hair_seen", "measured: the hair's box in the camera's view"},
    {"head", "head"},
    {"light", "lights, point_lights, environment"},
    {"motion", "motion"},
    {"movement", "motion, character, simulation, camera"},
    {"moving_skin", "character"},
    {"output_aovs", "outputs.aovs, passes"},
    {"output_color", "outputs.color"},
    {"output_velocity", "passes"},
    {"pixel_depth", "passes"},
    {"seen_segments", "render.method"},
    {"shaded_from_tables", "material.evaluate, render.method"},
    {"shadow_method", "shadow.method"},
    {"simulation", "simulation.solver"},
    {"solved_on_cpu", "simulation.solve_on, measured: the device"},
    {"strand_colors", "render.method"},
    {"strands", "groom"},
    {"strands_as_given", "groom"},
    {"hidden_vertices_unshaded", "render.method, material.evaluate, passes.tile_sort, passes.seen_vertices"},
    {"strands_by_sight", "render.method, passes.strands_in_sight"},
    {"strands_interpolated", "groom"},
    {"surfaces", "head, floor"},
    {"surfaces_cast", "shadow, passes.surface_shadow"},
    {"surfaces_changed", "measured: a hash of the places of head, skin and fins"},
    {"view_changed", "measured: the camera, and passes that gather frames"},
};

bool names(std::span<const registry::Entry* const> entries, std::string_view name) {
  return std::ranges::find(entries, name, &registry::Entry::name) != entries.end();
}

}  // namespace

std::string origin_of(std::string_view fact) {
  const auto found = std::ranges::find(k_origins, fact, &std::pair<std::string_view, std::string_view>::first);
  if (found != std::end(k_origins)) return std::string(found->second);
  if (fact.starts_with("drawn_by_")) return "render.method";
  if (names(catalogue().effects, fact)) return fmt::format("simulation.effects.{}", fact);
  if (names(catalogue().passes, fact)) return fmt::format("passes.{}", fact);
  return "scene";
}

}  // namespace cuticle::plan
