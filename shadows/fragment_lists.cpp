#include "shadows/fragment_lists.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include <fmt/core.h>

#include "shadows/detail/map_walk.h"

namespace cuticle::shadows {
namespace {

using Word = std::uint32_t;

constexpr std::uint64_t k_max_fragments = (2ull << 30) / sizeof(Fragment);

/// visit(texel, fragment) for every deposit, on all threads; `sum` of the fragment is its own deposit.
void for_each_fragment(const MapView& view, const strands::Groom& groom, std::span<const Word> table,
                       const auto& visit) {
  for_each_covered_texel(view, groom, k_list_pieces_per_step, [&](std::size_t texel, Word covered, Word depth) {
    if (table[covered] > 0) visit(texel, Fragment{depth, table[covered]});
  });
}

Word next(Word& counter) { return std::atomic_ref(counter).fetch_add(1, std::memory_order_relaxed); }

/// By depth, then by deposit, so that the order in which threads wrote them does not matter; deposits become sums.
void sort_and_sum(std::span<Fragment> list) {
  std::sort(list.begin(), list.end(), [](const Fragment& a, const Fragment& b) {
    return a.depth != b.depth ? a.depth < b.depth : a.sum < b.sum;
  });
  for (std::size_t i = 1; i < list.size(); ++i) list[i].sum += list[i - 1].sum;
}

/// Numbers of fragments become where each list begins. Error: usage, when they are too many.
Result<void> begin_lists(std::string_view method, std::vector<Word>& first) {
  const std::uint64_t count = std::accumulate(first.begin(), first.end(), std::uint64_t(0));
  if (count > k_max_fragments)
    return usage_error(
        fmt::format("{}: {} fragments in the lists, more than {} (2 GiB)", method, count, k_max_fragments),
        "a lower resolution");
  std::partial_sum(first.begin(), first.end(), first.begin());
  return {};
}

}  // namespace

Result<FragmentLists> sort_fragments(const strands::Groom& groom, double alpha, const LightAxes& axes,
                                     const MapSettings& settings) {
  FragmentLists lists;
  lists.view = map_view(axes, light_box(axes, groom.positions), settings.resolution, k_list_steps);
  const std::size_t texels = lists.view.texels();
  lists.scale = fixed_point_scale(alpha, settings.accumulation, groom.vertex_count() - groom.strand_count());
  lists.first.resize(texels + 1);
  lists.table = deposit_table(alpha, settings.accumulation, lists.scale);
  for_each_fragment(lists.view, groom, lists.table,
                    [&](std::size_t texel, const Fragment&) { next(lists.first[texel + 1]); });
  CUTICLE_TRY(begin_lists(settings.method, lists.first));
  lists.fragments.resize(lists.first.back());
  std::vector<Word> unused(lists.first.begin(), lists.first.end() - 1);
  for_each_fragment(lists.view, groom, lists.table, [&](std::size_t texel, const Fragment& fragment) {
    lists.fragments[next(unused[texel])] = fragment;
  });
  for_each_index(texels, [&](std::size_t texel) {
    sort_and_sum(std::span(lists.fragments).subspan(lists.first[texel], lists.first[texel + 1] - lists.first[texel]));
  });
  return lists;
}

}  // namespace cuticle::shadows
