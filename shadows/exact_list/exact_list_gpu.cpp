// The sorted lists on the GPU: the passes of list_gpu.h, then lookup; the lists equal the CPU's.
#include "shadows/exact_list/settings.h"
#include "shadows/list_gpu.h"

#include <exact_list_lookup_comp.spv.h>

namespace cuticle::shadows::exact_list {
namespace {

MapDescription description(const Settings& settings) {
  MapDescription map = describe_lists(settings.map);
  map.passes.push_back({.name = "shadow.lookup",
                        .code = exact_list_lookup_comp,
                        .buffers = {k_vertices, k_segments, k_box, k_deposits, k_list_first, k_list_fragments,
                                    k_transmittance, k_receivers},
                        .run = MapRun::per_vertex,
                        .per_strip = true});
  return map;
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"exact_list", create_map<Settings, description>,
                                words_of_map<Settings, sort_fragments_of<Settings>, words_of_lists>};
  return method;
}

}  // namespace cuticle::shadows::exact_list
