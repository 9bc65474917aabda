#include <cuticle/render/passes/cards/cards.h>

#include <fmt/core.h>

namespace cuticle::render::cards {

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
  return registry::parse_assignments(shading->entry.parameters, mapping.settings);
}

}  // namespace cuticle::render::cards
