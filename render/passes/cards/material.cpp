#include "render/passes/cards/cards.h"

#include <fmt/core.h>

#include <glm/ext/scalar_constants.hpp>

#include "bsdf/marschner/marschner.h"
#include "bsdf/pigment/pigment.h"

namespace cuticle::render::cards {

namespace {

constexpr double k_azimuthal_roughness = 0.3;  // that of the absorption of a colour where a scene names none

}  // namespace

Result<bsdf::scheuermann::Parameters> material_of(const bsdf::Model& model, const registry::ParameterValues& values) {
  if (model.entry.name == "scheuermann") return registry::from_values<bsdf::scheuermann::Parameters>(values);
  if (model.entry.name != "marschner")
    return bad_input(fmt::format("material.model = '{}': cards are shaded by 'scheuermann', from its own parameters or "
                                 "those of 'marschner'",
                                 model.entry.name),
                     "use the model 'scheuermann'");
  CUTICLE_ASSIGN(const bsdf::Model* shading, bsdf::find_model("scheuermann"));
  const auto fibre = registry::from_values<bsdf::marschner::Parameters>(values);
  const bsdf::FibreMapping mapping = shading->from_fibre(
      {.sigma_a = fibre.sigma_a, .eta = fibre.eta, .scale_tilt = -fibre.alpha, .longitudinal_deviation = fibre.beta});
  CUTICLE_ASSIGN(auto shaded, registry::parse<bsdf::scheuermann::Parameters>(mapping.settings));
  CUTICLE_ASSIGN(const glm::dvec3 color, bsdf::color_of_assembly(fibre.sigma_a, k_azimuthal_roughness));
  shaded.diffuse = color / glm::pi<double>();
  return shaded;
}

}  // namespace cuticle::render::cards
