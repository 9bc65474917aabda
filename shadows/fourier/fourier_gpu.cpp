// Fourier opacity maps on the GPU: clear (fills), fit, splat, lookup; the integers of the map equal the CPU's.
#include "shadows/fourier/fourier_map.h"
#include "shadows/map_shadow_gpu.h"

#include <fourier_lookup_comp.spv.h>

namespace cuticle::shadows::fourier {
namespace {

MapDescription description(const Settings& settings) {
  MapDescription map = describe_series(settings.map, settings.functions(), weights(settings), fourier_lookup_comp);
  map.own = {float(settings.smoothing)};
  return map;
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"fourier", create_map<Settings, description>,
                                words_of_map<Settings, build_map, k_series_words>};
  return method;
}

}  // namespace cuticle::shadows::fourier
