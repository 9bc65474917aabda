#pragma once
// Named fibres, so that models are compared on the same hair: `cuticle eval --hair blond`.
#include <span>
#include <string_view>

#include "bsdf/fibre.h"
#include "bsdf/pigment/pigment.h"
#include "core/result.h"

namespace cuticle::bsdf {

/// A fibre by its pigments (concentrations of the table `deon_pbrt`) and what a microscope sees. `fibre.sigma_a` is
/// what the pigments absorb.
struct NamedFibre {
  std::string_view name, summary;
  Melanin pigments;
  Fibre fibre;
};

/// All of them: blond, brown, black, red, grey, white; fur_white, fur_brown, fur_grey with a medulla.
std::span<const NamedFibre> fibres();
/// One by name. Error: usage, listing them, with the nearest name.
Result<NamedFibre> find_fibre(std::string_view name);

}  // namespace cuticle::bsdf
