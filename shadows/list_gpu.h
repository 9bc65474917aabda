#pragma once
// Lists of fragments on the device (detail/fragment_lists.h): counted, placed, filled and sorted by compute passes.
#include "shadows/fragment_lists.h"
#include "shadows/map_shadow_gpu.h"

namespace cuticle::shadows {

/// Buffers of the lists: where each texel's begins, and the end; fragments, two words each; what only fills them.
enum ListBinding : int { k_list_first = k_own, k_list_fragments, k_list_next, k_list_totals };

/// The passes "shadow.count", "rows", "totals", "begin", "fill" and "sort"; push.layers: room for fragments. A lookup
/// is added by the method.
MapDescription describe_lists(const MapSettings& settings);

/// The words that the first two buffers must hold.
MapWords words_of_lists(const FragmentLists& lists);

}  // namespace cuticle::shadows
