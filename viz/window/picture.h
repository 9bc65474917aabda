#pragma once
// Pictures and movies of a window that nobody sees. Private to viz/window.
#include "viz/window/detail/view.h"

namespace cuticle::viz {

Result<void> write_picture(vtkRenderWindow& window, const std::string& path);
/// The view's run, or a turn of it, as the target says.
Result<void> write_movie(View& view, vtkRenderWindow& window, const ViewTarget& target);

}  // namespace cuticle::viz
