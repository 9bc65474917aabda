#pragma once
// Names that users type and that have changed: the former ones are read for one version, with a message.
#include <string_view>

namespace cuticle::registry {

/// What a name is called now: of a parameter (`of` empty), or of a choice of the parameter or key `of`; any other name
/// comes back as it is. Test: parameter_test.
std::string_view current_name(std::string_view of, std::string_view name);

/// The same, and the listener hears of a former name once a process.
std::string_view name_now(std::string_view of, std::string_view name);

/// Hears a former name and what it is called now, on any thread.
using FormerNameListener = void (*)(std::string_view former, std::string_view now);
/// For the program and the Python module, which tell their users; without one nothing is said.
void set_former_name_listener(FormerNameListener listener);

}  // namespace cuticle::registry
