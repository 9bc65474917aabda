#include "cli/parameter_help.h"

#include <fmt/core.h>

namespace cuticle::cli {

std::string table_help(const std::string& title, registry::ParameterTable table) {
  std::string text = fmt::format("{} (name, default, range, unit):\n", title);
  for (const registry::Parameter& parameter : table) {
    const bool is_choice = parameter.type == registry::ParameterType::choice;
    text += fmt::format("  {:<18}{:<8}{}{}  {}\n", parameter.name, parameter.default_text,
                        is_choice ? std::string() : fmt::format("{} .. {}", parameter.minimum, parameter.maximum),
                        parameter.unit == "1" ? "" : fmt::format(" {}", parameter.unit), parameter.summary);
  }
  return text;
}

}  // namespace cuticle::cli
