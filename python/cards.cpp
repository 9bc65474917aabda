// Hair cards of a groom: mesh, textures, and what they lose.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "core/file.h"
#include "core/json/json.h"
#include "core/registry/read_json.h"
#include "strands/cards/hair_cards.h"
#include "strands/formats/formats.h"

#include "python/arrays.h"
#include "python/interruptible.h"
#include "python/mesh.h"

namespace cuticle::python {
namespace {

using strands::HairCards;

HairCards make_cards(const strands::GroomFile& file, const std::string& settings,
                     const std::optional<Floats>& head_positions, const std::optional<Indices>& head_triangles) {
  const auto parameters = value_or_raise(registry::parse<strands::CardParameters>(settings));
  strands::Mesh head;
  if (head_positions && head_triangles) head = mesh_of(*head_positions, *head_triangles);
  return value_or_raise(interruptible([&] { return strands::make_hair_cards(file.groom, &head, parameters); }));
}

nb::ndarray<nb::numpy, const float> atlas(nb::handle owner, const HairCards& cards) {
  const Image& image = cards.textures.atlas;
  const std::size_t shape[3] = {std::size_t(image.height), std::size_t(image.width), std::size_t(image.channels())};
  return nb::ndarray<nb::numpy, const float>(image.pixels.data(), 3, shape, owner);
}

nb::list atlas_channels(const HairCards& cards) {
  nb::list names;
  for (const std::string& name : cards.textures.atlas.channel_names) names.append(name.c_str());
  return names;
}

void write_folder(const HairCards& cards, const std::string& folder) {
  const nb::gil_scoped_release released;
  require(make_folder(folder));
  require(strands::write_cards(folder, cards));
}

}  // namespace

void add_cards(nb::module_& module) {
  using Self = nb::handle_t<HairCards>;
  const auto of = [](const Self& self) -> const HairCards& { return nb::cast<const HairCards&>(self); };
  nb::class_<HairCards>(module, "HairCards")
      .def("_mesh", [](const HairCards& cards) { return arrays_of(cards.mesh.mesh); })
      .def("_uv", [of](const Self& self) { return view_of<float>(self, of(self).mesh.mesh.uv); })
      .def("_occlusion", [of](const Self& self) { return view_of<float>(self, of(self).occlusion); })
      .def("_atlas", [of](const Self& self) { return atlas(self, of(self)); })
      .def("_channels", &atlas_channels)
      .def("_report", [](const HairCards& cards) { return strands::card_report(cards); })
      .def("_write", &write_folder);
  module.def("make_cards", &make_cards, nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none());
}

}  // namespace cuticle::python
