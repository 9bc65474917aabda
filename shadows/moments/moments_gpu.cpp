// Moments on the GPU: clear (fills), fit, splat, lookup; the integers of the map equal the CPU's.
#include "shadows/map_shadow_gpu.h"
#include "shadows/moments/moment_map.h"

#include <moments_lookup_comp.spv.h>

namespace cuticle::shadows::moments {
namespace {

MapDescription description(const Settings& settings) {
  MapDescription map = describe_series(settings.map, settings.functions(), weights(settings), moments_lookup_comp);
  map.passes.back().constants.push_back(settings.basis == Basis::trigonometric_4 ? 1 : 0);  // k_trigonometric
  map.own = {float(settings.bias()), float(settings.overestimation)};
  return map;
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"moments", create_map<Settings, description>,
                                words_of_map<Settings, build_map, k_series_words>};
  return method;
}

}  // namespace cuticle::shadows::moments
