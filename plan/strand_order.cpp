#include "plan/strand_order.h"

#include <utility>

#include "render/passes/lines/lines.h"
#include "render/passes/quads/quads.h"
#include "render/passes/surface_shadow/surface_shadow.h"
#include "render/passes/tile_lists/tile_lists.h"
#include "strands/lod/spread_order.h"

namespace cuticle::plan {

namespace {

using strands::StrandShape;

StrandShape mixed(const std::vector<StrandShape>& control, const std::array<std::uint32_t, 3>& hair,
                  const glm::vec3& weights) {
  StrandShape shape;
  for (std::size_t k = 0; k < shape.size(); ++k)
    shape[k] = weights.x * control[hair[0]][k] + weights.y * control[hair[1]][k] + weights.z * control[hair[2]][k];
  return shape;
}

StrandShape placed(const std::vector<StrandShape>& control, const strands::PlacedStrand& strand) {
  StrandShape shape = control[strand.guide];
  for (glm::vec3& point : shape) point += strand.offset;
  return shape;
}

template <class T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  std::vector<T> result;
  result.reserve(values.size());
  for (std::uint32_t place : order) result.push_back(values[place]);
  return result;
}

}  // namespace

bool may_use_a_prefix(const scene::Scene& scene) {
  return scene.caster_share < 1 || render::parameters_of<render::lines::Parameters>(scene.passes).full_px > 0 ||
         render::parameters_of<render::quads::Parameters>(scene.passes).full_px > 0 ||
         render::parameters_of<render::tile_lists::Parameters>(scene.passes).full_px > 0 ||
         render::parameters_of<render::surface_shadow::Parameters>(scene.passes).hair_share < 1;
}

void put_in_spread_order(StrandSet& set) {
  if (std::exchange(set.is_spread, true)) return;
  const std::vector<StrandShape> control = strands::shapes_of(set.control);
  std::vector<StrandShape> shapes;
  for (std::size_t k = 0; k < set.hairs.size(); ++k) shapes.push_back(mixed(control, set.hairs[k], set.weights[k]));
  std::vector<std::uint32_t> order = strands::spread_order(shapes);
  set.hairs = in_order(set.hairs, order);
  set.weights = in_order(set.weights, order);
  shapes.clear();
  for (const strands::PlacedStrand& strand : set.placed) shapes.push_back(placed(control, strand));
  order = strands::spread_order(shapes);
  set.placed = in_order(set.placed, order);
}

}  // namespace cuticle::plan
