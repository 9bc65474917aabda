#include <algorithm>

#include "bsdf/turns.h"
#include "lut/evaluate.h"

namespace cuticle::lut {
namespace {

constexpr int k_turns_of_means = 128, k_turns_of_points = 16, k_turns_of_averages = 2;

template <class Holds>
bool any_channel(const Layout& layout, Holds holds) {
  return std::ranges::any_of(layout.tables,
                             [&](const TableLayout& table) { return std::ranges::any_of(table.channels, holds); });
}

}  // namespace

registry::ParameterValues table_values(const bsdf::Model& model, const registry::ParameterValues& values,
                                       const Layout& layout) {
  if (any_channel(layout, [](const Channel& c) { return c.average != nullptr; }))
    return bsdf::over_turns(values, k_turns_of_averages);
  const registry::ParameterValues averaged = bsdf::over_turns(values, k_turns_of_means);
  const bool has_means = any_channel(layout, [](const Channel& c) { return c.texel == Texel::cell_average; }) &&
                         model.azimuthal_means && model.azimuthal_means(averaged, 0, {}, {});
  return has_means ? averaged : bsdf::over_turns(values, k_turns_of_points);
}

}  // namespace cuticle::lut
