#include "core/registry/former_names.h"

#include <algorithm>
#include <atomic>
#include <iterator>

namespace cuticle::registry {

namespace {

struct FormerName {
  std::string_view of, former, now;
};
constexpr FormerName k_former_names[] = {
    {"variant", "literal", "as_published"},
    {"", "lamp_radius", "point_light_radius"},
    {"render.method", "truth", "supersampled"},
};
std::atomic<bool> said[std::size(k_former_names)];
std::atomic<FormerNameListener> listener{nullptr};

const FormerName* find(std::string_view of, std::string_view name) {
  const auto* const found = std::ranges::find_if(
      k_former_names, [&](const FormerName& each) { return each.of == of && each.former == name; });
  return found == std::end(k_former_names) ? nullptr : found;
}

}  // namespace

std::string_view current_name(std::string_view of, std::string_view name) {
  const FormerName* const found = find(of, name);
  return found ? found->now : name;
}

std::string_view name_now(std::string_view of, std::string_view name) {
  const FormerName* const found = find(of, name);
  if (!found) return name;
  const FormerNameListener hears = listener;
  if (hears && !said[found - k_former_names].exchange(true)) hears(found->former, found->now);
  return found->now;
}

void set_former_name_listener(FormerNameListener hears) { listener = hears; }

}  // namespace cuticle::registry
