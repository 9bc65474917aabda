#pragma once
// A view of scattering lobes: S over the outgoing directions as surfaces, M and N beside them. Needs no VTK.
#include <string>
#include <vector>

#include "bsdf/model.h"

namespace cuticle::viz {

/// A model with its parameters.
struct ShownModel {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
};
/// What is shown of every model.
struct LobeSettings {
  double theta_i = 0;        ///< of the light, radians, -pi/2 .. pi/2
  std::string lobe = "all";  ///< "all": a surface each; "sum": coloured by share; or a lobe's name
  bool logarithmic = true;   ///< radius: log10 S over three decades below its peak; otherwise S / peak
  double h = 0;              ///< of near-field models, -1 .. 1
};
struct LobesView {
  std::vector<ShownModel> models;  ///< one, or two side by side
  LobeSettings settings;
  bool difference = false;  ///< of two: one surface of both, coloured by (second - first) / (second + first)
};

/// Writes what the view shows as lobes_MODEL.vts (point arrays S_LOBE and S_sum [1/sr], theta_o_deg, phi_deg) and
/// curves_MODEL.csv. Error: bad_input naming the file.
Result<void> write_lobes(const LobesView& view, const std::string& folder);

}  // namespace cuticle::viz
