#pragma once
// The deep shadow map's parameters.
#include "shadows/deep_shadow/visibility.h"
#include "shadows/map_settings.h"

namespace cuticle::shadows::deep_shadow {

struct Settings {
  MapSettings map{.method = "deep_shadow"};
  double error_bound = 0.02;
  std::size_t pieces = k_max_pieces;
  KnotStorage storage = KnotStorage::words;
};
void describe(registry::Members& members, Settings& settings);

}  // namespace cuticle::shadows::deep_shadow
