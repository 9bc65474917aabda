// Hair that grows, is shaped, and is bound to a mesh.
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "core/json/json.h"
#include "core/registry/read_json.h"
#include "strands/binding/binding.h"
#include "strands/formats/formats.h"
#include "strands/growing/grow.h"

#include "python/arrays.h"
#include "python/groom_file.h"
#include "python/interruptible.h"
#include "python/mesh.h"

namespace cuticle::python {
namespace {

using strands::GroomFile;

/// Drawn strands, control hairs, and what growing met.
nb::tuple grow(const std::string& json, double share) {
  auto specification = value_or_raise(strands::parse_specification(json, "specification"));
  if (share >= 0) specification.strands.share = share;
  strands::Grown grown = value_or_raise(interruptible([&] { return strands::grow(specification); }));
  GroomFile drawn = in_file(std::move(grown.drawn));
  drawn.notes.push_back(fmt::format("{} vertices moved out of the head", grown.report.moved_out));
  return nb::make_tuple(std::move(drawn), in_file(std::move(grown.control)));
}

Result<strands::ShapingBlocks> parse_blocks(const std::string& json) {
  CUTICLE_ASSIGN(const Json object, Json::parse(json));
  strands::ShapingBlocks blocks;
  for (const auto& [name, parameters] : object.items()) {
    CUTICLE_ASSIGN(const strands::Shaping* shaping, strands::find_shaping(name));
    CUTICLE_ASSIGN(blocks[name],
                   registry::values_from_object(shaping->entry.parameters, parameters, "effects." + name));
  }
  return blocks;
}

GroomFile shape(const GroomFile& file, const std::string& effects, const std::optional<Floats>& normals,
                std::uint64_t seed) {
  const strands::ShapingBlocks blocks = value_or_raise(parse_blocks(effects));
  std::vector<glm::vec3> root_normals;
  if (normals) root_normals = rows_of<glm::vec3>(*normals, "root_normals");
  if (!root_normals.empty() && root_normals.size() != file.groom.strand_count())
    raise(
        bad_input(fmt::format("root_normals: {} rows for {} strands", root_normals.size(), file.groom.strand_count())));
  GroomFile shaped = file;
  const nb::gil_scoped_release released;
  strands::shape(shaped.groom, blocks, root_normals, seed);
  return shaped;
}

/// Triangles, weights of their corners, and the report in words and numbers.
nb::tuple bind(const GroomFile& file, const Floats& positions, const Indices& triangles, double far) {
  const strands::Mesh mesh = mesh_of(positions, triangles);
  const strands::Binding binding = value_or_raise(strands::bind_roots(file.groom, mesh, far));
  std::vector<std::uint32_t> at;
  std::vector<float> weights;
  for (const strands::Root& root : binding.roots) {
    at.push_back(root.triangle);
    weights.insert(weights.end(), {root.weights.x, root.weights.y, root.weights.z});
  }
  const std::size_t count = at.size();
  return nb::make_tuple(take(std::move(at), {count}), take(std::move(weights), {count, 3}),
                        binding.report.distance.greatest, binding.report.far_strands, binding.report.empty_strands,
                        binding.report.degenerate_triangles);
}

std::vector<strands::Root> roots_of(const Indices& triangles, const Floats& weights, const GroomFile& file,
                                    const strands::Mesh& mesh) {
  const auto at = rows_of<std::uint32_t>(triangles, "triangle");
  const auto corners = rows_of<glm::vec3>(weights, "weights");
  if (at.size() != file.groom.strand_count() || corners.size() != at.size())
    raise(bad_input(fmt::format("binding: {} triangles and {} weights for {} strands", at.size(), corners.size(),
                                file.groom.strand_count())));
  std::vector<strands::Root> roots;
  for (std::size_t s = 0; s < at.size(); ++s) {
    if (at[s] >= mesh.triangles.size())
      raise(bad_input(fmt::format("binding: triangle {} is outside 0 .. {}", at[s], mesh.triangles.size() - 1)));
    roots.push_back({at[s], corners[s]});
  }
  return roots;
}

/// The strands where the mesh that they rest on has moved to.
GroomFile carry(const GroomFile& file, const std::tuple<Floats, Indices>& rest,
                const std::tuple<Indices, Floats>& bound, const Floats& moved) {
  const strands::Mesh mesh = mesh_of(std::get<0>(rest), std::get<1>(rest));
  const strands::Mesh moved_mesh = mesh_of(moved, std::get<1>(rest));
  if (moved_mesh.positions.size() != mesh.positions.size())
    raise(bad_input(
        fmt::format("moved: {} vertices, and the mesh has {}", moved_mesh.positions.size(), mesh.positions.size())));
  const auto roots = roots_of(std::get<0>(bound), std::get<1>(bound), file, mesh);
  GroomFile carried = file;
  const nb::gil_scoped_release released;
  strands::carry(strands::rest_on_mesh(file.groom, mesh, roots), moved_mesh, carried.groom.positions);
  return carried;
}

nb::tuple head(int scalp_vertices) {
  if (scalp_vertices < 3 || scalp_vertices > 1000000)
    raise(usage_error(fmt::format("scalp_vertices: {} is outside 3 .. 1000000", scalp_vertices)));
  const strands::Head made = strands::make_head(scalp_vertices);
  std::vector<double> spheres;
  for (const Sphere& sphere : made.colliders)
    spheres.insert(spheres.end(), {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius});
  return nb::make_tuple(arrays_of(made.mesh), arrays_of(made.scalp),
                        take(std::move(spheres), {made.colliders.size(), 4}));
}

}  // namespace

void add_grooming(nb::module_& module) {
  module.def("grow", &grow);
  module.def("shape_groom", &shape, nb::arg(), nb::arg(), nb::arg().none(), nb::arg());
  module.def("bind_groom", &bind);
  module.def("carry_groom", &carry);
  module.def("head", &head);
  module.def("grooming_schema", &strands::specification_schema);
}

}  // namespace cuticle::python
