#pragma once
// A live window on a session (GLFW): drag to orbit, with the right button to shift, wheel to come nearer; space pauses,
// full stop steps, R restarts, Escape closes; controls at the right.
#include "play/panel.h"

namespace cuticle::play {

struct WindowOptions {
  int pictures = 0;        ///< close after so many pictures; 0: when the user does
  std::string screenshot;  ///< PNG of the window as last seen; empty: none
};
struct WindowReport {
  int pictures = 0;                    ///< drawn by the renderer, not windows refreshed
  std::vector<ControlPlace> controls;  ///< where they stood at the end
};

/// Shows the session until the window is closed. Errors: no_device where there is no display or no OpenGL 3; those of
/// Session::advance; of writing the PNG.
Result<WindowReport> show(Session& session, const WindowOptions& options);

}  // namespace cuticle::play
