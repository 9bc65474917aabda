#pragma once
// M and N of a model as curves beside its surfaces. Private to viz. Needs no VTK.
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "viz/lobes/lobes.h"

namespace cuticle::viz {

/// Values over degrees; the mean of r, g and b.
struct LobeCurve {
  std::string lobe;
  std::vector<glm::dvec2> points;
};
/// M of every lobe over theta_o, -90 .. 90 degrees, for the light's theta_i [1/rad].
Result<std::vector<LobeCurve>> longitudinal_curves(const ShownModel& shown, const LobeSettings& settings);
/// N of every lobe over phi, -180 .. 180 degrees, at the mirror direction's theta_d = -theta_i, averaged over half a
/// degree [1/rad].
Result<std::vector<LobeCurve>> azimuthal_curves(const ShownModel& shown, const LobeSettings& settings);
/// Near field: N of all lobes together over phi at offsets h.
Result<std::vector<LobeCurve>> azimuthal_slices(const ShownModel& shown, const LobeSettings& settings);
bool is_near_field(const ShownModel& shown);
/// Where M of a lobe is largest, radians: the inclination of its cone.
double cone_of(const LobeCurve& longitudinal);

}  // namespace cuticle::viz
