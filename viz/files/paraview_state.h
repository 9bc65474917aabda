#pragma once
// A state of ParaView (File > Load State, or pvpython): a file coloured as the view colours it. Needs no VTK.
#include <string>

#include "viz/color/ramp.h"

namespace cuticle::viz {

/// As a Python state, of a file in the same folder and one of its point arrays.
std::string paraview_state(const std::string& file, const std::string& array, const ColorScale& colors);

}  // namespace cuticle::viz
