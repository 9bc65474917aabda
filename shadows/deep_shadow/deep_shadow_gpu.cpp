// Deep shadow maps on the GPU: the passes of list_gpu.h, then compression, a texel each, and lookup. The lists equal
// the CPU's; knots are kept in words only.
#include "shadows/deep_shadow/settings.h"
#include "shadows/list_gpu.h"

#include <deep_shadow_compress_comp.spv.h>
#include <deep_shadow_lookup_comp.spv.h>

namespace cuticle::shadows::deep_shadow {
namespace {

constexpr int k_counts = k_list_next, k_knots = k_list_totals + 1;  // a texel's number of knots, and those

Result<MapDescription> description(const Settings& settings) {
  if (settings.storage != KnotStorage::words)
    return usage_error("deep_shadow: storage=halves is not kept on a GPU", "storage=words");
  MapDescription map = describe_lists(settings.map);
  map.own = {float(settings.error_bound), float(settings.pieces)};
  map.buffers[k_list_fragments].kept = false;
  map.buffers[k_counts].kept = true;
  map.buffers.push_back({map.buffers[k_list_fragments].words, 0, true, false});
  map.need.grown.push_back(k_knots);
  map.passes.push_back({"shadow.compress",
                        deep_shadow_compress_comp,
                        {k_list_first, k_list_fragments, k_counts, k_knots},
                        MapRun::per_texel});
  map.passes.push_back(
      {"shadow.lookup",
       deep_shadow_lookup_comp,
       {k_vertices, k_segments, k_box, k_deposits, k_list_first, k_counts, k_knots, k_transmittance, k_receivers},
       MapRun::per_vertex});
  for (MapPass& pass : map.passes) pass.per_strip = true;
  return map;
}

}  // namespace

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"deep_shadow", create_map<Settings, description>,
                                words_of_map<Settings, sort_fragments_of<Settings>, words_of_lists>};
  return method;
}

}  // namespace cuticle::shadows::deep_shadow
