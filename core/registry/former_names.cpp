#include "core/registry/former_names.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
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

}  // namespace

std::string_view name_now(std::string_view of, std::string_view name) {
  const auto* const found = std::ranges::find_if(
      k_former_names, [&](const FormerName& each) { return each.of == of && each.former == name; });
  if (found == std::end(k_former_names)) return name;
  if (!said[found - k_former_names].exchange(true))
    std::fprintf(stderr, "cuticle: '%.*s' is called '%.*s' now; the next version no longer reads the former name\n",
                 int(found->former.size()), found->former.data(), int(found->now.size()), found->now.data());
  return found->now;
}

}  // namespace cuticle::registry
