#include "core/registry/entry.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/json/json.h"

namespace cuticle::registry {
namespace {

const char* name_of(EntryKind kind) {
  switch (kind) {
    case EntryKind::model: return "model";
    case EntryKind::layout: return "layout";
    case EntryKind::method: return "method";
    case EntryKind::effect: return "effect";
    case EntryKind::pass: break;
  }
  return "pass";
}

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::prepare: return "prepare";
    case Stage::simulate: return "simulate";
    case Stage::generate: return "generate";
    case Stage::shadow: return "shadow";
    case Stage::shade: return "shade";
    case Stage::resolve: return "resolve";
    case Stage::output: break;
  }
  return "output";
}

const char* name_of(ParameterType type) {
  switch (type) {
    case ParameterType::real: return "real";
    case ParameterType::integer: return "integer";
    case ParameterType::boolean: return "boolean";
    case ParameterType::choice: return "choice";
    case ParameterType::rgb: break;
  }
  return "rgb";
}

bool has_range(const Parameter& parameter) {
  return parameter.type != ParameterType::boolean && parameter.type != ParameterType::choice;
}

Json names_json(std::span<const std::string_view> names) {
  Json list = Json::list();
  for (std::string_view name : names) list.push_back(std::string(name));
  return list;
}

Json parameter_json(const Parameter& parameter) {
  Json object = {{"name", std::string(parameter.name)},
                 {"type", name_of(parameter.type)},
                 {"unit", std::string(parameter.unit)},
                 {"default", std::string(parameter.default_text)},
                 {"summary", std::string(parameter.summary)}};
  if (has_range(parameter)) object["range"] = {parameter.minimum, parameter.maximum};
  if (parameter.type == ParameterType::choice) object["choices"] = names_json(parameter.choices);
  return object;
}

Json entry_json(const Entry& entry) {
  Json parameters = Json::list();
  for (const Parameter& parameter : entry.parameters) parameters.push_back(parameter_json(parameter));
  return {{"kind", name_of(entry.kind)}, {"name", std::string(entry.name)}, {"summary", std::string(entry.summary)},
          {"source", std::string(entry.source)}, {"parameters", parameters}, {"demands", names_json(entry.demands)},
          {"stage", name_of(entry.stage)}, {"systems", names_json(entry.systems)}};
}

std::string range_text(const Parameter& parameter) {
  if (parameter.type == ParameterType::boolean) return "true or false";
  if (parameter.type == ParameterType::choice) return fmt::format("{}", fmt::join(parameter.choices, "|"));
  return fmt::format("{:g} .. {:g}", parameter.minimum, parameter.maximum);
}

std::string entry_text(const Entry& entry) {
  std::string text = fmt::format("{}\n  {}\n", entry.name, entry.summary);
  if (!entry.source.empty()) text += fmt::format("  source: {}\n", entry.source);
  if (!entry.demands.empty()) text += fmt::format("  demanded by: {}\n", fmt::join(entry.demands, ", "));
  for (const Parameter& parameter : entry.parameters)
    text += fmt::format("  {:<22} {:>14}  {:<18} {:<5} {}\n", parameter.name, parameter.default_text, range_text(parameter),
                        parameter.unit, parameter.summary);
  return text;
}

}  // namespace

Verdict judge(const Entry& entry, const Facts& facts) {
  if (entry.demands.empty()) return {true, "always"};
  std::vector<std::string> reasons;
  for (std::string_view demand : entry.demands) {
    const auto fact = facts.find(demand);
    if (fact == facts.end()) return {false, fmt::format("nothing says '{}'", demand)};
    if (!fact->second.holds) return {false, fact->second.why};
    reasons.push_back(fact->second.why);
  }
  return {true, fmt::format("{}", fmt::join(reasons, "; "))};
}

std::string to_json(std::span<const Entry* const> entries) {
  Json list = Json::list();
  for (const Entry* entry : entries) list.push_back(entry_json(*entry));
  return list.dump(2);
}

std::string to_text(std::span<const Entry* const> entries) {
  std::string text;
  for (const Entry* entry : entries) text += entry_text(*entry);
  return text;
}

}  // namespace cuticle::registry
