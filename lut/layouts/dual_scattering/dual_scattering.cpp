#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::dual_scattering {
namespace {

using Row = bsdf::DualScatteringRow;

glm::dvec3 forward(const Row& row) { return row.average.forward.share; }
glm::dvec3 forward_spread(const Row& row) { return row.average.forward.deviation; }
glm::dvec3 backward(const Row& row) { return row.average.backward.share; }
glm::dvec3 backward_spread(const Row& row) { return row.average.backward.deviation; }
glm::dvec3 multiple(const Row& row) { return row.multiple.attenuation; }
glm::dvec3 multiple_spread(const Row& row) { return row.multiple.deviation; }

constexpr Channel channel(std::string_view name, int component, glm::dvec3 (*number)(const Row&)) {
  return {name, bsdf::Quantity::S, "", component, Texel::point, ChannelSource::average_fibre, number};
}
constexpr Channel k_forward[] = {channel("a_f.r", 0, forward), channel("a_f.g", 1, forward),
                                 channel("a_f.b", 2, forward)};
constexpr Channel k_forward_spread[] = {channel("beta_f.r", 0, forward_spread), channel("beta_f.g", 1, forward_spread),
                                        channel("beta_f.b", 2, forward_spread)};
constexpr Channel k_backward[] = {channel("a_b.r", 0, backward), channel("a_b.g", 1, backward),
                                  channel("a_b.b", 2, backward)};
constexpr Channel k_backward_spread[] = {channel("beta_b.r", 0, backward_spread),
                                         channel("beta_b.g", 1, backward_spread),
                                         channel("beta_b.b", 2, backward_spread)};
constexpr Channel k_multiple[] = {channel("A_b.r", 0, multiple), channel("A_b.g", 1, multiple),
                                  channel("A_b.b", 2, multiple)};
constexpr Channel k_multiple_spread[] = {channel("sigma_b.r", 0, multiple_spread),
                                         channel("sigma_b.g", 1, multiple_spread),
                                         channel("sigma_b.b", 2, multiple_spread)};

constexpr Axis k_theta_o = AngleAxes::v_m;
constexpr TableLayout k_tables[] = {
    {"forward", k_theta_o, k_no_axis, k_forward},   {"forward_spread", k_theta_o, k_no_axis, k_forward_spread},
    {"backward", k_theta_o, k_no_axis, k_backward}, {"backward_spread", k_theta_o, k_no_axis, k_backward_spread},
    {"multiple", k_theta_o, k_no_axis, k_multiple}, {"multiple_spread", k_theta_o, k_no_axis, k_multiple_spread},
};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "dual_scattering",
                .summary = "rows over theta_o: the average fibre's forward and backward attenuation and spread, and "
                           "their sums over many fibres",
                .source = "Zinke, Yuksel, Weber and Keyser 2008, Dual scattering approximation"},
      .tables = k_tables,
      .composition =
          "n fibres let pass the product of n a_f, spread by the root of the sum of n beta_f^2; A_b of the "
          "light comes back, spread by sigma_b",
      .family = "dual_scattering"};
  return layout;
}

}  // namespace cuticle::lut::dual_scattering
