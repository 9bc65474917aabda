#include "viz/draw/detail/plot_item.h"

#include <algorithm>
#include <cmath>

#include <vtkBrush.h>
#include <vtkContextDevice2D.h>
#include <vtkContextScene.h>
#include <vtkObjectFactory.h>

#include "viz/draw/ticks.h"

namespace cuticle::viz {
namespace {

vtkSmartPointer<vtkImageData> colored(const PlotImage& image, const ColorScale& colors) {
  auto pixels = vtkSmartPointer<vtkImageData>::New();
  pixels->SetDimensions(image.width, image.height, 1);
  pixels->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* at = static_cast<unsigned char*>(pixels->GetScalarPointer());
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const float value = image.values[i];
    const bool is_beneath = value == 0 && !image.beneath.empty();
    const glm::dvec3 color = is_beneath ? image.beneath[i] : colors.color(double(value));
    for (int c = 0; c < 3; ++c) *at++ = static_cast<unsigned char>(255 * color[c] + 0.5);
    *at++ = 255;
  }
  return pixels;
}

double fraction_along(const PlotAxis& axis, double value) {
  if (axis.kind != PlotAxis::Kind::logarithmic) return (value - axis.lower) / (axis.upper - axis.lower);
  return std::log(std::max(value, 1e-300) / axis.lower) / std::log(axis.upper / axis.lower);
}
double value_along(const PlotAxis& axis, double fraction) {
  if (axis.kind != PlotAxis::Kind::logarithmic) return axis.lower + fraction * (axis.upper - axis.lower);
  return axis.lower * std::pow(axis.upper / axis.lower, fraction);
}

/// Where a curve's name stands: at its highest point within the axes.
const glm::dvec2* highest(const Curve& curve, const PlotContent& content) {
  const glm::dvec2* best = nullptr;
  for (const glm::dvec2& point : curve.points)
    if (std::isfinite(point.y) && point.x >= content.x.lower && point.x <= content.x.upper &&
        (!best || point.y > best->y))
      best = &point;
  return best;
}

}  // namespace

vtkStandardNewMacro(PlotItem);

std::vector<double> ticks_of(const PlotAxis& axis, int count) {
  if (axis.kind == PlotAxis::Kind::degrees) return degree_ticks(axis.lower, axis.upper, count);
  if (axis.kind == PlotAxis::Kind::logarithmic) return logarithmic_ticks(axis.lower, axis.upper, count);
  return ticks(axis.lower, axis.upper, count);
}

void PlotItem::set(PlotContent content) {
  content_ = std::move(content);
  pixels_ = content_.image ? colored(*content_.image, content_.colors) : nullptr;
  Modified();
  if (GetScene()) GetScene()->SetDirty(true);
}

double PlotItem::x_fraction(double x) const { return fraction_along(content_.x, x); }
double PlotItem::y_fraction(double y) const { return fraction_along(content_.y, y); }

glm::dvec2 PlotItem::pixel_of(const glm::dvec2& place) const {
  return {area_.left + x_fraction(place.x) * area_.width(), area_.bottom + y_fraction(place.y) * area_.height()};
}

std::optional<glm::dvec2> PlotItem::place_of(const glm::dvec2& pixel) const {
  const glm::dvec2 fraction((pixel.x - area_.left) / area_.width(), (pixel.y - area_.bottom) / area_.height());
  if (fraction.x < 0 || fraction.x > 1 || fraction.y < 0 || fraction.y > 1) return std::nullopt;
  return glm::dvec2(value_along(content_.x, fraction.x), value_along(content_.y, fraction.y));
}

void PlotItem::lay_out() {
  const double bar = content_.colors.title.empty() ? 0 : 88 * scale;
  area_ = {78 * scale, 56 * scale, GetScene()->GetSceneWidth() - 26 * scale - bar,
           GetScene()->GetSceneHeight() - (content_.title.empty() ? 18 : 44) * scale};
  if (!content_.equal_scales) return;
  const double data = (content_.x.upper - content_.x.lower) / (content_.y.upper - content_.y.lower);
  const glm::dvec2 middle((area_.left + area_.right) / 2, (area_.bottom + area_.top) / 2);
  const double width = std::min(area_.width(), area_.height() * data), height = width / data;
  area_ = {middle.x - width / 2, middle.y - height / 2, middle.x + width / 2, middle.y + height / 2};
}

void PlotItem::paint_image(vtkContext2D& painter) {
  painter.DrawImage(vtkRectf(float(area_.left), float(area_.bottom), float(area_.width()), float(area_.height())),
                    pixels_);
}

void PlotItem::paint_frame(vtkContext2D& painter) {
  set_pen(painter, {.25, .25, .25}, 1 * scale);
  painter.GetBrush()->SetOpacityF(0);
  painter.DrawRect(float(area_.left), float(area_.bottom), float(area_.width()), float(area_.height()));
  draw_text(painter, {area_.left, area_.top + 12 * scale}, content_.title, {16 * scale, -1, -1, true});
}

void PlotItem::paint_x_axis(vtkContext2D& painter) {
  const int count = std::clamp(int(area_.width() / (75 * scale)), 2, 10);
  for (const auto& [tick, text] : labelled(ticks_of(content_.x, count))) {
    const double x = area_.left + x_fraction(tick) * area_.width();
    set_pen(painter, {.25, .25, .25}, 1 * scale);
    painter.DrawLine(float(x), float(area_.bottom), float(x), float(area_.bottom - 5 * scale));
    draw_text(painter, {x, area_.bottom - 8 * scale}, text, {14 * scale, 0, 1});
  }
  draw_text(painter, {(area_.left + area_.right) / 2, area_.bottom - 29 * scale}, content_.x.title, {15 * scale, 0, 1});
}

