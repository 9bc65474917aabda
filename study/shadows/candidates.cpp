#include <algorithm>

#include <cuticle/study/shadows/comparison.h>

namespace cuticle::study {
namespace {

const registry::Parameter* find_parameter(const shadows::Method& method, std::string_view name) {
  for (const registry::Parameter& parameter : method.entry.parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

/// Sets a parameter if the method has it, by its own range check.
Result<void> set_known(Candidate& candidate, std::string_view name, const std::string& text) {
  const registry::Parameter* parameter = find_parameter(*candidate.method, name);
  if (parameter == nullptr) return {};
  CUTICLE_ASSIGN(registry::Value value, registry::parse_value(*parameter, text));
  candidate.values.set(name, std::move(value));
  return {};
}

using Numbers = std::vector<std::int64_t>;
const Numbers k_default_only = {-1};

/// The first of these parameters that the method has, or null.
const registry::Parameter* first_of(const shadows::Method& method, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const registry::Parameter* parameter = find_parameter(method, name)) return parameter;
  return nullptr;
}

/// The numbers to sweep that the method's parameter takes; all of them, to be refused by name, where it takes none; a single
/// -1 where the method has none of these parameters or nothing is to be swept.
Numbers swept(const shadows::Method& method, const Numbers& numbers, std::initializer_list<std::string_view> names) {
  const registry::Parameter* parameter = first_of(method, names);
  if (parameter == nullptr || numbers.empty()) return k_default_only;
  Numbers taken;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(taken),
               [&](std::int64_t n) { return double(n) >= parameter->minimum && double(n) <= parameter->maximum; });
  return taken.empty() ? numbers : taken;
}

Result<Candidate> make_candidate(const shadows::Method& method, std::int64_t layers, std::int64_t resolution, double filter_radius) {
  Candidate candidate{&method, registry::default_values(method.entry.parameters)};
  if (layers >= 0) CUTICLE_TRY(set_known(candidate, "slices", std::to_string(layers)));
  if (layers >= 0) CUTICLE_TRY(set_known(candidate, "layers", std::to_string(layers)));
  if (resolution >= 0) CUTICLE_TRY(set_known(candidate, "resolution", std::to_string(resolution)));
  if (filter_radius > 0) CUTICLE_TRY(set_known(candidate, "filter_radius_mm", std::to_string(1e3 * filter_radius)));
  return candidate;
}

}  // namespace

Result<std::vector<Candidate>> candidates_of(std::span<const std::string> methods, const Sweep& sweep) {
  std::vector<Candidate> candidates;
  for (const std::string& name : methods) {
    CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(name));
    for (const std::int64_t resolution : swept(*method, sweep.resolutions, {"resolution"}))
      for (const std::int64_t layers : swept(*method, sweep.layers, {"slices", "layers"})) {
        CUTICLE_ASSIGN(Candidate candidate, make_candidate(*method, layers, resolution, sweep.filter_radius));
        candidates.push_back(std::move(candidate));
      }
  }
  return candidates;
}

std::string settings_text(const Candidate& candidate) {
  const registry::ParameterValues defaults = registry::default_values(candidate.method->entry.parameters);
  std::string text;
  for (const auto& [name, value] : candidate.values.all())
    if (value != defaults.all().find(name)->second) text += (text.empty() ? "" : ",") + name + "=" + registry::to_text(value);
  return text;
}

}  // namespace cuticle::study
