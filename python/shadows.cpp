// Every shadow method on arrays of points.
#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "shadows/channels.h"
#include "shadows/footprint.h"
#include "shadows/light_frame.h"
#include "strands/formats/formats.h"
#include "study/shadows/probes.h"

#include "python/arrays.h"
#include "python/interruptible.h"

namespace cuticle::python {
namespace {

using strands::GroomFile;
using Triple = std::array<double, 3>;

glm::dvec3 vector_of(const Triple& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

/// Where transmittance is asked for: at the rows of `points`; at `receivers` points that an orthographic camera sees;
/// else at the groom's vertices, as a viewer sees them where `seen_from` says from which place.
using study::Probes;
struct Asked {
  std::optional<Floats> points;
  std::optional<Triple> seen_from, camera;
  std::size_t receivers = 0;
  double fibre_width = 1;  ///< shadows::Receivers::fibre_width
};

Probes all_vertices(const strands::Groom& groom) {
  Probes places;
  places.points = groom.positions;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) {
      places.strands.push_back(std::uint32_t(s));
      places.vertices.push_back(v);
    }
  return places;
}

Probes places_of(const strands::Groom& groom, const Asked& asked) {
  Probes places;
  if (asked.points) {
    places.points = rows_of<glm::vec3>(*asked.points, "points");
    return places;
  }
  if (asked.camera) {
    const glm::dvec3 to_camera = value_or_raise(shadows::unit_to_light(vector_of(*asked.camera)));
    return study::visible_probes(groom, to_camera, asked.receivers);
  }
  places = all_vertices(groom);
  if (asked.seen_from) places.seen_from = vector_of(*asked.seen_from);
  return places;
}

shadows::Receivers receivers_of(const Probes& places, const Asked& asked) {
  shadows::Receivers receivers = places.receivers();
  receivers.fibre_width = asked.fibre_width;
  return receivers;
}

shadows::Casters casters_of(const GroomFile& file, double alpha, const Triple& light, bool is_point_light) {
  shadows::Casters casters{.groom = &file.groom, .alpha = alpha};
  if (is_point_light)
    casters.point_light = vector_of(light);
  else
    casters.to_light = value_or_raise(shadows::unit_to_light(vector_of(light)));
  return casters;
}

nb::object rows_of_three(std::span<const glm::vec3> rows) {
  std::vector<float> flat(3 * rows.size());
  if (!rows.empty()) std::memcpy(flat.data(), rows.data(), flat.size() * sizeof(float));
  return nb::cast(take(std::move(flat), {rows.size(), 3}));
}

nb::dict in_dictionary(shadows::Transmittance result, const Probes& places) {
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
  all["points"] = rows_of_three(places.points);
  return all;
}

nb::dict transmittance(const GroomFile& file, const std::string& method_name, const std::string& settings, double alpha,
                       const Triple& light, bool is_point_light, const std::optional<Floats>& points,
                       const std::optional<Triple>& seen_from, const std::optional<Triple>& camera,
                       std::size_t receivers, double fibre_width) {
  const shadows::Method* method = value_or_raise(shadows::find_method(method_name));
  const auto values = value_or_raise(registry::values_from_json(method->entry.parameters, settings, method_name));
  const shadows::Casters casters = casters_of(file, alpha, light, is_point_light);
  const Asked asked{points, seen_from, camera, receivers, fibre_width};
  const Probes places = places_of(file.groom, asked);
  return in_dictionary(
      value_or_raise(interruptible([&] { return method->evaluate(casters, receivers_of(places, asked), values); })),
      places);
}

/// Of three opacities: rows of red, green and blue.
nb::object coloured(const GroomFile& file, const std::string& method_name, const std::string& settings,
                    const Triple& alpha, const Triple& light, bool is_point_light, const std::optional<Floats>& points,
                    const std::optional<Triple>& seen_from, const std::optional<Triple>& camera, std::size_t receivers,
                    double fibre_width) {
  const shadows::Method* method = value_or_raise(shadows::find_method(method_name));
  const auto values = value_or_raise(registry::values_from_json(method->entry.parameters, settings, method_name));
  const shadows::Casters casters = casters_of(file, alpha[0], light, is_point_light);
  const Asked asked{points, seen_from, camera, receivers, fibre_width};
  const Probes places = places_of(file.groom, asked);
  const auto result = value_or_raise(interruptible([&] {
    return shadows::evaluate_channels(*method, casters, vector_of(alpha), receivers_of(places, asked), values);
  }));
  return rows_of_three(result.values);
}

}  // namespace

void add_shadows(nb::module_& module) {
  module.def("transmittance", &transmittance, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg().none(), nb::arg().none(), nb::arg().none(), nb::arg(), nb::arg());
  module.def("coloured_transmittance", &coloured, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg().none(), nb::arg().none(), nb::arg().none(), nb::arg(), nb::arg());
  module.def("footprint_radius", [](const GroomFile& file) { return shadows::default_footprint_radius(file.groom); });
}

}  // namespace cuticle::python
