#pragma once
// How a plot is painted. Private to viz/draw.
#include <vtkContext2D.h>
#include <vtkContextItem.h>
#include <vtkImageData.h>

#include "viz/draw/detail/plot.h"

namespace cuticle::viz {

/// A rectangle of the viewport, pixels from its lower left corner.
struct Rectangle {
  double left = 0, bottom = 0, right = 1, top = 1;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

class PlotItem : public vtkContextItem {
 public:
  static PlotItem* New();
  vtkTypeMacro(PlotItem, vtkContextItem);

  bool Paint(vtkContext2D* painter) override;
  void set(PlotContent content);
  const PlotContent& content() const { return content_; }
  /// A pixel of the viewport as a place of the data.
  std::optional<glm::dvec2> place_of(const glm::dvec2& pixel) const;
  double scale = 1;

 private:
  glm::dvec2 pixel_of(const glm::dvec2& place) const;
  void lay_out();
  void paint_image(vtkContext2D& painter);
  void paint_frame(vtkContext2D& painter);
  void paint_x_axis(vtkContext2D& painter);
  void paint_y_axis(vtkContext2D& painter);
  void paint_curve(vtkContext2D& painter, const Curve& curve);
  void paint_piece(vtkContext2D& painter, const Curve& curve, std::vector<float>& points);
  void paint_names(vtkContext2D& painter);
  void list_names(vtkContext2D& painter);
  void paint_marks(vtkContext2D& painter);
  void paint_bar(vtkContext2D& painter);
  double x_fraction(double x) const;
  double y_fraction(double y) const;

  PlotContent content_;
  Rectangle area_;
  vtkSmartPointer<vtkImageData> pixels_;
};

/// Text with its anchor at a place: justification -1 left (bottom), 0 middle, 1 right (top).
struct TextStyle {
  double size = 14;
  int horizontal = 0, vertical = 0;
  bool bold = false, upright = false;
  glm::dvec3 color{.12, .12, .12};
};
void draw_text(vtkContext2D& painter, const glm::dvec2& at, const std::string& text, const TextStyle& style);
void set_pen(vtkContext2D& painter, const glm::dvec3& color, double width, bool dashed = false);
void set_brush(vtkContext2D& painter, const glm::dvec3& color);
/// Horizontal bar, its ticks below and its title above.
void draw_color_bar(vtkContext2D& painter, const ColorScale& colors, const Rectangle& place, double scale);
/// Upright, its ticks to the right, and its title beside them.
void draw_upright_bar(vtkContext2D& painter, const ColorScale& colors, const Rectangle& place, double scale);
/// Ticks of an axis of this kind.
std::vector<double> ticks_of(const PlotAxis& axis, int count);

}  // namespace cuticle::viz
