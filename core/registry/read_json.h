#pragma once
// Parameter values from JSON that has been parsed.
#include "core/json/json.h"
#include "core/registry/parameter.h"

namespace cuticle::registry {

/// Values of a JSON object, checked against the table; `where` prefixes error messages ("sim.classic").
Result<ParameterValues> values_from_object(ParameterTable table, const Json& object, std::string_view where);

/// The number, if it lies in the parameter's range. Error: usage, naming parameter, number as it was typed, and range.
Result<double> within_range(const Parameter& parameter, double value, std::string_view text);

}  // namespace cuticle::registry
