#include "plan/file_strands.h"

#include <algorithm>
#include <limits>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "plan/fitted_head.h"
#include "strands/formats/formats.h"
#include "strands/growing/root_rules.glslh"

namespace cuticle::plan {

namespace {

constexpr double k_max_radius = 5e-4;  // metres

double fibre_radius(const scene::Scene& scene, const strands::Groom& groom) {
  if (scene.groom.radius > 0) return scene.groom.radius;
  return double(groom.radii.empty() || !(groom.radii[0] > 0) ? strands::k_default_radius : groom.radii[0]);
}

/// How many fibres a drawn strand stands for.
double fibres_each(const scene::Scene& scene, std::size_t strands) {
  const double fibres = scene.fibre_count > 0 ? scene.fibre_count : scene::k_usual_fibre_count;
  return fibres / double(std::max<std::size_t>(1, strands));
}

std::vector<glm::vec3> roots_of(const strands::Groom& groom) {
  std::vector<glm::vec3> roots;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    if (groom.strand_size(s) > 0) roots.push_back(groom.strand(s)[0]);
  return roots;
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

/// Of a strand's length, per vertex; even where it has none.
std::vector<float> fractions_of(std::span<const glm::vec3> strand) {
  std::vector<float> fractions(strand.size(), 0.0f);
  for (std::size_t k = 1; k < strand.size(); ++k)
    fractions[k] = fractions[k - 1] + glm::distance(strand[k - 1], strand[k]);
  const float whole = fractions.back();
  for (std::size_t k = 0; k < strand.size(); ++k)
    fractions[k] = whole > 0 ? fractions[k] / whole : float(k) / float(std::max<std::size_t>(strand.size(), 2) - 1);
  return fractions;
}

/// Radii as they are drawn: as wide as the fibres that a strand stands for, thinner at the tip.
void widen_and_taper(double stands_for, double taper, strands::Groom& groom) {
  if (stands_for <= 1 && taper == 0) return;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::vector<float> fractions = fractions_of(groom.strand(s));
    for (std::size_t k = 0; k < fractions.size(); ++k) {
      float& radius = groom.radii[groom.offsets[s] + k];
      const double wide = std::max(double(radius), std::min(k_max_radius, double(radius) * stands_for));
      radius = float(wide * (1 - taper * double(fractions[k])));
    }
  }
}

/// Control hairs keep one radius; strands as they are given have those of their vertices.
void set_radii(const scene::Scene& scene, bool has_radii, StrandSet& set) {
  set.taper = float(scene.groom.taper.value_or(has_radii ? 0.0 : 0.5));
  set.radius = drawn_radius(scene, set.control, set.hairs.size());
  set.fibre_width = fibre_width(scene, set.control, set.hairs.size());
  set.opacity = crossing_opacity(scene, set.control, scene.groom.interpolate ? set.hairs.size() : set.placed.size());
  if (scene.groom.interpolate) return;
  const bool are_fibres = has_radii && scene.fibre_count == 0;
  set.fibre_width = are_fibres ? 1 : fibre_width(scene, set.control, set.placed.size());
  widen_and_taper(are_fibres ? 1 : fibres_each(scene, set.placed.size()), double(set.taper), set.control);
  if (scene::draws_as_given(scene)) set.radius = *std::ranges::max_element(set.control.radii);
}

/// What stands for the head of a groom that was made on one.
Result<void> add_head(const scene::Scene& scene, std::span<const glm::vec3> roots, StrandSet& set) {
  if (scene.head.present && scene.head.mesh.empty() && scene.head.fit) {
    Result<strands::Head> head = fitted_head(strands::make_head(), roots);
    if (head) {
      set.head = std::move(head->mesh);
      if (scene.head_colliders) set.colliders = std::move(head->colliders);
      return {};
    }
    set.notes.push_back("no head is drawn: " + head.error().message);
  }
  if (!scene.head_colliders) return {};
  CUTICLE_ASSIGN(Sphere sphere, fit_sphere(roots));
  sphere.radius *= 0.97;  // below the roots, so that hair starts outside
  set.colliders.push_back(sphere);
  return {};
}

}  // namespace

void draw_each_strand(StrandSet& set) {
  for (const strands::Root& root : strands::identity_roots(set.control.strand_count())) {
    set.hairs.push_back({root.triangle, root.triangle, root.triangle});
    set.weights.push_back(root.weights);
  }
}

double crossing_opacity(const scene::Scene& scene, const strands::Groom& control, std::size_t strands) {
  if (scene.fibre_count == 0) return 1;
  return std::min(
      1.0, fibre_radius(scene, control) * fibres_each(scene, strands) / double(drawn_radius(scene, control, strands)));
}

float fibre_width(const scene::Scene& scene, const strands::Groom& control, std::size_t strands) {
  return std::min(1.0f, float(fibre_radius(scene, control)) / drawn_radius(scene, control, strands));
}

float drawn_radius(const scene::Scene& scene, const strands::Groom& control, std::size_t strands) {
  const double fibre = fibre_radius(scene, control);
  return float(std::max(fibre, std::min(k_max_radius, fibre * fibres_each(scene, strands))));
}

void place_strands(const scene::Scene& scene, std::span<const strands::FollowHairs> follow_hairs, bool has_radii,
                   StrandSet& set) {
  std::vector<strands::FollowHairs> groups(follow_hairs.begin(), follow_hairs.end());
  for (strands::FollowHairs& group : groups)
    if (group.guides == 0) group.guides = set.control.strand_count();
  set.placed = strands::placed_strands(set.control.strand_count());
  const std::vector<strands::PlacedStrand> beside = strands::follow_strands(set.control, groups);
  set.placed.insert(set.placed.end(), beside.begin(), beside.end());
  strands::spread_thickness(scene.groom.thickness_spread, set.placed);
  for (const strands::PlacedStrand& placed : beside)
    set.follow_reach =
        std::max(set.follow_reach, glm::length(placed.offset) * (1 + std::max(0.0f, placed.tip_separation)));
  set_radii(scene, has_radii, set);
}

Result<void> read_file_strands(const scene::Scene& scene, StrandSet& set) {
  CUTICLE_ASSIGN(strands::GroomFile file,
                 strands::read_groom(scene.groom.file, {scene.groom.metres_per_unit, scene.groom.radius}));
  set.control = std::move(file.groom);
  set.notes.insert(set.notes.end(), file.notes.begin(), file.notes.end());
  draw_each_strand(set);
  const std::vector<glm::vec3> roots = roots_of(set.control);
  if (roots.size() != set.control.strand_count())
    return bad_input(fmt::format("{}: a strand has no vertex", scene.groom.file));
  for (const glm::vec3& root : roots) set.pivot += glm::dvec3(root) / double(roots.size());
  add_followers(std::size_t(scene.strand_count), set);
  const std::optional<strands::FollowHairs>& asked = scene.groom.follow_hairs;
  place_strands(scene, asked ? std::vector{*asked} : file.follow_hairs, file.has_radii, set);
  return add_head(scene, roots, set);
}

}  // namespace cuticle::plan
