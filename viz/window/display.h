#pragma once
// An X display to draw with. Private to viz.
#include <memory>

#include "core/result.h"

namespace cuticle::viz {

/// The display that DISPLAY names, or for pictures, where it names none, a virtual one of our own: Xvfb, which ends
/// with this object. It is held while a view is drawn.
using OpenDisplay = std::shared_ptr<void>;
/// Error: no_device where none answers (its hint says what to install or set).
Result<OpenDisplay> open_display(bool for_window);

}  // namespace cuticle::viz
