#pragma once
// What a view gives to the window, picture or movie that shows it. Private to viz.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <glm/vec2.hpp>

#include "core/result.h"
#include "viz/target.h"

namespace cuticle::viz {

/// A number, a choice or a switch that the panel of a window shows, with a slider or buttons.
struct Control {
  std::string name, unit;
  double minimum = 0, maximum = 1, value = 0;
  std::vector<std::string> choices = {};  ///< value: the place in them
  bool is_integer = false;
  /// `resting`: the mouse is up, so that there is time for the full resolution.
  std::function<Result<void>(double value, bool resting)> set = {};
};

/// The part of a window that a view fills: all of it in a picture, what the panel leaves in a window.
struct WindowArea {
  vtkRenderWindow* window = nullptr;
  double left = 0;   ///< share of the width that the panel takes
  double scale = 1;  ///< of fonts and lines: the window's height over 900
  /// A renderer with a white background in a part of the area, shares of it from the lower left corner.
  vtkSmartPointer<vtkRenderer> add_renderer(double x0, double y0, double x1, double y1) const;
};

/// Samples of a pixel at rest. While the camera moves there is one: software OpenGL needs a third of the time.
inline constexpr int k_samples = 8;

class View {
 public:
  virtual ~View() = default;
  virtual std::string title() const = 0;
  virtual Result<void> fill(const WindowArea& area) = 0;

  virtual std::vector<Control> controls() { return {}; }
  /// By so many degrees about the upright axis.
  virtual void turn(double degrees) = 0;
  /// Frames of a run, and the one shown.
  virtual int frame_count() const { return 0; }
  virtual Result<void> show_frame(int) { return {}; }
  /// The mouse goes down: whether the view takes hold of something there, so that the camera stays.
  virtual bool grab(const glm::ivec2&) { return false; }
  virtual Result<void> drag(const glm::ivec2&, bool) { return {}; }
  /// What is found at a pixel that was clicked, as lines for stdout; empty: nothing.
  virtual Result<std::string> pick(const glm::ivec2&) { return std::string(); }
  /// The camera turns, so that there is no time for everything.
  virtual void set_moving(bool) {}
  /// Writes what is shown into a folder.
  virtual Result<void> write_files(const std::string& folder) = 0;
};

/// A view of `Shown`, the numbers and choices that it was asked for.
template <class Shown>
class ViewOf : public View {
 public:
  std::string title() const override { return std::string("cuticle view ") + name_; }

 protected:
  ViewOf(const char* name, Shown shown) : view_(std::move(shown)), name_(name) {}
  Shown view_;

 private:
  const char* name_;
};

/// Draws the view into the target's files, or shows it in a window until that is closed. Errors: no_device without a
/// display, bad_input where a file cannot be written, the view's own.
Result<void> present(View& view, const ViewTarget& target);

}  // namespace cuticle::viz