void PlotItem::paint_y_axis(vtkContext2D& painter) {
  const int count = std::clamp(int(area_.height() / (42 * scale)), 2, 8);
  double widest = 0;
  for (const auto& [tick, text] : labelled(ticks_of(content_.y, count))) {
    const double y = area_.bottom + y_fraction(tick) * area_.height();
    if (!content_.image) {
      set_pen(painter, {.9, .9, .9}, 1 * scale);
      painter.DrawLine(float(area_.left), float(y), float(area_.right), float(y));
    }
    set_pen(painter, {.25, .25, .25}, 1 * scale);
    painter.DrawLine(float(area_.left - 5 * scale), float(y), float(area_.left), float(y));
    draw_text(painter, {area_.left - 8 * scale, y}, text, {14 * scale, 1, 0});
    widest = std::max(widest, 7.6 * scale * double(text.size()));
  }
  draw_text(painter, {area_.left - 16 * scale - widest, (area_.bottom + area_.top) / 2}, content_.y.title,
            {15 * scale, 0, -1, false, true});
}

void PlotItem::paint_piece(vtkContext2D& painter, const Curve& curve, std::vector<float>& points) {
  set_pen(painter, curve.color, curve.width * scale, curve.dashed);
  if (points.size() >= 4) painter.DrawPoly(points.data(), int(points.size() / 2));
  points.clear();
}

void PlotItem::paint_curve(vtkContext2D& painter, const Curve& curve) {
  std::vector<float> piece;
  for (const glm::dvec2& point : curve.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      paint_piece(painter, curve, piece);
      continue;
    }
    const glm::dvec2 pixel = pixel_of(point);
    piece.push_back(float(pixel.x));
    piece.push_back(float(pixel.y));
  }
  paint_piece(painter, curve, piece);
}

void PlotItem::list_names(vtkContext2D& painter) {
  double y = area_.top - 8 * scale;
  for (const Curve& curve : content_.curves) {
    set_pen(painter, curve.color, curve.width * scale);
    painter.DrawLine(float(area_.left + 12 * scale), float(y - 8 * scale), float(area_.left + 40 * scale),
                     float(y - 8 * scale));
    draw_text(painter, {area_.left + 48 * scale, y}, curve.name, {15 * scale, -1, 1, true, false, 0.85 * curve.color});
    y -= 21 * scale;
  }
}

/// Names stand at the curves' highest points, lower where another is in the way.
void PlotItem::paint_names(vtkContext2D& painter) {
  if (content_.lists_names) return list_names(painter);
  std::vector<Rectangle> taken;
  for (const Curve& curve : content_.curves) {
    const glm::dvec2* top = curve.name.empty() ? nullptr : highest(curve, content_);
    if (!top) continue;
    const double width = 8.2 * scale * double(curve.name.size()), height = 18 * scale;
    glm::dvec2 at = pixel_of(*top) + glm::dvec2(9, 12) * scale;
    at.x = std::min(at.x, area_.right - width - 4 * scale);
    at.y = std::clamp(at.y, area_.bottom + height, area_.top - 3 * scale);
    const auto overlaps = [&](const Rectangle& other) {
      return at.x < other.right && at.x + width > other.left && at.y - height < other.top && at.y > other.bottom;
    };
    for (int turn = 0; turn < 12 && std::any_of(taken.begin(), taken.end(), overlaps); ++turn) at.y -= height;
    taken.push_back({at.x, at.y - height, at.x + width, at.y});
    draw_text(painter, at, curve.name, {15 * scale, -1, 1, true, false, 0.85 * curve.color});
  }
}

void PlotItem::paint_marks(vtkContext2D& painter) {
  for (const Mark& mark : content_.marks) {
    const glm::dvec2 pixel = pixel_of(mark.at);
    set_pen(painter, mark.color, 1 * scale);
    set_brush(painter, mark.color);
    if (mark.dot) painter.DrawEllipse(float(pixel.x), float(pixel.y), float(4 * scale), float(4 * scale));
    draw_text(painter, pixel + glm::dvec2(mark.dot ? 8 * scale : 0, mark.dot ? 8 * scale : 0), mark.text,
              {14 * scale, mark.dot ? -1 : 0, mark.dot ? -1 : 0, false, false, mark.color});
  }
}

void PlotItem::paint_bar(vtkContext2D& painter) {
  draw_upright_bar(painter, content_.colors,
                   {area_.right + 14 * scale, area_.bottom, area_.right + 30 * scale, area_.top}, scale);
}

bool PlotItem::Paint(vtkContext2D* painter) {
  lay_out();
  if (area_.width() < 20 || area_.height() < 20) return true;
  if (pixels_) paint_image(*painter);
  paint_x_axis(*painter);
  paint_y_axis(*painter);
  int inside[4] = {int(area_.left), int(area_.bottom), int(area_.width()) + 1, int(area_.height()) + 1};
  painter->GetDevice()->EnableClipping(true);
  painter->GetDevice()->SetClipping(inside);
  for (const Curve& curve : content_.curves) paint_curve(*painter, curve);
  painter->GetDevice()->EnableClipping(false);
  paint_frame(*painter);
  paint_names(*painter);
  paint_marks(*painter);
  if (!content_.colors.title.empty()) paint_bar(*painter);
  return true;
}

}  // namespace cuticle::viz
