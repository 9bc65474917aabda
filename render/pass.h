#pragma once
// The concept of a render pass: one folder each, with its demands, its shader and its cost.
#include <span>
#include <string_view>

#include "core/registry/entry.h"
#include "core/registry/members.h"
#include "core/result.h"

namespace cuticle::render {

struct Pass {
  registry::Entry entry;
  bool whole_pictures = false;  ///< draws or looks at all of a picture at once, so that it cannot be drawn in chunks
};
std::span<const Pass* const> passes();

/// Parameters of passes by name, as a scene gives them; absent: defaults.
using PassParameters = std::map<std::string, registry::ParameterValues, std::less<>>;
/// Those of one pass, as its struct.
template <class Parameters>
Parameters parameters_of(const PassParameters& passes) {
  const auto found = passes.find(Parameters::name);
  return found == passes.end() ? Parameters{} : registry::from_values<Parameters>(found->second);
}

}  // namespace cuticle::render
