#pragma once
// A plot in a viewport: axes with units, curves with their names beside them, or an image with its colour bar. Private
// to viz, which shows VTK types.
#include <optional>
#include <string>
#include <vector>

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <glm/vec2.hpp>

#include "viz/color/ramp.h"

namespace cuticle::viz {

struct PlotAxis {
  std::string title;  ///< with its unit, "theta_o [deg]"
  double lower = 0, upper = 1;
  enum class Kind { number, logarithmic, degrees } kind = Kind::number;
};
struct Curve {
  std::string name;                ///< written beside its end; empty: not at all
  std::vector<glm::dvec2> points;  ///< a point that is not finite parts the curve
  glm::dvec3 color{0};
  double width = 2;
  bool dashed = false;
};
/// A small filled circle or a word at a place of the data.
struct Mark {
  glm::dvec2 at{0};
  std::string text;
  glm::dvec3 color{0};
  bool dot = true;
};
/// Cells of colours, row 0 at the lower end of y, drawn over the whole of both axes.
struct PlotImage {
  int width = 0, height = 0;
  std::vector<float> values;
  std::vector<glm::dvec3> beneath = {};  ///< colours of cells whose value is 0, or empty
};
struct PlotContent {
  std::string title;
  PlotAxis x, y;
  std::vector<Curve> curves = {};
  std::vector<Mark> marks = {};
  std::optional<PlotImage> image = {};
  ColorScale colors = {};     ///< of the image; its bar is drawn where its title is not empty
  bool equal_scales = false;  ///< one unit is as long along x as along y
  bool lists_names = false;   ///< curves' names one below the other at the upper left, not beside the curves
};

/// Something drawn flat in a renderer's viewport.
class Plot {
 public:
  /// `scale`: of fonts and lines, 1 for a window 900 pixels high.
  Plot(vtkRenderer& renderer, double scale);
  void set(PlotContent content);
  const PlotContent& content() const;
  /// Place in the data of a pixel of the window, where it lies between the axes.
  std::optional<glm::dvec2> place_of(const glm::dvec2& pixel) const;

 private:
  vtkSmartPointer<class PlotItem> item_;
  vtkRenderer* renderer_;
};

/// The least and greatest y of the curves, made rounder; from 0 where all are positive.
void fit_y(PlotContent& content);

}  // namespace cuticle::viz
