#include <numeric>

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "strands/check/groom_check.h"
#include "strands/formats/formats.h"
#include "strands/gltf/strands_glb.h"

#include "python/arrays.h"

namespace cuticle::python {
namespace {

using strands::Attribute;
using strands::Groom;
using strands::GroomFile;

/// A name, "strand" or "vertex", and rows of numbers.
using NamedValues = std::tuple<std::string, std::string, Floats>;

GroomFile load(const std::string& path, double metres_per_unit, double radius, bool repair) {
  Result<GroomFile> file = [&] {
    nb::gil_scoped_release released;
    return strands::read_groom(path, {metres_per_unit, radius, repair});
  }();
  return value_or_raise(std::move(file));
}

void add_attribute(const NamedValues& named, Groom& groom) {
  const auto& [name, domain, values] = named;
  Attribute attribute;
  attribute.domain = domain == "strand" ? Attribute::Domain::strand : Attribute::Domain::vertex;
  const std::size_t rows = domain == "strand" ? groom.strand_count() : groom.vertex_count();
  if (values.ndim() < 1 || values.ndim() > 2 || values.shape(0) != rows)
    raise(bad_input(fmt::format("attribute '{}': not one row for each of {} {}s", name, rows, domain)));
  attribute.components = values.ndim() == 2 ? int(values.shape(1)) : 1;
  attribute.values.assign(values.data(), values.data() + values.size());
  groom.attributes[name] = std::move(attribute);
}

void set_strands(const Floats& points, const Indices& counts, Groom& groom) {
  groom.positions = rows_of<glm::vec3>(points, "points");
  std::uint64_t sum = 0;
  for (std::size_t s = 0; s < counts.size(); ++s) {
    sum += counts.data()[s];
    if (sum <= groom.vertex_count()) groom.offsets.push_back(std::uint32_t(sum));
  }
  if (sum != groom.vertex_count())
    raise(bad_input(fmt::format("counts: their sum is {}, and there are {} points", sum, groom.vertex_count())));
}

GroomFile from_arrays(const Floats& points, const Indices& counts, const Floats& radii,
                      const std::optional<Floats>& root_uv, const std::vector<NamedValues>& attributes) {
  GroomFile file;
  set_strands(points, counts, file.groom);
  file.groom.radii = rows_of<float>(radii, "radii");
  if (root_uv) file.groom.root_uv = rows_of<glm::vec2>(*root_uv, "root_uv");
  for (const NamedValues& named : attributes) add_attribute(named, file.groom);
  if (const Result<void> valid = strands::validate(file.groom); !valid) raise(bad_input(valid.error().message));
  file.has_radii = true;
  return file;
}

std::vector<std::string> write(const GroomFile& file, const std::string& path, double metres_per_unit) {
  auto written = [&] {
    nb::gil_scoped_release released;
    return path.ends_with(".glb") ? strands::write_strands_glb(path, file.groom, metres_per_unit)
                                  : strands::write_groom(path, file.groom, metres_per_unit);
  }();
  return value_or_raise(std::move(written));
}

std::vector<std::tuple<std::string, bool, std::string, std::string, std::string>> check(const GroomFile& file) {
  std::vector<std::tuple<std::string, bool, std::string, std::string, std::string>> verdicts;
  for (const strands::check::Verdict& verdict : strands::check::check_groom(file.groom))
    verdicts.emplace_back(verdict.check, verdict.passed, verdict.measured, verdict.mistake, verdict.remedy);
  return verdicts;
}

nb::dict attributes_of(nb::handle self) {
  nb::dict all;
  for (const auto& [name, attribute] : nb::cast<GroomFile&>(self).groom.attributes) {
    const std::size_t components = std::size_t(attribute.components);
    const std::size_t shape[2] = {attribute.values.size() / components, components};
    all[nb::str(name.c_str())] =
        nb::ndarray<nb::numpy, const float>(attribute.values.data(), components == 1 ? 1 : 2, shape, self);
  }
  return all;
}

template <class T, auto Member>
auto view(nb::handle self) {
  return view_of<T>(self, nb::cast<GroomFile&>(self).groom.*Member);
}

}  // namespace

void add_groom(nb::module_& module) {
  nb::class_<GroomFile>(module, "Groom",
                        "Strands as arrays, in metres; vertices of strand s are [offsets[s], offsets[s + 1]).")
      .def_prop_ro("offsets", &view<std::uint32_t, &Groom::offsets>, "uint32 (strands + 1)")
      .def_prop_ro("positions", &view<float, &Groom::positions>, "float32 (vertices, 3), metres; a view")
      .def_prop_ro("radii", &view<float, &Groom::radii>, "float32 (vertices), metres; a view")
      .def_prop_ro("root_uv", &view<float, &Groom::root_uv>, "float32 (strands, 2), or (0, 2); a view")
      .def_prop_ro("attributes", &attributes_of, "arrays by name, one row per strand or vertex; views")
      .def_ro("metres_per_unit", &GroomFile::metres_per_unit, "of the file that it was read from")
      .def_ro("notes", &GroomFile::notes, "what was guessed or left out, one sentence each")
      .def("__len__", [](const GroomFile& file) { return file.groom.strand_count(); })
      .def("_write", &write)
      .def("_check", &check)
      .def("_copy", [](const GroomFile& file) { return file; });
  module.def("load_groom", &load);
  module.def("groom_from_arrays", &from_arrays, nb::arg(), nb::arg(), nb::arg(), nb::arg().none(), nb::arg());
}

}  // namespace cuticle::python
