#include "plan/strand_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "plan/file_strands.h"
#include "plan/fins.h"
#include "plan/plan.h"
#include "plan/strand_order.h"
#include "sim/colliders/distance_field.h"
#include "strands/binding/binding.h"
#include "strands/formats/formats.h"
#include "strands/groom.h"
#include "strands/growing/bust.h"
#include "strands/growing/grow.h"
#include "strands/growing/mesh_head.h"
#include "strands/refine.h"

namespace cuticle::plan {

namespace {

constexpr std::uint64_t k_root_seed = 20050401;

void take_head(const scene::Scene& scene, strands::Head head, StrandSet& set) {
  if (!set.character) set.scalp = std::move(head.scalp);
  if (scene.head.present) set.head = set.character ? set.character->mesh : std::move(head.mesh);
  if (scene.head.present && scene.head.bust && scene.head.mesh.empty() && !set.character) strands::add_bust(set.head);
  if (scene.head_colliders) set.colliders = std::move(head.colliders);
}

Result<strands::Head> head_of_file(const scene::Scene& scene, int scalp_vertices = 300) {
  CUTICLE_ASSIGN(strands::Mesh mesh, strands::read_obj(scene.head.mesh, scene.head.metres_per_unit));
  return strands::head_of_mesh(std::move(mesh), scalp_vertices);
}

/// What hair grows on: the procedural head, or all of a character's skin.
Result<strands::Head> growth_mesh(const scene::Scene& scene, StrandSet& set) {
  if (!scene.character && !scene.head.mesh.empty()) return head_of_file(scene);
  if (!scene.character) return strands::make_head();
  CUTICLE_ASSIGN(strands::Character character,
                 strands::read_character(scene.character->file, scene.character->convention));
  for (const std::string& note : character.report.notes) set.notes.push_back(scene.character->file + ": " + note);
  set.character = std::make_shared<const strands::Character>(std::move(character));
  return strands::Head{.mesh = set.character->mesh, .scalp = set.character->mesh, .colliders = {}};
}

/// Hair is planted on vertices and combed past them: on a character of few triangles it would cut through the edges.
strands::Head hairy(const strands::Head& body) {
  constexpr double k_edges_along_diagonal = 50;
  strands::Groom points;
  points.positions = body.mesh.positions;
  const strands::Bounds bounds = strands::bounds(points);
  const double diagonal = double(glm::distance(bounds.lower, bounds.upper));
  if (!(diagonal > 0)) return body;
  const strands::Mesh fine = strands::refined(body.mesh, diagonal / k_edges_along_diagonal);
  return {.mesh = fine, .scalp = fine, .colliders = {}};
}

Result<void> grow_specified(const scene::Scene& scene, StrandSet& set) {
  const strands::GroomingSpecification& specification = *scene.groom.specification;
  strands::Grown grown;
  if (scene.character) {
    CUTICLE_ASSIGN(const strands::Head body, growth_mesh(scene, set));
    CUTICLE_ASSIGN(grown, strands::grow(specification, hairy(body)));
  } else if (!scene.head.mesh.empty()) {
    CUTICLE_ASSIGN(strands::Head head, head_of_file(scene, specification.strands.control_hairs));
    CUTICLE_ASSIGN(grown, strands::grow(specification, std::move(head)));
  } else {
    CUTICLE_ASSIGN(grown, strands::grow(specification));
  }
  set.control = std::move(grown.drawn);
  draw_each_strand(set);
  if (scene.groom.follow_hairs) place_strands(scene, {&*scene.groom.follow_hairs, 1}, false, set);
  take_head(scene, std::move(grown.head), set);
  return {};
}

Result<void> bind_to_character(StrandSet& set) {
  constexpr double k_far = 0.005;
  CUTICLE_ASSIGN(strands::Binding binding, strands::bind_roots(set.control, set.character->mesh, k_far));
  strands::move_roots_onto(set.control, set.character->mesh, binding.roots);
  set.control_roots = std::move(binding.roots);
  if (binding.report.far_strands > 0)
    set.notes.push_back(
        fmt::format("{} of {} roots lay more than {} m from the character's mesh, at most {:.3g} m: moved onto it",
                    binding.report.far_strands, set.control.strand_count(), k_far, binding.report.distance.greatest));
  return {};
}

Result<void> grow(const scene::Scene& scene, StrandSet& set) {
  if (scene.groom.specification) return grow_specified(scene, set);
  CUTICLE_ASSIGN(strands::Head head, growth_mesh(scene, set));
  if (set.character) head = hairy(head);
  CUTICLE_ASSIGN(set.control, strands::plant_control_hairs(head, scene.groom.grow));
  for (const strands::Root& root : strands::scatter_roots(head.scalp, std::size_t(scene.strand_count), k_root_seed)) {
    set.hairs.push_back(head.scalp.triangles[root.triangle]);
    set.weights.push_back(root.weights);
  }
  take_head(scene, std::move(head), set);
  return {};
}

/// The head or the character under a file's strands.
Result<void> stand_file_on(const scene::Scene& scene, StrandSet& set) {
  const bool as_it_is = scene.head.present && scene.head.mesh.empty() && !scene.head.fit;
  if (!scene.character && !as_it_is) return {};
  CUTICLE_ASSIGN(strands::Head head, growth_mesh(scene, set));
  if (scene.head.present) set.head = std::move(head.mesh);
  return {};
}

Result<strands::Mesh> read_collider(const scene::MeshCollider& source) {
  if (source.file.ends_with(".obj")) return strands::read_obj(source.file, source.metres_per_unit);
  CUTICLE_ASSIGN(strands::Character character, strands::read_character(source.file));
  return std::move(character.mesh);
}

Result<sim::FieldPointer> bake(const scene::MeshCollider& source, std::vector<std::string>& notes) {
  CUTICLE_ASSIGN(const strands::Mesh mesh, read_collider(source));
  CUTICLE_ASSIGN(sim::DistanceField field, sim::bake_distance_field(mesh, source.spacing, source.file));
  notes.push_back(fmt::format("collider {}: {} x {} x {} nodes, the surface within {:.2g} mm",
                              std::filesystem::path(source.file).filename().string(), field.cells.x + 1,
                              field.cells.y + 1, field.cells.z + 1, 1000 * field.error));
  return sim::FieldPointer(std::make_shared<const sim::DistanceField>(std::move(field)));
}

/// Only those that something collides with.
Result<void> add_baked_and_moving(const scene::Scene& scene, StrandSet& set) {
  if (!scene.simulation.solver) return {};
  for (const scene::MeshCollider& source : scene.mesh_colliders) {
    CUTICLE_ASSIGN(set.fields.emplace_back(), bake(source, set.notes));
  }
  for (const scene::MovingShape& moving : scene.moving_colliders) {
    sim::MovingCollider& collider = set.moving.emplace_back(
        sim::MovingCollider{.shape = Sphere{}, .motion = moving.motion, .on_head = moving.on_head});
    if (const auto* sphere = std::get_if<Sphere>(&moving.shape)) collider.shape = *sphere;
    if (const auto* box = std::get_if<RoundedBox>(&moving.shape)) collider.shape = *box;
    if (const auto* mesh = std::get_if<scene::MeshCollider>(&moving.shape)) {
      CUTICLE_ASSIGN(collider.shape, bake(*mesh, set.notes));
    }
  }
  return {};
}

double mean_segment(const strands::Groom& control) {
  double length = 0;
  for (std::size_t s = 0; s < control.strand_count(); ++s) length += strands::strand_length(control, s);
  const std::size_t segments = control.vertex_count() - control.strand_count();
  return length / double(std::max<std::size_t>(segments, 1));
}

constexpr double k_long_segment = 0.01;  // metres

/// Parts of long segments that are 4 mm, at most 8. Ours: chosen by direct light of grooms with segments of 16 and 37
/// mm (docs/shadows.md).
std::uint32_t chosen_parts(const scene::Scene& scene, const StrandSet& set, double segment) {
  constexpr double k_wanted = 0.004, k_most = 8;                     // metres
  constexpr double k_max_cut_vertices = 4e6, k_max_scattered = 8e6;  // of all strands; times lights
  if (segment <= k_long_segment || scene.render_method == "lines") return 1;
  const double vertices = double(set.placed.size()) * strands::longest_strand(set.control);
  const double lights = scene.material.evaluate == "direct" ? double(scene.lights.size()) : 0;
  const double room = std::min(k_max_cut_vertices, k_max_scattered / std::max(1.0, lights)) / vertices;
  return std::uint32_t(std::max(1.0, std::min({std::round(segment / k_wanted), k_most, std::floor(room)})));
}

/// Light is found at the ends of parts of segments and interpolated between them.
void cut_segments(const scene::Scene& scene, StrandSet& set) {
  if (!scene::draws_as_given(scene) || scene.render_method == "reference") return;
  const double segment = mean_segment(set.control);
  const bool is_chosen = scene.groom.segment_parts == 0;
  set.segment_parts = is_chosen ? chosen_parts(scene, set, segment) : std::uint32_t(scene.groom.segment_parts);
  if (segment <= k_long_segment) return;
  std::string note = fmt::format("drawn segments are {:.2g} mm long in the mean: ", 1000 * segment);
  if (scene.render_method == "lines")
    note += "'lines' interpolates light along them; 'tiles' finds it at places between";
  else if (set.segment_parts > 1)
    note += fmt::format("light is found at {} places along each (groom.segment_parts)", set.segment_parts);
  else
    note += "light is interpolated along them (groom.segment_parts)";
  set.notes.push_back(note);
}

Result<void> limit(const scene::Scene& scene, const StrandSet& set) {
  const std::size_t strands = drawn_strands(scene, set);
  const int each = drawn_vertices(scene, set);
  const double vertices = double(strands) * each;
  if (vertices < 4e9 / 16) return {};
  if (scene::draws_as_given(scene))
    return bad_input(fmt::format("{}: {} strands in rows of the longest one's {} vertices are {} vertices; allowed: 0 "
                                 ".. 250000000",
                                 scene.groom.file, strands, each, vertices),
                     "groom.interpolate draws strands of strand_vertices each");
  return bad_input(fmt::format("strand_count = {} with strand_vertices = {} makes {} vertices; allowed: 0 .. 250000000",
                               strands, each, vertices));
}

}  // namespace

Result<StrandSet> build_strand_set(const scene::Scene& scene) {
  StrandSet set;
  set.notes = scene.notes;
  if (scene.groom.file.empty()) {
    CUTICLE_TRY(grow(scene, set));
    set.taper = float(scene.groom.taper.value_or(double(set.taper)));
    if (!scene::draws_as_given(scene)) {
      set.radius = drawn_radius(scene, set.control, set.hairs.size());
      set.fibre_width = fibre_width(scene, set.control, set.hairs.size());
      set.opacity = crossing_opacity(scene, set.control, set.hairs.size());
    }
  } else {
    CUTICLE_TRY(read_file_strands(scene, set));
    CUTICLE_TRY(stand_file_on(scene, set));
  }
  if (set.character) CUTICLE_TRY(bind_to_character(set));
  if (scene.head.present && !scene.head.mesh.empty() && !scene.groom.file.empty()) {
    CUTICLE_ASSIGN(set.head, strands::read_obj(scene.head.mesh, scene.head.metres_per_unit));
  }
  if (scene.fins) CUTICLE_TRY(read_fins(*scene.fins, set));
  set.colliders.insert(set.colliders.end(), scene.colliders.begin(), scene.colliders.end());
  set.boxes = scene.boxes;
  CUTICLE_TRY(add_baked_and_moving(scene, set));
  if (may_use_a_prefix(scene)) put_in_spread_order(set);
  cut_segments(scene, set);
  CUTICLE_TRY(limit(scene, set));
  return set;
}

std::size_t drawn_strands(const scene::Scene& scene, const StrandSet& set) {
  return scene::draws_as_given(scene) ? set.placed.size() : set.hairs.size();
}

int drawn_vertices(const scene::Scene& scene, const StrandSet& set) {
  return scene::draws_as_given(scene) ? int(strands::cut_size(strands::longest_strand(set.control), set.segment_parts))
                                      : scene.strand_vertices;
}

registry::FrameShape shape_of(const scene::Scene& scene, const StrandSet& set) {
  registry::FrameShape shape;
  shape.control_strands = std::uint32_t(set.control.strand_count());
  shape.control_vertices = std::uint32_t(set.control.vertex_count());
  const auto each = std::uint32_t(drawn_vertices(scene, set));
  shape.strands = std::uint32_t(drawn_strands(scene, set));
  shape.vertices = shape.strands * each;
  shape.segments = shape.strands * ((each - 1) / set.segment_parts);
  shape.lights = std::uint32_t(scene.lights.size());
  if (!scene.simulation.solver) return shape;
  const auto solver = sim::find_effect(scene.simulation.solver->name);
  if (solver && (*solver)->substeps)
    shape.substeps = (*solver)->substeps(scene.simulation.solver->values, 1 / scene.frames_per_second);
  return shape;
}

}  // namespace cuticle::plan
