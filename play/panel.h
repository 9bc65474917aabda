#pragma once
// The controls beside the picture: what is done to them becomes actions.
#include <string>
#include <vector>

#include "play/session.h"

namespace cuticle::play {

/// Where a control stood when it was last drawn, pixels of the window.
struct ControlPlace {
  std::string name;  ///< "pause", "step", "restart", "method", or "entry.parameter"
  int x = 0, y = 0, width = 0, height = 0;
};

/// Draws the controls into the current ImGui window and adds to the actions what was done to them.
std::vector<ControlPlace> draw_panel(const Session& session, Actions& actions);

}  // namespace cuticle::play
