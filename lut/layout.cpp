#include <fmt/format.h>

#include "lut/comparison.h"
#include "lut/format.h"
#include "lut/table_set.h"

namespace cuticle::lut {
namespace {

Error unknown(std::string_view what, std::string_view name, std::span<const std::string_view> known) {
  const std::string near = registry::nearest_name(name, known);
  return usage_error(fmt::format("{}: '{}' is not one of {}", what, name, fmt::join(known, ", ")),
                     near.empty() ? "" : fmt::format("--{} {}", what, near));
}

}  // namespace

Result<const Layout*> find_layout(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Layout* layout : layouts()) {
    if (layout->entry.name == name) return layout;
    known.push_back(layout->entry.name);
  }
  return unknown("layout", name, known);
}

Result<const Format*> find_format(std::string_view name) {
  std::vector<std::string_view> known;
  for (const Format* format : formats()) {
    if (format->name == name) return format;
    known.push_back(format->name);
  }
  return unknown("format", name, known);
}

namespace {

constexpr std::string_view k_candidates[] = {"nalu_caustic", "nalu_theta", "deon", "chiang",
                                             "yan_fur"};  ///< the least bytes first
constexpr std::string_view k_any_model = "factored";
constexpr double k_max_error = 0.01;

}  // namespace

Result<const Layout*> find_layout(std::string_view name, const bsdf::Model& model,
                                  const registry::ParameterValues& values) {
  if (name != k_best_layout) return find_layout(name);
  for (const Layout* layout : layouts())
    if (layout->model == model.entry.name) return layout;
  const Source source = cpu_source(model, values);
  CUTICLE_ASSIGN(const Layout* best, find_layout(k_any_model));
  double least = k_max_error;
  for (const std::string_view candidate : k_candidates) {
    CUTICLE_ASSIGN(const Layout* layout, find_layout(candidate));
    if (!check_bakeable(source, values, *layout).ok()) continue;
    CUTICLE_ASSIGN(const double error, assumption_error(source, *layout));
    if (error >= 0.5 * least) continue;
    least = error;
    best = layout;
  }
  return best;
}

}  // namespace cuticle::lut
