#include "shadows/list_gpu.h"

#include <algorithm>

#include <list_begin_comp.spv.h>
#include <list_count_comp.spv.h>
#include <list_fill_comp.spv.h>
#include <list_rows_comp.spv.h>
#include <list_sort_comp.spv.h>
#include <list_totals_comp.spv.h>

namespace cuticle::shadows {
namespace {

constexpr std::uint64_t k_first_room = 16 << 20;  // bytes

}  // namespace

MapDescription describe_lists(const MapSettings& settings) {
  const std::uint64_t side = settings.resolution, texels = side * side;
  MapDescription map;
  map.settings = settings;
  map.intervals = k_list_steps;
  const std::uint64_t begins_with = std::min<std::uint64_t>(settings.list_room(), k_first_room);
  map.layers = std::uint32_t(begins_with / sizeof(Fragment));
  map.need = {.counter = k_list_totals,
              .room = map.layers,
              .most_room = settings.list_room() / sizeof(Fragment),
              .grown = {k_list_fragments},
              .counting = 3,
              .item_bytes = sizeof(Fragment),
              .items = "fragments in the fullest strip of rows",
              .advice = "raise room_mib or lower the resolution"};
  map.pieces_per_step = k_list_pieces_per_step;
  map.buffers = {{texels + 1, 0, true, false},
                 {begins_with / 4, 0, true, false},
                 {.words = texels, .kept = false, .cleared_per_strip = true},
                 {side + 1, 0, false}};
  map.passes = {
      {"shadow.count", list_count_comp, {k_vertices, k_segments, k_box, k_deposits, k_list_next}},
      {"shadow.rows", list_rows_comp, {k_list_next, k_list_first, k_list_totals}, MapRun::per_row},
      {"shadow.totals", list_totals_comp, {k_list_first, k_list_totals}, MapRun::one_group},
      {"shadow.begin", list_begin_comp, {k_list_first, k_list_totals, k_list_next}, MapRun::per_texel},
      {"shadow.fill", list_fill_comp, {k_vertices, k_segments, k_box, k_deposits, k_list_next, k_list_fragments}},
      {"shadow.sort", list_sort_comp, {k_list_first, k_list_fragments}, MapRun::per_texel}};
  for (MapPass& pass : map.passes) pass.per_strip = true;
  return map;
}

MapWords words_of_lists(const FragmentLists& lists) {
  MapWords words = {lists.first, {}};
  for (const Fragment& fragment : lists.fragments) {
    words[1].push_back(fragment.depth);
    words[1].push_back(fragment.sum);
  }
  return words;
}

}  // namespace cuticle::shadows
