// Every fragment of every texel, sorted by depth: the ceiling of what a map of the light's view can do.
#include <algorithm>

#include <cuticle/shadows/detail/fragment_lists.h>
#include <cuticle/shadows/detail/map_method.h>

namespace cuticle::shadows::exact_list {
namespace {

constexpr registry::Parameter k_parameters[] = {k_resolution, k_optical_k, k_filter_texels, k_filter_radius,
                                                k_accumulate};
constexpr std::string_view k_demands[] = {"light", "shadow_method"};
constexpr registry::StudyCase k_cases[] = {{"default", ""}};

struct Settings {
  MapSettings map;
};

/// The sum of the fragments that lie in steps before that of depth z.
float sum_before(const FragmentLists& lists, std::size_t texel, float z) {
  const std::span<const Fragment> list = lists.of(texel);
  const auto behind =
      std::lower_bound(list.begin(), list.end(), std::uint32_t(z),
                       [](const Fragment& fragment, std::uint32_t step) { return fragment.depth < step; });
  return behind == list.begin() ? 0.0f : float((behind - 1)->sum);
}

Result<FragmentLists> build(const strands::Groom& groom, double alpha, const LightAxes& axes,
                            const Settings& settings) {
  return sort_fragments("exact_list", groom, alpha, axes, settings.map);
}

std::vector<float> look_up(const FragmentLists& lists, const Settings& settings, float filter,
                           std::span<const glm::vec3> points) {
  const auto sum = [&](std::size_t texel, float z) { return sum_before(lists, texel, z); };
  return look_up_points(lists.view, settings.map, lists.scale, filter, k_behind_lists, points, sum);
}

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  return evaluate_by_map(
      "exact_list", casters, receivers, Settings{map_settings(values)}, build, look_up,
      [](const FragmentLists& lists) { return sizeof(Fragment) * lists.fragments.size() + 4 * lists.first.size(); });
}

}  // namespace

const Method& entry() {
  static const Method method{{registry::EntryKind::method,
                              "exact_list",
                              "every fragment of every texel, sorted by depth: the ceiling of what a map can do",
                              "the sorted list of Lokovic and Veach 2000, section 3.1, kept whole",
                              k_parameters,
                              k_demands,
                              registry::Stage::shadow,
                              {},
                              k_cases},
                             evaluate};
  return method;
}

}  // namespace cuticle::shadows::exact_list
