#include "render/passes/cards/cards.h"

#include <fmt/core.h>

#include <glm/ext/scalar_constants.hpp>

#include "bsdf/pigment/pigment.h"

namespace cuticle::render::cards {

namespace {

constexpr double k_azimuthal_roughness = 0.3;  // that of the absorption of a colour where a scene names none

}  // namespace

Result<registry::ParameterValues> material_of(const bsdf::Model& model, const registry::ParameterValues& values) {
  if (model.entry.name == "scheuermann") return values;
  if (model.entry.name != "marschner")
    return bad_input(fmt::format("material.model = '{}': cards are shaded by 'scheuermann', from its own parameters or "
                                 "those of 'marschner'",
                                 model.entry.name),
                     "use the model 'scheuermann'");
  CUTICLE_ASSIGN(const bsdf::Model* shading, bsdf::find_model("scheuermann"));
  const bsdf::FibreMapping mapping = shading->from_fibre({.sigma_a = values.rgb("sigma_a"),
                                                          .eta = values.real("eta"),
                                                          .scale_tilt = -values.real("alpha"),
                                                          .longitudinal_deviation = values.real("beta")});
  CUTICLE_ASSIGN(registry::ParameterValues shaded,
                 registry::parse_assignments(shading->entry.parameters, mapping.settings));
  CUTICLE_ASSIGN(const glm::dvec3 color, bsdf::color_of_assembly(values.rgb("sigma_a"), k_azimuthal_roughness));
  shaded.set("diffuse", color / glm::pi<double>());
  return shaded;
}

}  // namespace cuticle::render::cards
