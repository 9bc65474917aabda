// Text, pens and colour bars of plots and panels.
#include <algorithm>

#include <vtkBrush.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include "viz/draw/detail/plot_item.h"
#include "viz/draw/ticks.h"

namespace cuticle::viz {
namespace {

unsigned char byte(double value) { return static_cast<unsigned char>(255 * std::clamp(value, 0.0, 1.0) + 0.5); }

std::vector<double> bar_ticks(const ColorScale& colors, int count) {
  return colors.logarithmic ? logarithmic_ticks(colors.lower, colors.upper, count)
                            : ticks(colors.lower, colors.upper, count);
}

}  // namespace

void draw_text(vtkContext2D& painter, const glm::dvec2& at, const std::string& text, const TextStyle& style) {
  if (text.empty()) return;
  vtkTextProperty& font = *painter.GetTextProp();
  font.SetFontSize(std::max(6, int(style.size + 0.5)));
  font.SetColor(style.color.x, style.color.y, style.color.z);
  font.SetBold(style.bold);
  font.SetOrientation(style.upright ? 90 : 0);
  font.SetJustification(style.horizontal + 1);
  font.SetVerticalJustification(style.vertical + 1);
  painter.DrawString(float(at.x), float(at.y), text.c_str());
  font.SetOrientation(0);
}

void set_pen(vtkContext2D& painter, const glm::dvec3& color, double width, bool dashed) {
  painter.GetPen()->SetColor(byte(color.x), byte(color.y), byte(color.z), 255);
  painter.GetPen()->SetWidth(float(width));
  painter.GetPen()->SetLineType(dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
}

void set_brush(vtkContext2D& painter, const glm::dvec3& color) {
  painter.GetBrush()->SetColor(byte(color.x), byte(color.y), byte(color.z), 255);
}

void draw_color_bar(vtkContext2D& painter, const ColorScale& colors, const Rectangle& place, double scale) {
  painter.GetPen()->SetLineType(vtkPen::NO_PEN);
  constexpr int steps = 128;
  for (int k = 0; k < steps; ++k) {
    set_brush(painter, ramp_color(colors.ramp, (k + 0.5) / steps));
    painter.DrawRect(float(place.left + k * place.width() / steps), float(place.bottom),
                     float(place.width() / steps + 0.6), float(place.height()));
  }
  for (const auto& [tick, text] : labelled(bar_ticks(colors, 6))) {
    const double x = place.left + colors.fraction(tick) * place.width();
    set_pen(painter, {.25, .25, .25}, scale);
    painter.DrawLine(float(x), float(place.bottom), float(x), float(place.bottom - 5 * scale));
    draw_text(painter, {x, place.bottom - 8 * scale}, text, {14 * scale, 0, 1});
  }
  draw_text(painter, {(place.left + place.right) / 2, place.top + 6 * scale}, colors.title, {15 * scale, 0, -1});
}

void draw_upright_bar(vtkContext2D& painter, const ColorScale& colors, const Rectangle& place, double scale) {
  painter.GetPen()->SetLineType(vtkPen::NO_PEN);
  constexpr int steps = 128;
  for (int k = 0; k < steps; ++k) {
    set_brush(painter, ramp_color(colors.ramp, (k + 0.5) / steps));
    painter.DrawRect(float(place.left), float(place.bottom + k * place.height() / steps), float(place.width()),
                     float(place.height() / steps + 0.6));
  }
  for (const auto& [tick, text] : labelled(bar_ticks(colors, 5))) {
    const double y = place.bottom + colors.fraction(tick) * place.height();
    set_pen(painter, {.25, .25, .25}, scale);
    painter.DrawLine(float(place.right), float(y), float(place.right + 5 * scale), float(y));
    draw_text(painter, {place.right + 8 * scale, y}, text, {13 * scale, -1, 0});
  }
  draw_text(painter, {place.right + 50 * scale, (place.bottom + place.top) / 2}, colors.title,
            {14 * scale, 0, 1, false, true});
}

}  // namespace cuticle::viz
