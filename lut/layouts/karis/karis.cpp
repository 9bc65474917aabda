#include <cmath>

#include "lut/evaluate.h"
#include "lut/layouts/nalu_channels.h"

namespace cuticle::lut::karis {
namespace {

constexpr Channel smooth(std::string_view name, bsdf::Quantity quantity, std::string_view lobe, int component = 0) {
  return {name, quantity, lobe, component, Texel::for_filter};
}
constexpr Channel k_m[] = {smooth("M_R", bsdf::Quantity::M, "R"), smooth("M_TT", bsdf::Quantity::M, "TT"),
                           smooth("M_TRT", bsdf::Quantity::M, "TRT")};
constexpr Channel k_n_tt[] = {smooth("N_TT.r", bsdf::Quantity::N, "TT", 0), smooth("N_TT.g", bsdf::Quantity::N, "TT", 1),
                              smooth("N_TT.b", bsdf::Quantity::N, "TT", 2)};
constexpr Channel k_n_trt[] = {smooth("N_TRT.r", bsdf::Quantity::N, "TRT", 0),
                               smooth("N_TRT.g", bsdf::Quantity::N, "TRT", 1),
                               smooth("N_TRT.b", bsdf::Quantity::N, "TRT", 2)};
constexpr Channel k_n_r[] = {{"N_R", bsdf::Quantity::N, "", 0, Texel::for_filter, ChannelSource::solver}};

/// N_R has half the angle between light and viewer where the other lobes have theta_d.
constexpr Axis k_between{AxisQuantity::theta_between, 0, AngleAxes::right, true};
constexpr TableLayout k_tables[] = {{"M", AngleAxes::u_m, AngleAxes::v_m, k_m},
                                    {"N_TT", AngleAxes::u_n, AngleAxes::v_n, k_n_tt},
                                    {"N_TRT", AngleAxes::u_n, AngleAxes::v_n, k_n_trt},
                                    {"N_R", AngleAxes::u_n, k_between, k_n_r}};
constexpr std::string_view k_systems[] = {"N12"};

/// N_R = cos(phi / 2) F(theta_between) / 4; F is A_R at h = 0, by the angle that stands in theta_d's place.
Result<void> solve(const Source& source, TableSet& set, Progress&) {
  const auto value = [&](const Axis& axis, int texel) { return axis_value(axis, set.size, (texel + 0.5) / set.size); };
  std::vector<bsdf::Point> points(std::size_t(set.size));
  for (int y = 0; y < set.size; ++y) points[std::size_t(y)].theta_d = value(k_between, y);
  const Channel reflectance{"A_R", bsdf::Quantity::A, "R", 0};
  CUTICLE_ASSIGN(const auto found, evaluate_points(*source.model, source.evaluate, reflectance, points));
  Table& table = set.tables[3];
  for (int y = 0; y < set.size; ++y)
    for (int x = 0; x < set.size; ++x)
      table.image.at(x, y, 0) = float(0.25 * std::cos(value(AngleAxes::u_n, x) / 2) * found[std::size_t(y)].x);
  suit_to_filter(table);
  return {};
}

}  // namespace

const Layout& entry() {
  static const Layout layout{
      .entry = {.kind = registry::EntryKind::layout,
                .name = "karis",
                .summary = "karis by what it depends on: M; N_TT and N_TRT over phi and theta_d; N_R over phi and half "
                           "the angle between light and viewer",
                .source = "ours, of Karis 2016",
                .systems = k_systems},
      .tables = k_tables,
      .composition = k_three_textures,
      .terms = k_nalu_terms,
      .family = "karis",
      .model = "karis",
      .solve = solve};
  return layout;
}

}  // namespace cuticle::lut::karis
