#include <fmt/format.h>

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

}  // namespace cuticle::lut
