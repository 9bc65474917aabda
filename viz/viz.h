#pragma once
// Views of scattering lobes and strands, in a window or as a picture. Needs an X display (under xvfb-run where there is
// none).
#include <string>

#include <glm/vec2.hpp>

#include "bsdf/model.h"
#include "strands/groom.h"

namespace cuticle::viz {

/// Where a view goes: a PNG file, or (empty) a window until it is closed.
struct ViewTarget {
  std::string screenshot;
  glm::ivec2 size{1000, 800};
};

/// A polar surface of S over the outgoing directions, for light from one inclination.
struct LobesView {
  const bsdf::Model* model = nullptr;
  registry::ParameterValues values;
  double theta_i = 0;       ///< radians, -pi/2 .. pi/2
  int lobe = k_all_lobes;   ///< index into the model's lobes; -1 the sum, coloured by what each lobe gives
  bool logarithmic = true;  ///< radius: log10 S over three decades below its peak; otherwise S / peak
  static constexpr int k_all_lobes = -2;  ///< every lobe, one surface each
};

/// Strands coloured by a scalar per vertex.
struct StrandsView {
  std::string title;          ///< words for the picture, usually the file's name
  strands::Groom groom;       ///< metres
  std::vector<float> scalar;  ///< one per vertex
  std::string scalar_title;   ///< with its unit, "stretch (length / rest length)"
  double neutral = 0;         ///< with `diverging`: the value in the middle of the colours
  bool diverging = false;
};
/// A groom, or a state written by a simulation (.vtp), which is coloured by its point array `stretch`; a groom, or a
/// state without it, by arc length from the root. Error: bad_input naming the file.
Result<StrandsView> load_strands(const std::string& path, double metres_per_unit);

/// Errors: no_device without a display that opens (its hint names xvfb-run), bad_input when the picture cannot be
/// written.
Result<void> show(const LobesView& view, const ViewTarget& target);
Result<void> show(const StrandsView& view, const ViewTarget& target);

}  // namespace cuticle::viz
