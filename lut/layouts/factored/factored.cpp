#include "lut/layouts/factored/slices.h"
#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::factored {
namespace {

constexpr Channel solved(std::string_view name, int component) {
  return {name, bsdf::Quantity::S, "", component, Texel::point, ChannelSource::solver};
}
constexpr Channel k_f[] = {solved("F1", 0), solved("F2", 1), solved("F3", 2)};
constexpr Channel k_g1[] = {solved("G1.r", 0), solved("G1.g", 1), solved("G1.b", 2)};
constexpr Channel k_g2[] = {solved("G2.r", 0), solved("G2.g", 1), solved("G2.b", 2)};
constexpr Channel k_g3[] = {solved("G3.r", 0), solved("G3.g", 1), solved("G3.b", 2)};
constexpr TableLayout k_tables[] = {
    {"F", AngleAxes::u_m, AngleAxes::v_m, k_f},
    {"G1", AngleAxes::u_n, AngleAxes::v_n, k_g1},
    {"G2", AngleAxes::u_n, AngleAxes::v_n, k_g2},
    {"G3", AngleAxes::u_n, AngleAxes::v_n, k_g3},
};
constexpr Term k_terms[] = {{{"F1", "G1"}}, {{"F2", "G2"}}, {{"F3", "G3"}}};
constexpr std::string_view k_systems[] = {"N22"};

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "factored",
                .summary = "S of any far-field model as three products found numerically: F over the inclinations, G "
                           "over phi and theta_d",
                .source = "after McCool, Ang and Ahmad 2001, Homomorphic factorization of BRDFs; here a nonnegative "
                          "sum of products",
                .systems = k_systems},
      .tables = k_tables,
      .composition = "S = F1 G1 + F2 G2 + F3 G3",
      .terms = k_terms,
      .family = "factored",
      .points_of_mean = k_points,
      .solve = solve};
  return layout;
}

}  // namespace cuticle::lut::factored
