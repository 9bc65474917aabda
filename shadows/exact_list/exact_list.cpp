// Every fragment of every texel, sorted by depth: the ceiling of what a map of the light's view can do.
#include <algorithm>

#include "shadows/detail/map_method.h"
#include "shadows/exact_list/settings.h"
#include "shadows/fragment_lists.h"

namespace cuticle::shadows::exact_list {
namespace {

constexpr registry::StudyCase k_cases[] = {{"default", ""}};

/// The sum of the fragments that lie in steps before that of depth z, without those of the receiver's own fibre.
float sum_before(const FragmentLists& lists, std::size_t texel, float z, std::span<const OwnDeposit> own) {
  const std::span<const Fragment> list = lists.of(texel);
  const auto before = std::uint32_t(z);
  const auto behind =
      std::lower_bound(list.begin(), list.end(), before,
                       [](const Fragment& fragment, std::uint32_t step) { return fragment.depth < step; });
  std::uint32_t sum = behind == list.begin() ? 0 : (behind - 1)->sum;
  for (const OwnDeposit& deposit : own) sum -= deposit.step < before ? lists.table[deposit.covered] : 0;
  return float(sum);
}

Result<std::vector<float>> look_up(const FragmentLists& lists, const Settings& settings, const Asked& asked) {
  const float per_unit = exponent_per_unit(settings.map, lists.scale);
  return look_up_receivers(lists.view, settings.map, k_behind_lists, k_list_pieces_per_step, asked,
                           [&](std::size_t, float z, float) {
                             return [&, z](std::size_t texel, std::span<const OwnDeposit> own) {
                               return per_unit * sum_before(lists, texel, z, own);
                             };
                           });
}

}  // namespace

/// Passes: fit, count, rows, totals, begin, fill, sort, lookup; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<Settings, sort_fragments_of<Settings>, look_up>(
      {.name = "exact_list",
       .summary = "every fragment of every texel, sorted by depth: the ceiling of what a map can do",
       .source = "the sorted list of Lokovic and Veach 2000, section 3.1, kept whole",
       .study_cases = k_cases,
       .dispatches = passes_per_light<8>},
      is_poisson<Settings>);
  return method;
}

}  // namespace cuticle::shadows::exact_list
