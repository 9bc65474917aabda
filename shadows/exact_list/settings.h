#pragma once
// The sorted lists' parameters.
#include "shadows/map_settings.h"

namespace cuticle::shadows::exact_list {

struct Settings {
  MapSettings map{.method = "exact_list"};
};
inline void describe(registry::Members& members, Settings& settings) {
  describe(members, settings.map);
  describe_room(members, settings.map);
}

}  // namespace cuticle::shadows::exact_list
