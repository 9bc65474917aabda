#pragma once
// The panel at the left of a window: a row with a slider for every number, buttons for choices. Private to viz/window.
#include <vtkContextItem.h>

#include "viz/window/detail/view.h"

namespace cuticle::viz {

class Panel : public vtkContextItem {
 public:
  static Panel* New();
  vtkTypeMacro(Panel, vtkContextItem);

  bool Paint(vtkContext2D* painter) override;
  void set(std::vector<Control> controls);
  /// The words below the rows.
  void say(std::string words);
  /// The mouse at a pixel of the panel, from its lower left corner. Gives the row that it sets, or -1.
  int row_at(const glm::dvec2& pixel);
  /// Sets the row's value by the mouse's place; `pressed`: the mouse went down just now.
  Result<void> set_by_mouse(int row, const glm::dvec2& pixel, bool pressed, bool resting);
  void scroll(int rows);
  const std::vector<Control>& controls() const { return controls_; }
  /// Where the row's slider stands for a value, for tests: pixels from the lower left corner.
  glm::dvec2 knob(int row, double value);
  double scale = 1;

 private:
  double row_top(int row);
  double left() const { return 16 * scale; }
  double right();
  void paint_row(vtkContext2D& painter, int row);
  void paint_slider(vtkContext2D& painter, const Control& control, double y);
  void paint_choices(vtkContext2D& painter, const Control& control, double y);

  std::vector<Control> controls_;
  std::string words_;
  int first_ = 0;
};

/// A number with its unit as the panel shows it.
std::string value_text(const Control& control);

}  // namespace cuticle::viz
