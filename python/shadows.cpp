// Every shadow method on arrays of points.
#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "shadows/channels.h"
#include "shadows/footprint.h"
#include "strands/formats/formats.h"

#include "python/arrays.h"
#include "python/interruptible.h"

namespace cuticle::python {
namespace {

using strands::GroomFile;
using Triple = std::array<double, 3>;

glm::dvec3 vector_of(const Triple& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

/// The points, and of which strands and vertices they are where they lie on one.
struct Places {
  std::vector<glm::vec3> points = {};
  std::vector<std::uint32_t> strands = {}, vertices = {};

  shadows::Receivers receivers() const { return {.points = points, .strands = strands, .vertices = vertices}; }
};

Places all_vertices(const strands::Groom& groom) {
  Places places{.points = groom.positions};
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) {
      places.strands.push_back(std::uint32_t(s));
      places.vertices.push_back(v);
    }
  return places;
}

Places places_of(const strands::Groom& groom, const std::optional<Floats>& points) {
  return points ? Places{.points = rows_of<glm::vec3>(*points, "points")} : all_vertices(groom);
}

shadows::Casters casters_of(const GroomFile& file, double alpha, const Triple& light, bool is_point_light) {
  shadows::Casters casters{.groom = &file.groom, .alpha = alpha};
  if (is_point_light)
    casters.point_light = vector_of(light);
  else
    casters.to_light = value_or_raise(shadows::unit_to_light(vector_of(light)));
  return casters;
}

nb::dict in_dictionary(shadows::Transmittance result) {
  nb::dict all;
  const auto put = [&](const char* name, std::vector<float>& values) {
    const std::size_t count = values.size();
    if (count > 0) all[name] = take(std::move(values), {count});
  };
  all["values"] = nb::none();
  put("standard_error", result.standard_error);
  put("occluders", result.occluders);
  const std::size_t count = result.values.size();
  all["values"] = take(std::move(result.values), {count});
  all["clamped"] = result.clamped;
  all["build_ms"] = result.cost.build_ms;
  all["lookup_ms"] = result.cost.lookup_ms;
  all["bytes"] = result.cost.bytes;
  all["device"] = result.cost.device;
  return all;
}

nb::dict transmittance(const GroomFile& file, const std::string& method_name, const std::string& settings, double alpha,
                       const Triple& light, bool is_point_light, const std::optional<Floats>& points) {
  const shadows::Method* method = value_or_raise(shadows::find_method(method_name));
  const auto values = value_or_raise(registry::values_from_json(method->entry.parameters, settings, method_name));
  const shadows::Casters casters = casters_of(file, alpha, light, is_point_light);
  const Places places = places_of(file.groom, points);
  return in_dictionary(
      value_or_raise(interruptible([&] { return method->evaluate(casters, places.receivers(), values); })));
}

/// Of three opacities: rows of red, green and blue.
nb::object coloured(const GroomFile& file, const std::string& method_name, const std::string& settings,
                    const Triple& alpha, const Triple& light, bool is_point_light,
                    const std::optional<Floats>& points) {
  const shadows::Method* method = value_or_raise(shadows::find_method(method_name));
  const auto values = value_or_raise(registry::values_from_json(method->entry.parameters, settings, method_name));
  const shadows::Casters casters = casters_of(file, alpha[0], light, is_point_light);
  const Places places = places_of(file.groom, points);
  const auto result = value_or_raise(interruptible(
      [&] { return shadows::evaluate_channels(*method, casters, vector_of(alpha), places.receivers(), values); }));
  const std::size_t count = result.values.size();
  std::vector<float> flat(3 * count);
  if (count > 0) std::memcpy(flat.data(), result.values.data(), flat.size() * sizeof(float));
  return nb::cast(take(std::move(flat), {count, 3}));
}

}  // namespace

void add_shadows(nb::module_& module) {
  module.def("transmittance", &transmittance, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg().none());
  module.def("coloured_transmittance", &coloured, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg().none());
  module.def("footprint_radius", [](const GroomFile& file) { return shadows::default_footprint_radius(file.groom); });
}

}  // namespace cuticle::python
