// What views of the program show, as numbers: the drawing is PyVista's.
#include <nanobind/stl/string.h>

#include "viz/lobes/paths.h"
#include "viz/plan/plan.h"

#include "python/arrays.h"

namespace cuticle::python {
namespace {

/// (meets (rays, 3, 2), leaves (rays, 3, 2), phi (rays, 3), share (rays, 3), offset of the caustic) of R, TT and TRT.
nb::tuple section_paths(double eta, double theta, double aspect, double turned, const Numbers& offsets) {
  const viz::PathsView view{.eta = eta, .theta = theta, .aspect = aspect, .turned = turned};
  std::vector<double> meets, leaves, phi, share;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const viz::SectionPath path = viz::trace_section(view, offsets.data()[k]);
    for (std::size_t lobe = 0; lobe < 3; ++lobe) {
      meets.insert(meets.end(), {path.meets[lobe].x, path.meets[lobe].y});
      leaves.insert(leaves.end(), {path.leaves[lobe].x, path.leaves[lobe].y});
      phi.push_back(path.phi[lobe]);
      share.push_back(path.share[lobe]);
    }
  }
  const std::size_t rays = offsets.size();
  return nb::make_tuple(take(std::move(meets), {rays, 3, 2}), take(std::move(leaves), {rays, 3, 2}),
                        take(std::move(phi), {rays, 3}), take(std::move(share), {rays, 3}), viz::caustic_offset(view));
}

auto image_of(const viz::CostMap& map) { return take(map.values, {std::size_t(map.height), std::size_t(map.width)}); }

/// (cost, samples, tile_cost, strand_cost), rows from the bottom, and the shares (shaded, culled, skipped).
nb::tuple cost_maps(const std::string& file, int tile) {
  const viz::PlanMaps maps = value_or_raise(viz::read_plan({file, tile}));
  return nb::make_tuple(image_of(maps.cost), image_of(maps.samples), image_of(maps.tile_cost),
                        image_of(maps.strand_cost), nb::make_tuple(maps.shaded, maps.culled, maps.skipped));
}

}  // namespace

void add_views(nb::module_& module) {
  module.def("section_paths", &section_paths);
  module.def("cost_maps", &cost_maps);
}

}  // namespace cuticle::python
