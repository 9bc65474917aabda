#pragma once
// How the flat cross-section of a fibre is turned about its axis: by phi_o, or by the mean over all turns.
#include "bsdf/model.h"

namespace cuticle::bsdf {

/// The row of models that have a mean over turns.
inline constexpr registry::Parameter turns_parameter = {
    "turns",
    registry::ParameterType::integer,
    "1",
    0,
    4096,
    "0",
    {},
    "aspect other than 1: the mean over this many turns of the cross-section (of TRT with marschner); 0: its one turn is "
    "phi_o's"};

/// Whether phi_o changes what these values scatter: the model has an `aspect`, which is not 1, and no mean over turns
/// is asked for.
bool is_turned_by_viewer(const registry::ParameterValues& values);

/// The same values with the mean over `count` turns where phi_o would matter and the model has that mean (`turns`);
/// otherwise unchanged. For what knows no phi_o: tables, direct evaluation on a device, dual scattering. Test:
/// turns_test.
registry::ParameterValues over_turns(const registry::ParameterValues& values, int count);

}  // namespace cuticle::bsdf
