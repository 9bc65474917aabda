#pragma once
// A window with its panel, mouse and keys. Private to viz/window.
#include <memory>

#include <vtkRenderWindowInteractor.h>

#include "viz/window/detail/view.h"

namespace cuticle::viz {

/// A view in a window with a panel. The mouse sets sliders, takes hold of what the view lets it, else turns the camera;
/// a click picks, and prints what it found. Keys: space runs through the frames, x writes files, s a picture, q leaves.
class Interaction {
 public:
  Interaction(View& view, const WindowArea& area, const ViewTarget& target);
  ~Interaction();
  Interaction(const Interaction&) = delete;
  Interaction& operator=(const Interaction&) = delete;
  vtkRenderWindowInteractor& interactor();
  /// Where the panel's slider of this name stands for a value: pixels of the window.
  glm::ivec2 knob(const std::string& control, double value) const;
  /// The first error that the view met.
  Result<void> result() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

Result<void> interact(View& view, const WindowArea& area, const ViewTarget& target);

}  // namespace cuticle::viz
