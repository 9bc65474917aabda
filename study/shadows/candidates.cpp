#include <algorithm>

#include <fmt/format.h>

#include "study/shadows/comparison.h"

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
using Texts = std::vector<std::string>;
/// One parameter and the texts that it takes in turn; no name: a single candidate without it.
struct Axis {
  std::string_view name;
  Texts texts = {""};
};

/// The first of these parameters that the method has, or null.
const registry::Parameter* first_of(const shadows::Method& method, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const registry::Parameter* parameter = find_parameter(method, name)) return parameter;
  return nullptr;
}

/// The numbers that the method's parameter takes. None of them: all, to be refused by name.
Axis number_axis(const shadows::Method& method, const Numbers& numbers, std::initializer_list<std::string_view> names) {
  const registry::Parameter* parameter = first_of(method, names);
  if (parameter == nullptr || numbers.empty()) return {};
  Axis taken{parameter->name, {}}, all = taken;
  for (const std::int64_t n : numbers) {
    all.texts.push_back(std::to_string(n));
    if (double(n) >= parameter->minimum && double(n) <= parameter->maximum) taken.texts.push_back(std::to_string(n));
  }
  return taken.texts.empty() ? all : taken;
}

void add_left_out(const shadows::Method& method, const Numbers& numbers, std::initializer_list<std::string_view> names,
                  std::vector<std::string>& sentences) {
  const registry::Parameter* parameter = first_of(method, names);
  if (parameter == nullptr) return;
  std::vector<std::int64_t> beyond;
  for (const std::int64_t n : numbers)
    if (double(n) < parameter->minimum || double(n) > parameter->maximum) beyond.push_back(n);
  if (!beyond.empty() && beyond.size() < numbers.size())
    sentences.push_back(fmt::format("{}: {} {} left out, it takes {} .. {}", method.entry.name, parameter->name,
                                    fmt::join(beyond, ", "), parameter->minimum, parameter->maximum));
}

/// The texts that the method's parameter takes, all where it takes none; nothing where the method does not have it.
Axis text_axis(const shadows::Method& method, const Texts& texts, std::string_view name) {
  const registry::Parameter* parameter = find_parameter(method, name);
  if (parameter == nullptr || texts.empty()) return {};
  Axis axis{name, {}};
  for (const std::string& text : texts)
    if (registry::parse_value(*parameter, text)) axis.texts.push_back(text);
  return axis.texts.empty() ? Axis{name, texts} : axis;
}

/// Where layers are swept: slices or layers, and the method's own study cases where it has neither.
std::vector<std::pair<Axis, std::string_view>> layer_axes(const shadows::Method& method, const Numbers& layers) {
  const bool has_layers = first_of(method, {"slices", "layers"}) != nullptr;
  if (layers.empty() || has_layers || method.entry.study_cases.empty())
    return {{number_axis(method, layers, {"slices", "layers"}), ""}};
  std::vector<std::pair<Axis, std::string_view>> axes;
  for (const registry::StudyCase& study_case : method.entry.study_cases) axes.push_back({Axis{}, study_case.settings});
  return axes;
}

/// Every combination of the axes over the values of `start`.
Result<void> add_combinations(const Candidate& start, std::span<const Axis> axes, std::vector<Candidate>& candidates) {
  if (axes.empty()) {  // study cases that differ by what is set here are one candidate
    const bool is_known = std::ranges::any_of(candidates, [&](const Candidate& other) {
      return other.method == start.method && other.values.all() == start.values.all();
    });
    if (!is_known) candidates.push_back(start);
    return {};
  }
  for (const std::string& text : axes[0].texts) {
    Candidate candidate = start;
    if (!axes[0].name.empty()) CUTICLE_TRY(set_known(candidate, axes[0].name, text));
    CUTICLE_TRY(add_combinations(candidate, axes.subspan(1), candidates));
  }
  return {};
}

Texts texts_of(std::span<const double> numbers, double unit) {
  Texts texts;
  for (const double number : numbers) texts.push_back(std::to_string(unit * number));
  return texts;
}

Result<void> add_method(const shadows::Method& method, const Sweep& sweep, std::vector<Candidate>& candidates) {
  for (const auto& [layers, settings] : layer_axes(method, sweep.layers)) {
    Candidate start{&method, {}};
    CUTICLE_ASSIGN(start.values, registry::parse_assignments(method.entry.parameters, settings));
    for (const MethodSetting& setting : sweep.settings)
      if (setting.method == method.entry.name) CUTICLE_TRY(set_known(start, setting.parameter, setting.value));
    const Axis axes[] = {number_axis(method, sweep.resolutions, {"resolution"}), layers,
                         text_axis(method, sweep.spacings, "spacing"),
                         text_axis(method, texts_of(sweep.filter_radii, 1e3), "filter_radius_mm"),
                         text_axis(method, texts_of(sweep.filter_texels, 1), "filter_texels")};
    CUTICLE_TRY(add_combinations(start, axes, candidates));
  }
  return {};
}

Result<void> check_setting(std::span<const std::string> methods, const MethodSetting& setting) {
  CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(setting.method));
  CUTICLE_TRY(registry::find_parameter(method->entry.parameters, setting.parameter));
  if (std::ranges::find(methods, setting.method) != methods.end()) return {};
  return usage_error(
      fmt::format("{}.{} is set, but {} is not among the methods", setting.method, setting.parameter, setting.method));
}

}  // namespace

Result<std::vector<MethodSetting>> parse_method_settings(const std::vector<std::string>& texts) {
  std::vector<MethodSetting> settings;
  for (const std::string& text : texts) {
    const std::size_t dot = text.find('.'), equals = text.find('=');
    if (dot == std::string::npos || equals == std::string::npos || equals < dot)
      return usage_error(fmt::format("--set: '{}' is not METHOD.NAME=VALUE", text),
                         "--set deep_opacity.layer_range=map,opacity_map.between=even");
    settings.push_back({text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), text.substr(equals + 1)});
  }
  return settings;
}

Result<std::vector<Candidate>> candidates_of(std::span<const std::string> methods, const Sweep& sweep) {
  for (const MethodSetting& setting : sweep.settings) CUTICLE_TRY(check_setting(methods, setting));
  std::vector<Candidate> candidates;
  for (const std::string& name : methods) {
    CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(name));
    std::vector<Candidate> of_method;
    const auto added = add_method(*method, sweep, of_method);
    if (!added && !sweep.skip_unfit) return added.error();
    if (added) std::move(of_method.begin(), of_method.end(), std::back_inserter(candidates));
  }
  return candidates;
}

std::vector<std::string> left_out_of(std::span<const std::string> methods, const Sweep& sweep) {
  std::vector<std::string> sentences;
  for (const std::string& name : methods)
    if (const auto method = shadows::find_method(name)) {
      add_left_out(**method, sweep.resolutions, {"resolution"}, sentences);
      add_left_out(**method, sweep.layers, {"slices", "layers"}, sentences);
    }
  return sentences;
}

std::vector<std::string> all_methods() {
  std::vector<std::string> names;
  for (const shadows::Method* method : shadows::methods())
    if (method->entry.name != "truth") names.emplace_back(method->entry.name);
  return names;
}

std::string settings_text(const Candidate& candidate) {
  const registry::ParameterValues defaults = registry::default_values(candidate.method->entry.parameters);
  std::string text;
  for (const auto& [name, value] : candidate.values.all())
    if (value != defaults.all().find(name)->second)
      text += (text.empty() ? "" : ",") + name + "=" + registry::to_text(value);
  return text;
}

}  // namespace cuticle::study
