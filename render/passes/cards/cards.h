#pragma once
#include "bsdf/model.h"
#include "render/pass.h"

namespace cuticle::render::cards {

/// The registry's entry of the pass; its parameters are those of strands::card_parameters() and its own.
const Pass& entry();
/// A material as parameters of the model `scheuermann`: its own, or what `from_fibre` of that model makes of a fibre
/// with the index, absorption, width and tilt of `marschner`. The diffuse colour is that of a head of such hair (Chiang
/// et al. 2016, equation 9), over pi: a card stands for many fibres. Not used where cards are lit as strands are, in shadows
/// and with dual scattering (README.md). Error: bad_input for any other model.
Result<registry::ParameterValues> material_of(const bsdf::Model& model, const registry::ParameterValues& values);

}  // namespace cuticle::render::cards
