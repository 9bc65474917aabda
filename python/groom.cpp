#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "strands/formats/formats.h"

#include "python/arrays.h"

namespace cuticle::python {
namespace {

using strands::GroomFile;

/// A read-only view of a groom's memory; it keeps the groom alive.
template <class T, class Item>
nb::ndarray<nb::numpy, const T> view_of(nb::handle self, const std::vector<Item>& items) {
  constexpr std::size_t components = sizeof(Item) / sizeof(T);
  const std::size_t shape[2] = {items.size(), components};
  return nb::ndarray<nb::numpy, const T>(reinterpret_cast<const T*>(items.data()), components == 1 ? 1 : 2, shape,
                                         self);
}

GroomFile load(const std::string& path, double metres_per_unit, double radius) {
  Result<GroomFile> file = [&] {
    nb::gil_scoped_release released;
    return strands::read_groom(path, {metres_per_unit, radius});
  }();
  return value_or_raise(std::move(file));
}

}  // namespace

void add_groom(nb::module_& module) {
  nb::class_<GroomFile>(module, "Groom",
                        "Strands as arrays, in metres; vertices of strand s are [offsets[s], offsets[s + 1]).")
      .def_prop_ro(
          "offsets",
          [](nb::handle self) { return view_of<std::uint32_t>(self, nb::cast<GroomFile&>(self).groom.offsets); })
      .def_prop_ro("positions",
                   [](nb::handle self) { return view_of<float>(self, nb::cast<GroomFile&>(self).groom.positions); })
      .def_prop_ro("radii",
                   [](nb::handle self) { return view_of<float>(self, nb::cast<GroomFile&>(self).groom.radii); })
      .def_prop_ro("root_uv",
                   [](nb::handle self) { return view_of<float>(self, nb::cast<GroomFile&>(self).groom.root_uv); })
      .def_ro("metres_per_unit", &GroomFile::metres_per_unit)
      .def_ro("notes", &GroomFile::notes)
      .def("__len__", [](const GroomFile& file) { return file.groom.strand_count(); });
  module.def("load_groom", &load, nb::arg("path"), nb::arg("metres_per_unit") = 0.0, nb::arg("radius") = 0.0,
             "Reads a groom file by its ending. metres_per_unit 0: as it states, or guessed (see notes); radius 0: the file's own, or 35e-6 m.");
}

}  // namespace cuticle::python
