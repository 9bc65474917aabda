#pragma once
// For code that compares entries with each other and knows the struct of none.
#include <optional>

#include "core/registry/parameter.h"

namespace cuticle::registry {

/// The value of a parameter of whichever entry; empty where that has no such parameter. T: as Value has it.
template <class T>
std::optional<T> find_value(const ParameterValues& values, std::string_view name) {
  const auto found = values.all().find(name);
  return found == values.all().end() ? std::nullopt : std::optional(std::get<T>(found->second));
}

}  // namespace cuticle::registry
