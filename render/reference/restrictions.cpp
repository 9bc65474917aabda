#include "render/reference/restrictions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/common.hpp>

#include "lut/format.h"
#include "lut/scattering_reader.h"
#include "shadows/channels.h"

namespace cuticle::render::reference {

namespace {

bsdf::Point point_of(const bsdf::BatchPoints& points, std::size_t i) {
  const auto angle_of = [](float sine) { return std::asin(std::clamp(double(sine), -1.0, 1.0)); };
  const auto turn_of = [i](const bsdf::VectorSpans& v) { return std::atan2(double(v.z[i]), double(v.y[i])); };
  bsdf::Point at{.theta_i = angle_of(points.to_light.x[i]), .theta_o = angle_of(points.to_viewer.x[i])};
  at.theta_d = std::abs(at.theta_o - at.theta_i) / 2;
  const double turned = std::abs(turn_of(points.to_viewer) - turn_of(points.to_light));
  at.phi = std::min(turned, 2 * std::numbers::pi - turned);
  return at;
}

}  // namespace

struct TableScattering::Parts {
  lut::TableSet set;
  std::optional<lut::ScatteringReader> reader;
};

TableScattering::TableScattering(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
TableScattering::~TableScattering() = default;

Result<std::unique_ptr<TableScattering>> TableScattering::make(const bsdf::Model& model,
                                                               const registry::ParameterValues& values,
                                                               const TablesInstead& choice) {
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout(choice.layout, model, values));
  if (layout->terms.empty())
    return usage_error(fmt::format("layout {}: its tables do not make S", choice.layout), "layout nalu");
  auto parts = std::make_unique<Parts>();
  CUTICLE_ASSIGN(parts->set, lut::bake(model, values, *layout, choice.size, silent_progress()));
  CUTICLE_TRY(lut::store_as(parts->set, lut::half_exr()));
  parts->reader.emplace(parts->set);
  return std::unique_ptr<TableScattering>(new TableScattering(std::move(parts)));
}

void TableScattering::evaluate(const bsdf::BatchPoints& points, const bsdf::OutputSpans& color) const {
  const std::array<std::span<float>, 3> channels{color.x, color.y, color.z};
  for (std::size_t i = 0; i < color.x.size(); ++i) {
    const bsdf::Point at = point_of(points, i);
    for (int c = 0; c < 3; ++c) channels[std::size_t(c)][i] = float(parts_->reader->scattering(at, c));
  }
}

Result<VertexTransmittance> VertexTransmittance::make(const TracedScene& scene, const ShadowsInstead& choice) {
  CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(choice.method));
  const strands::Groom& hair = scene.hair;
  std::vector<std::uint32_t> strand_of, vertices;
  for (std::uint32_t s = 0; s < hair.strand_count(); ++s)
    for (std::uint32_t v = hair.offsets[s]; v < hair.offsets[s + 1]; ++v) {
      strand_of.push_back(s);
      vertices.push_back(v);
    }
  const shadows::Receivers receivers{.points = hair.positions,
                                     .strands = strand_of,
                                     .vertices = vertices,
                                     .seen_from = scene.camera.position,
                                     .fibre_width = choice.fibre_width};
  VertexTransmittance result;
  for (const Light& light : scene.lights) {
    shadows::Casters casters{.groom = &hair, .to_light = light.to_light};
    if (light.point_light) casters.point_light = light.point_light->position;
    CUTICLE_ASSIGN(shadows::ColouredTransmittance reached,
                   shadows::evaluate_channels(*method, casters, choice.alpha, receivers, choice.values));
    result.of_light_.push_back(std::move(reached.values));
  }
  return result;
}

glm::dvec3 VertexTransmittance::at(std::size_t light, const FibrePoint& point) const {
  const glm::vec3* ends = of_light_[light].data() + point.from.vertex;
  return glm::mix(glm::dvec3(ends[0]), glm::dvec3(ends[1]), point.share);
}

}  // namespace cuticle::render::reference
