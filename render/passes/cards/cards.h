#pragma once
#include "bsdf/model.h"
#include "bsdf/scheuermann/scheuermann.h"
#include "render/pass.h"
#include "strands/cards/cards.h"

namespace cuticle::render::cards {

/// inside_to_outside: as computed beforehand (A7); groups: A10, groups by their depth, in those that swing parts by
/// theirs, on the head the static order; parts: all by their depth.
enum class Order { inside_to_outside, groups, parts };
/// Which transparent faces write depth.
enum class TransparentDepth { printed, off, front, both };

struct Parameters : strands::CardParameters {
  static constexpr std::string_view name = "cards";
  bool three_pass = false;
  Order order = Order::inside_to_outside;
  TransparentDepth transparent_depth = TransparentDepth::printed;
  double opaque_alpha = 0.9;
  bool count_fragments = false;
};
void describe(registry::Members& members, Parameters& parameters);

/// The registry's entry of the pass.
const Pass& entry();
/// A material as parameters of the model `scheuermann`: its own, or what `from_fibre` of that model makes of a fibre
/// with the index, absorption, width and tilt of `marschner`. The diffuse colour is that of a head of such hair (Chiang
/// et al. 2016, equation 9), over pi: a card stands for many fibres. Not used where cards are lit as strands are, in
/// shadows and with dual scattering (README.md). Error: bad_input for any other model.
Result<bsdf::scheuermann::Parameters> material_of(const bsdf::Model& model, const registry::ParameterValues& values);

}  // namespace cuticle::render::cards
