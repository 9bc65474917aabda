#include "viz/window/detail/panel.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <vtkContextScene.h>
#include <vtkObjectFactory.h>

#include "viz/draw/detail/plot_item.h"

namespace cuticle::viz {
namespace {

constexpr double k_row = 40;
const glm::dvec3 k_quiet(.45, .45, .45), k_track(.78, .80, .83), k_set(.16, .42, .68);

/// Ranges over many decades are spread by their logarithm.
bool by_decades(const Control& control) {
  return control.minimum > 0 && control.maximum / control.minimum >= 1000 && !control.is_integer;
}
double fraction_of(const Control& control, double value) {
  if (by_decades(control)) return std::log(value / control.minimum) / std::log(control.maximum / control.minimum);
  return (value - control.minimum) / std::max(control.maximum - control.minimum, 1e-300);
}
double value_at(const Control& control, double fraction) {
  const double at = std::clamp(fraction, 0.0, 1.0);
  const double value = by_decades(control) ? control.minimum * std::pow(control.maximum / control.minimum, at)
                                           : control.minimum + at * (control.maximum - control.minimum);
  return control.is_integer ? std::round(value) : value;
}

}  // namespace

vtkStandardNewMacro(Panel);

std::string value_text(const Control& control) {
  if (!control.choices.empty()) return control.choices[std::size_t(control.value)];
  const std::string unit = control.unit == "1" || control.unit.empty() ? "" : " " + control.unit;
  return fmt::format("{:.4g}{}", control.value, unit);
}

void Panel::set(std::vector<Control> controls) {
  controls_ = std::move(controls);
  if (GetScene()) GetScene()->SetDirty(true);
}

void Panel::say(std::string words) {
  words_ = std::move(words);
  if (GetScene()) GetScene()->SetDirty(true);
}

double Panel::right() { return GetScene()->GetSceneWidth() - 16 * scale; }
double Panel::row_top(int row) { return GetScene()->GetSceneHeight() - (16 + k_row * (row - first_)) * scale; }

int Panel::row_at(const glm::dvec2& pixel) {
  for (int row = first_; row < int(controls_.size()); ++row)
    if (pixel.y <= row_top(row) && pixel.y > row_top(row) - k_row * scale) return row;
  return -1;
}

glm::dvec2 Panel::knob(int row, double value) {
  const Control& control = controls_[std::size_t(row)];
  return {left() + fraction_of(control, value) * (right() - left()), row_top(row) - 27 * scale};
}

Result<void> Panel::set_by_mouse(int row, const glm::dvec2& pixel, bool pressed, bool resting) {
  Control& control = controls_[std::size_t(row)];
  if (control.choices.empty()) {
    control.value = value_at(control, (pixel.x - left()) / (right() - left()));
  } else if (pressed) {
    control.value = double((std::size_t(control.value) + 1) % control.choices.size());
  }
  GetScene()->SetDirty(true);
  return control.set(control.value, resting);
}

void Panel::scroll(int rows) {
  first_ = std::clamp(first_ + rows, 0, std::max(0, int(controls_.size()) - 4));
  GetScene()->SetDirty(true);
}

void Panel::paint_slider(vtkContext2D& painter, const Control& control, double y) {
  const double knob = left() + std::clamp(fraction_of(control, control.value), 0.0, 1.0) * (right() - left());
  set_pen(painter, k_track, 4 * scale);
  painter.DrawLine(float(left()), float(y), float(right()), float(y));
  set_pen(painter, k_set, 4 * scale);
  painter.DrawLine(float(left()), float(y), float(knob), float(y));
  set_pen(painter, {1, 1, 1}, 1.5 * scale);
  set_brush(painter, k_set);
  painter.DrawEllipse(float(knob), float(y), float(7 * scale), float(7 * scale));
}

void Panel::paint_choices(vtkContext2D& painter, const Control& control, double y) {
  const double width = (right() - left()) / double(control.choices.size());
  for (std::size_t k = 0; k < control.choices.size(); ++k) {
    set_pen(painter, {1, 1, 1}, 0);
    set_brush(painter, k == std::size_t(control.value) ? k_set : k_track);
    painter.DrawRect(float(left() + double(k) * width), float(y - 3 * scale), float(width - 3 * scale),
                     float(6 * scale));
  }
}

void Panel::paint_row(vtkContext2D& painter, int row) {
  const Control& control = controls_[std::size_t(row)];
  const double top = row_top(row), y = top - 27 * scale;
  draw_text(painter, {left(), top}, control.name, {13 * scale, -1, 1});
  draw_text(painter, {right(), top}, value_text(control), {13 * scale, 1, 1, true});
  if (control.choices.empty())
    paint_slider(painter, control, y);
  else
    paint_choices(painter, control, y);
}

bool Panel::Paint(vtkContext2D* painter) {
  for (int row = first_; row < int(controls_.size()) && row_top(row) > 70 * scale; ++row) paint_row(*painter, row);
  draw_text(*painter, {left(), 10 * scale}, words_, {12 * scale, -1, -1, false, false, k_quiet});
  return true;
}

}  // namespace cuticle::viz
