#include "plan/strand_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "plan/fins.h"
#include "plan/plan.h"
#include "sim/colliders/distance_field.h"
#include "strands/binding/binding.h"
#include "strands/formats/formats.h"
#include "strands/growing/grow.h"
#include "strands/lod/lod.h"
#include "strands/refine.h"
#include "strands/growing/root_rules.glslh"

namespace cuticle::plan {

namespace {

constexpr std::uint64_t k_root_seed = 20050401;

std::vector<glm::vec3> roots_of(const strands::Groom& groom) {
  std::vector<glm::vec3> roots;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    if (groom.strand_size(s) > 0) roots.push_back(groom.strand(s)[0]);
  return roots;
}

/// What every strand's own hair is: itself.
void draw_each_strand(StrandSet& set) {
  for (const strands::Root& root : strands::identity_roots(set.control.strand_count())) {
    set.hairs.push_back({root.triangle, root.triangle, root.triangle});
    set.weights.push_back(root.weights);
  }
}

void take_head(const scene::Scene& scene, strands::Head head, StrandSet& set) {
  if (!set.character) set.scalp = std::move(head.scalp);
  if (scene.head.present) set.head = set.character ? set.character->mesh : std::move(head.mesh);
  if (scene.head_colliders) set.colliders = std::move(head.colliders);
}

/// What hair grows on: the procedural head, or all of a character's skin.
Result<strands::Head> growth_mesh(const scene::Scene& scene, StrandSet& set) {
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
  } else {
    CUTICLE_ASSIGN(grown, strands::grow(specification));
  }
  set.control = std::move(grown.drawn);
  draw_each_strand(set);
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
  if (!scene.head.mesh.empty())
    return bad_input("head.mesh: hair is grown on the procedural head only", "give groom.file, or leave head.mesh out");
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

/// The two other roots nearest to root `own`.
std::array<std::uint32_t, 2> nearest_two(std::span<const glm::vec3> roots, std::uint32_t own) {
  std::array<std::uint32_t, 2> found{own, own};
  std::array<float, 2> distances;
  distances.fill(std::numeric_limits<float>::max());
  for (std::uint32_t other = 0; other < roots.size(); ++other) {
    const glm::vec3 apart = roots[other] - roots[own];
    const float distance = glm::dot(apart, apart);
    if (other == own || distance >= distances[1]) continue;
    found[1] = other;
    distances[1] = distance;
    if (distances[1] < distances[0]) std::swap(found[0], found[1]), std::swap(distances[0], distances[1]);
  }
  return found;
}

/// Barycentric weights of follower k: two additive recurrences that are even together (2^32 over x and x^2 for
/// x^3 = x + 1), folded into the triangle.
glm::vec3 follower_weights(std::uint32_t k) {
  const glm::vec2 place = strands::folded<float>(strands::recurrence<float>(k, 3242174889u, 0),
                                                 strands::recurrence<float>(k, 2447445414u, 0));
  return {1 - place.x - place.y, place.x, place.y};
}

void add_followers(std::size_t wanted, StrandSet& set) {
  const std::vector<glm::vec3> roots = roots_of(set.control);
  const std::size_t own = set.hairs.size();
  std::vector<std::array<std::uint32_t, 2>> near;
  for (std::size_t k = own; k < wanted; ++k) {
    const auto leader = std::uint32_t((k - own) % own);
    if (near.size() <= leader) near.push_back(nearest_two(roots, leader));
    set.hairs.push_back({leader, near[leader][0], near[leader][1]});
    set.weights.push_back(follower_weights(std::uint32_t(k - own + 1)));
  }
}

/// Whether a prefix of the strands may stand for all: for the eye (a pass's level of detail) or for the light.
bool may_use_a_prefix(const scene::Scene& scene) {
  return scene.caster_share < 1 || std::ranges::any_of(scene.passes, [](const auto& pass) {
           return pass.second.all().contains("full_px") && pass.second.real("full_px") > 0;
         });
}

/// F10: a file's strands stand in an order of its own; grown ones are in one of chance already.
void put_in_random_order(StrandSet& set) {
  StrandSet in_order;
  for (std::uint32_t strand : strands::random_order(set.hairs.size(), k_root_seed)) {
    in_order.hairs.push_back(set.hairs[strand]);
    in_order.weights.push_back(set.weights[strand]);
  }
  set.hairs = std::move(in_order.hairs);
  set.weights = std::move(in_order.weights);
}

Result<void> read(const scene::Scene& scene, StrandSet& set) {
  CUTICLE_ASSIGN(strands::GroomFile file,
                 strands::read_groom(scene.groom.file, {scene.groom.metres_per_unit, scene.groom.radius}));
  set.control = std::move(file.groom);
  set.notes = std::move(file.notes);
  draw_each_strand(set);
  const std::vector<glm::vec3> roots = roots_of(set.control);
  if (roots.size() != set.control.strand_count())
    return bad_input(fmt::format("{}: a strand has no vertex", scene.groom.file));
  for (const glm::vec3& root : roots) set.pivot += glm::dvec3(root) / double(roots.size());
  add_followers(std::size_t(scene.strand_count), set);
  if (may_use_a_prefix(scene)) put_in_random_order(set);
  if (scene.character || (scene.head.present && scene.head.mesh.empty())) {
    CUTICLE_ASSIGN(strands::Head head, growth_mesh(scene, set));
    if (scene.head.present) set.head = std::move(head.mesh);
  }
  if (!scene.head_colliders) return {};
  CUTICLE_ASSIGN(Sphere sphere, fit_sphere(roots));
  sphere.radius *= 0.97;  // below the roots, so that hair starts outside
  set.colliders.push_back(sphere);
  return {};
}

double fibre_radius(const scene::Scene& scene, const strands::Groom& groom) {
  if (scene.groom.radius > 0) return scene.groom.radius;
  return double(groom.radii.empty() || !(groom.radii[0] > 0) ? strands::k_default_radius : groom.radii[0]);
}

/// A drawn strand shades, covers and shadows for several fibres side by side; past a millimetre it would look like one
/// itself.
double drawn_radius(const scene::Scene& scene, const StrandSet& set) {
  constexpr double k_widest = 5e-4;
  const double fibre = fibre_radius(scene, set.control),
               stands_for = scene.fibre_count / double(std::max<std::size_t>(1, set.hairs.size()));
  return std::max(fibre, std::min(k_widest, fibre * stands_for));
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

Result<void> limit(const scene::Scene& scene, const StrandSet& set) {
  const double vertices = double(set.hairs.size()) * scene.strand_vertices;
  if (vertices < 4e9 / 16) return {};
  return bad_input(fmt::format("strand_count = {} with strand_vertices = {} makes {} vertices; allowed: 0 .. 250000000",
                               set.hairs.size(), scene.strand_vertices, vertices));
}

}  // namespace

Result<Sphere> fit_sphere(std::span<const glm::vec3> points) {
  // |p|^2 = 2 c.p + (r^2 - |c|^2): linear in c and the last term. Solved about the mean, for accuracy.
  glm::dvec3 mean{0};
  for (const glm::vec3& point : points) mean += glm::dvec3(point) / double(points.size());
  glm::dmat4 matrix{0};
  glm::dvec4 right{0};
  for (const glm::vec3& point : points) {
    const glm::dvec3 p = glm::dvec3(point) - mean;
    const glm::dvec4 row(2.0 * p, 1);
    matrix += glm::outerProduct(row, row);
    right += row * glm::dot(p, p);
  }
  const glm::dvec4 solution = glm::inverse(matrix) * right;
  const double squared = solution.w + glm::dot(glm::dvec3(solution), glm::dvec3(solution));
  if (points.size() < 4 || !std::isfinite(squared) || !(squared > 0))
    return bad_input("colliders.head: no sphere can be fitted to the roots", "give colliders.spheres");
  return Sphere{glm::dvec3(solution) + mean, std::sqrt(squared)};
}

Result<StrandSet> build_strand_set(const scene::Scene& scene) {
  StrandSet set;
  if (scene.groom.file.empty())
    CUTICLE_TRY(grow(scene, set));
  else
    CUTICLE_TRY(read(scene, set));
  if (set.character) CUTICLE_TRY(bind_to_character(set));
  set.radius = float(drawn_radius(scene, set));
  if (scene.head.present && !scene.head.mesh.empty()) {
    CUTICLE_ASSIGN(set.head, strands::read_obj(scene.head.mesh, scene.head.metres_per_unit));
  }
  if (scene.fins) CUTICLE_TRY(read_fins(*scene.fins, set));
  set.colliders.insert(set.colliders.end(), scene.colliders.begin(), scene.colliders.end());
  set.boxes = scene.boxes;
  CUTICLE_TRY(add_baked_and_moving(scene, set));
  CUTICLE_TRY(limit(scene, set));
  return set;
}

registry::FrameShape shape_of(const scene::Scene& scene, const StrandSet& set) {
  registry::FrameShape shape;
  shape.control_strands = std::uint32_t(set.control.strand_count());
  shape.control_vertices = std::uint32_t(set.control.vertex_count());
  shape.strands = std::uint32_t(set.hairs.size());
  shape.vertices = shape.strands * std::uint32_t(scene.strand_vertices);
  shape.segments = shape.strands * std::uint32_t(scene.strand_vertices - 1);
  shape.lights = std::uint32_t(scene.lights.size());
  if (!scene.simulation.solver) return shape;
  const auto solver = sim::find_effect(scene.simulation.solver->name);
  if (solver && (*solver)->substeps)
    shape.substeps = (*solver)->substeps(scene.simulation.solver->values, 1 / scene.frames_per_second);
  return shape;
}

}  // namespace cuticle::plan
