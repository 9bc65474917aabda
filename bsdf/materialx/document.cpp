#include "bsdf/materialx/document.h"

#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "bsdf/materialx/helpers.h"
#include "core/registry/parameter.h"

namespace cuticle::bsdf::materialx {
namespace {

Error unknown(std::string_view where, std::string_view what, std::string_view name,
              const std::vector<std::string_view>& known) {
  const std::string near = registry::nearest_name(name, known);
  return bad_input(fmt::format("{}: {} '{}' is not one of {}", where, what, name, fmt::join(known, ", ")),
                   near.empty() ? std::string() : fmt::format("did you mean {}?", near));
}

std::vector<std::string_view> input_names(const NodeSpec& spec) {
  std::vector<std::string_view> names;
  for (const InputSpec& input : spec.inputs) names.push_back(input.name);
  return names;
}

const InputSpec* find_input(const NodeSpec& spec, std::string_view name) {
  for (const InputSpec& input : spec.inputs)
    if (input.name == name) return &input;
  return nullptr;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// "0.1, 0.2" as numbers; empty where a part is none.
std::vector<double> parsed_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string_view part = trimmed(text.substr(start, end - start));
    double number = 0;
    const auto [stop, code] = std::from_chars(part.data(), part.data() + part.size(), number);
    if (code != std::errc() || stop != part.data() + part.size() || !std::isfinite(number)) return {};
    numbers.push_back(number);
    start = end + 1;
  }
  return numbers;
}

/// The element of that name beside `sibling`.
pugi::xml_node named_sibling(const pugi::xml_node& sibling, std::string_view name) {
  for (const pugi::xml_node& candidate : sibling.parent().children())
    if (name == candidate.attribute("name").value() && candidate.type() == pugi::node_element) return candidate;
  return {};
}

}  // namespace

Result<HairNode> HairNode::make(const pugi::xml_node& element, std::string_view file) {
  const std::string where = fmt::format("{}: {} '{}'", file, element.name(), element.attribute("name").value());
  std::vector<std::string_view> known;
  for (const NodeSpec& spec : node_specs) {
    known.push_back(spec.category);
    if (spec.category != element.name()) continue;
    HairNode node(element, spec, where);
    CUTICLE_TRY(node.check_inputs());
    return node;
  }
  return unknown(where, "node", element.name(), known);
}

Result<void> HairNode::check_inputs() const {
  for (pugi::xml_node input = element_.child("input"); input; input = input.next_sibling("input")) {
    const std::string_view name = input.attribute("name").value(), type = input.attribute("type").value();
    const InputSpec* known = find_input(*spec_, name);
    if (!known) return unknown(where_, "input", name, input_names(*spec_));
    if (type != known->type)
      return bad_input(fmt::format("{}: input {} has type '{}', not {}", where_, name, type, known->type));
    if (element_.find_child_by_attribute("input", "name", known->name.data()) != input)
      return bad_input(fmt::format("{}: input {} is given twice", where_, name));
  }
  return {};
}

Result<Numbers> HairNode::number_value(const InputSpec& input, const pugi::xml_node& element) const {
  const std::string_view text = element.attribute("value").value();
  const std::vector<double> parsed = parsed_numbers(text);
  const int count = numbers_of(input.type);
  if (int(parsed.size()) != count)
    return bad_input(fmt::format("{}: input {}: '{}' is not {} number{}", where_, input.name, text, count,
                                 count == 1 ? "" : "s with commas between"));
  Numbers numbers{};
  for (int k = 0; k < count; ++k) {
    if (!(parsed[k] >= input.minimum && parsed[k] <= input.maximum))
      return bad_input(fmt::format("{}: input {}: {} is outside {:g} .. {:g}", where_, input.name, parsed[k],
                                   input.minimum, input.maximum));
    numbers[k] = parsed[k];
  }
  return numbers;
}

Result<Numbers> HairNode::connected_value(const InputSpec& input, const pugi::xml_node& element) const {
  const std::string_view target = element.attribute("nodename").value();
  const pugi::xml_node found = named_sibling(element_, target);
  if (!found)
    return bad_input(
        fmt::format("{}: input {} is connected to '{}', which is no node beside it", where_, input.name, target));
  CUTICLE_ASSIGN(const HairNode node, make(found, where_.substr(0, where_.rfind(": "))));
  if (node.spec().output_type != input.type)
    return bad_input(fmt::format("{}: input {} has type {}, but '{}' gives {}", where_, input.name, input.type, target,
                                 node.spec().output_type));
  std::string_view output = element.attribute("output").value();
  if (output.empty()) output = node.spec().outputs[0];
  for (std::string_view known : node.spec().outputs)
    if (known == output) return helper_value(node, output);
  return unknown(where_, "output", output, {node.spec().outputs.begin(), node.spec().outputs.end()});
}

Result<Numbers> HairNode::value(std::string_view name) const {
  const InputSpec* input = find_input(*spec_, name);
  CUTICLE_EXPECT(input != nullptr, "an input is asked for by a name of its node");
  const pugi::xml_node element = element_.find_child_by_attribute("input", "name", input->name.data());
  if (!element) return input->fallback;
  if (element.attribute("nodename")) return connected_value(*input, element);
  if (element.attribute("value")) return number_value(*input, element);
  return bad_input(fmt::format("{}: input {} has neither value nor nodename", where_, name),
                   "connections through nodegraphs and interfaces are not followed: give the value");
}

}  // namespace cuticle::bsdf::materialx
