// What views of the program show, as numbers: the drawing is PyVista's.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "viz/lobes/paths.h"
#include "viz/lobes/surface.h"
#include "viz/page/page.h"
#include "viz/plan/plan.h"
#include "viz/strands/states.h"
#include "viz/strands/surroundings.h"

#include "python/arrays.h"
#include "python/groom_file.h"
#include "python/interruptible.h"
#include "python/mesh.h"

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

/// S of every lobe over theta_o and phi, means over some degrees of phi: a dictionary of (rows, columns).
nb::dict lobe_values(const std::string& model_name, const std::string& preset, const std::string& settings,
                     double theta_i, double h, int rows, int columns) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const viz::ShownModel shown{model, value_or_raise(bsdf::parse_settings(*model, preset, settings))};
  const viz::LobeSettings at{.theta_i = theta_i, .h = h};
  viz::LobeValues found = value_or_raise(interruptible([&] {
    return viz::lobe_values(shown, at, {rows, columns}, true);
  }));
  nb::dict lobes;
  for (std::size_t k = 0; k < found.lobes.size(); ++k)
    lobes[found.lobes[k].c_str()] = take(std::move(found.values[k]), {std::size_t(rows), std::size_t(columns)});
  return lobes;
}

/// (positions, triangles).
nb::tuple mesh_arrays(const strands::Mesh& mesh) {
  std::vector<float> positions;
  std::vector<std::uint32_t> triangles;
  for (const glm::vec3& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  for (const auto& t : mesh.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
  return nb::make_tuple(take(std::move(positions), {mesh.positions.size(), 3}),
                        take(std::move(triangles), {mesh.triangles.size(), 3}));
}

/// (values (z, y, x) in metres, origin, spacing, matrix (4, 4) from its frame to the world).
nb::tuple field_arrays(const sim::DistanceField& field, const Placement& place) {
  const glm::dvec3 origin = field.centre - 0.5 * field.spacing * glm::dvec3(field.cells);
  const glm::dmat4 matrix = glm::translate(glm::dmat4(1), place.position) * glm::mat4_cast(place.rotation);
  std::vector<double> rows;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) rows.push_back(matrix[column][row]);
  const glm::ivec3 nodes = field.cells + 1;
  return nb::make_tuple(
      take(std::vector<float>(field.values), {std::size_t(nodes.z), std::size_t(nodes.y), std::size_t(nodes.x)}),
      nb::make_tuple(origin.x, origin.y, origin.z), field.spacing, take(std::move(rows), {4, 4}));
}

/// Every collider of a run where it stands in one of its states: as mesh_arrays, or as field_arrays.
nb::list run_colliders(const std::string& file) {
  const viz::Run run = value_or_raise(viz::find_run(file));
  nb::list all;
  for (const sim::PlacedCollider& collider : run.colliders_at(0)) {
    const auto* field = std::get_if<sim::FieldPointer>(&collider.shape);
    all.append(field ? field_arrays(**field, collider.place) : mesh_arrays(viz::surface_of(collider)));
  }
  return all;
}

/// (density (z, y, x) in mm/mm^3, origin).
nb::tuple hair_density(const strands::GroomFile& file, double cell) {
  viz::VolumeGrid grid = value_or_raise(viz::hair_density(file.groom, cell));
  const std::vector<std::size_t> shape = {std::size_t(grid.size.z), std::size_t(grid.size.y), std::size_t(grid.size.x)};
  return nb::make_tuple(take(std::move(grid.values), shape),
                        nb::make_tuple(grid.origin.x, grid.origin.y, grid.origin.z));
}

/// A folder with a page that shows the groom in any browser (`cuticle viewer`).
void write_page(const strands::GroomFile& file, const std::string& preset, const std::string& settings,
                const std::optional<Floats>& head_positions, const std::optional<Indices>& head_triangles,
                const std::string& title, std::size_t strands, const std::string& three, const std::string& folder) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model("marschner"));
  viz::page::PageRequest request;
  request.groom = file.groom;
  request.title = title;
  request.three = three;
  request.strands = strands;
  const registry::ParameterValues values = value_or_raise(bsdf::parse_settings(*model, preset, settings));
  request.model = registry::from_values<bsdf::marschner::Parameters>(values);
  if (head_positions && head_triangles) request.head = mesh_of(*head_positions, *head_triangles);
  require(interruptible([&] { return viz::page::write_page(request, folder, silent_progress()); }));
}

}  // namespace

void add_views(nb::module_& module) {
  module.def("section_paths", &section_paths);
  module.def("cost_maps", &cost_maps);
  module.def("lobe_values", &lobe_values);
  module.def("write_page", &write_page, nb::arg(), nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg(),
             nb::arg(), nb::arg(), nb::arg());
  module.def("run_colliders", &run_colliders);
  module.def("hair_density", &hair_density);
}

}  // namespace cuticle::python
