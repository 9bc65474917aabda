#include "plan/hair_in_view.h"

#include <algorithm>
#include <array>

#include "strands/groom.h"

namespace cuticle::plan {

namespace {

std::array<glm::dvec3, 8> corners(const strands::Bounds& box) {
  std::array<glm::dvec3, 8> all;
  for (std::size_t k = 0; k < 8; ++k)
    all[k] = {(k & 1 ? box.upper : box.lower).x, (k & 2 ? box.upper : box.lower).y, (k & 4 ? box.upper : box.lower).z};
  return all;
}

strands::Bounds bounds_of(const strands::Mesh& mesh) {
  strands::Groom points;
  points.positions = mesh.positions;
  return strands::bounds(points);
}

/// Floor, head and fins, as far as they may be in view.
bool sees_surfaces(const scene::Scene& scene, const StrandSet& set, const FramePlaces& places) {
  if (scene.character) return true;
  if (scene.floor) {
    const float half = float(scene.floor->size / 2), height = float(scene.floor->height);
    if (may_be_seen({{-half, height, -half}, {half, height, half}}, glm::dmat4(1), places.camera)) return true;
  }
  if (!set.fins.triangles.empty()) return true;
  return !set.head.triangles.empty() && may_be_seen(bounds_of(set.head), places.head, places.camera);
}

}  // namespace

bool may_be_seen(const strands::Bounds& box, const glm::dmat4& to_world, const Camera& camera) {
  const glm::dmat4 to_clip = projection_matrix(camera) * view_matrix(camera) * to_world;
  std::array<int, 5> beyond{};
  for (const glm::dvec3& corner : corners(box)) {
    const glm::dvec4 clip = to_clip * glm::dvec4(corner, 1);
    const double side = (1 + 2 * k_view_margin) * std::max(clip.w, 0.0);
    beyond[0] += clip.x < -side;
    beyond[1] += clip.x > side;
    beyond[2] += clip.y < -side;
    beyond[3] += clip.y > side;
    beyond[4] += clip.w <= 0;
  }
  return std::ranges::none_of(beyond, [](int count) { return count == 8; });
}

registry::Fact hair_in_view(const scene::Scene& scene, const StrandSet& set, const Plan& plan,
                            const FramePlaces& places) {
  for (const char* pass : {"aovs", "velocity", "supersampled", "reference"})
    if (find_pass(plan, pass)) return {true, std::string("'") + pass + "' looks at all of the picture"};
  if (may_be_seen(places.hair, glm::dmat4(1), places.camera)) return {true, "hair is in view"};
  if (find_pass(plan, "surface_shadow") && sees_surfaces(scene, set, places))
    return {true, "what hair casts shadows on is in view"};
  return {false, "hair is outside the view, and nothing in view shows its shadow"};
}

}  // namespace cuticle::plan
