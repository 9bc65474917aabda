#pragma once
// Names that users type and that have changed: the former ones are read for one version, with a message.
#include <string_view>

namespace cuticle::registry {

/// What a name is called now: of a parameter (`of` empty), or of a choice of the parameter or key `of`. A former name is said on
/// stderr once a process; any other name comes back as it is. Test: parameter_test.
std::string_view name_now(std::string_view of, std::string_view name);

}  // namespace cuticle::registry
