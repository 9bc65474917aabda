#pragma once
// Parameter tables as the text of --help.
#include <string>

#include "core/registry/parameter.h"

namespace cuticle::cli {

/// A title, then a line for each parameter: name, default, range, unit, summary.
std::string table_help(const std::string& title, registry::ParameterTable table);

}  // namespace cuticle::cli
