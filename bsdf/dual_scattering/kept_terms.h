#pragma once
// Tables of dual scattering that are kept: one takes seconds.
#include "bsdf/dual_scattering/dual_scattering.h"

namespace cuticle::bsdf {

/// Inclinations of the tables that renderers read.
constexpr int k_dual_scattering_rows = 32;

/// dual_scattering_terms with k_dual_scattering_rows rows, of the near field where a model has it for all h: its
/// averages over the width are those of the far field and come several times faster (not so of a model that walks: of
/// its far field). The tables of the last eight materials are kept. Safe to call from several threads. Test:
/// dual_scattering_test.cpp. Errors: those of dual_scattering_terms.
Result<DualScatteringTable> kept_dual_scattering_terms(const Model& model, const registry::ParameterValues& values);

}  // namespace cuticle::bsdf
