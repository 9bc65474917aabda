#pragma once
// How the flat cross-section of a fibre is turned about its axis: by phi_o, or by the mean over all turns.
#include "bsdf/model.h"

namespace cuticle::bsdf {

/// Whether phi_o changes what these values scatter: the model has an `aspect`, which is not 1, and no mean over turns
/// is asked for.
bool is_turned_by_viewer(const registry::ParameterValues& values);

/// The same values with the mean over `count` turns where phi_o would matter and the model has that mean (`turns`);
/// otherwise unchanged. For what knows no phi_o: tables, direct evaluation on a device, dual scattering. Test:
/// turns_test.
registry::ParameterValues over_turns(const registry::ParameterValues& values, int count);

}  // namespace cuticle::bsdf
