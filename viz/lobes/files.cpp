// What the view of lobes shows, as files.
#include <numbers>

#include <fmt/format.h>

#include "core/file.h"
#include "viz/files/vtk_xml.h"
#include "viz/lobes/curves.h"
#include "viz/lobes/surface.h"

namespace cuticle::viz {
namespace {

std::vector<float> narrowed(const std::vector<double>& values) { return {values.begin(), values.end()}; }

std::vector<NamedArray> arrays_of(const LobeValues& values) {
  std::vector<NamedArray> arrays = {{"S_sum", "1/sr", 1, narrowed(values.sum())}};
  for (std::size_t lobe = 0; lobe < values.lobes.size(); ++lobe)
    arrays.push_back({"S_" + values.lobes[lobe], "1/sr", 1, narrowed(values.values[lobe])});
  NamedArray theta{"theta_o_deg", "deg", 1, {}}, phi{"phi_deg", "deg", 1, {}};
  for (int row = 0; row < values.grid.rows; ++row)
    for (int column = 0; column < values.grid.columns; ++column) {
      theta.values.push_back(float(values.grid.theta_o(row) * 180 / std::numbers::pi));
      phi.values.push_back(float(values.grid.phi(column) * 180 / std::numbers::pi));
    }
  arrays.push_back(std::move(theta));
  arrays.push_back(std::move(phi));
  return arrays;
}

/// The surface of the sum: what ParaView opens looks like the view.
Result<std::string> surface_file(const ShownModel& shown, const LobeSettings& settings) {
  CUTICLE_ASSIGN(const LobeValues values, lobe_values(shown, settings, {}, true));
  LobeSettings of_sum = settings;
  of_sum.lobe = "sum";
  CUTICLE_ASSIGN(const auto surfaces, make_surfaces(values, of_sum, peak_of(values, "sum")));
  std::vector<glm::vec3> points(surfaces[0].positions.begin(), surfaces[0].positions.end());
  return format_vts({values.grid.columns, values.grid.rows, 1}, points, arrays_of(values));
}

void append_curves(std::string& text, char quantity, const std::vector<LobeCurve>& curves) {
  for (const LobeCurve& curve : curves)
    for (const glm::dvec2& point : curve.points)
      text += fmt::format("{},{},{},{}\n", quantity, curve.lobe, point.x, point.y);
}

}  // namespace

Result<void> write_lobes(const LobesView& view, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  for (const ShownModel& shown : view.models) {
    const std::string name(shown.model->entry.name);
    CUTICLE_ASSIGN(const std::string surface, surface_file(shown, view.settings));
    CUTICLE_TRY(write_text_file(fmt::format("{}/lobes_{}.vts", folder, name), surface));
    CUTICLE_ASSIGN(const auto along, longitudinal_curves(shown, view.settings));
    CUTICLE_ASSIGN(const auto around, azimuthal_curves(shown, view.settings));
    std::string curves = "quantity,lobe,angle_deg,value_1_per_rad\n";
    append_curves(curves, 'M', along);
    append_curves(curves, 'N', around);
    CUTICLE_TRY(write_text_file(fmt::format("{}/curves_{}.csv", folder, name), curves));
  }
  return {};
}

}  // namespace cuticle::viz
