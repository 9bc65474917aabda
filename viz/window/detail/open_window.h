#pragma once
// A window that a view has filled. Private to viz/window and its tests.
#include "viz/window/detail/view.h"
#include "viz/window/display.h"

namespace cuticle::viz {

struct OpenWindow {
  OpenDisplay display;  ///< outlives the window
  vtkSmartPointer<vtkRenderWindow> window;
  WindowArea area;
};
/// `for_test`: a window too may have a virtual display. Errors: no_device, the view's own.
Result<OpenWindow> open_window(View& view, const ViewTarget& target, bool for_test = false);

}  // namespace cuticle::viz
