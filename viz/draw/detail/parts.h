#pragma once
// Things that several views put into a scene. Private to viz, which shows VTK types.
#include <string>
#include <vector>

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkUnsignedCharArray.h>
#include <glm/vec3.hpp>

#include "viz/color/ramp.h"

namespace cuticle::viz {

/// Text at a place of the viewport (shares of it from the lower left corner), hanging down from there.
vtkSmartPointer<vtkTextActor> add_text(vtkRenderer& renderer, const std::string& text, double x, double y, double size,
                                       bool bold = false);
/// Text at a place of the scene, facing the camera.
void add_label(vtkRenderer& renderer, const std::string& text, const glm::dvec3& at, double size);
/// A polyline of one colour.
vtkSmartPointer<vtkActor> make_polyline(const std::vector<glm::dvec3>& points, const glm::dvec3& color, double width);
vtkSmartPointer<vtkPolyData> polyline_data(const std::vector<std::vector<glm::dvec3>>& lines);
/// Lines or surfaces of given colours, without light.
vtkSmartPointer<vtkActor> flat_actor(vtkPolyData* data, double line_width);
/// A sheet of quads over rows of points, with a colour per point.
vtkSmartPointer<vtkPolyData> grid_data(const std::vector<glm::dvec3>& points, int columns,
                                       const std::vector<glm::dvec3>& colors);
/// A lit surface with smooth normals; `ambient`: share of its colour without light.
vtkSmartPointer<vtkActor> smooth_actor(vtkPolyData* data, double ambient);
/// A colour per point, from the values.
vtkSmartPointer<vtkUnsignedCharArray> color_array(const std::vector<glm::dvec3>& colors);

/// A horizontal colour bar at the foot of a viewport, its title above and its ticks below.
class ColorBar {
 public:
  ColorBar(vtkRenderer& renderer, double scale);
  void set(const ColorScale& colors);

 private:
  vtkSmartPointer<class BarItem> item_;
};

/// Names in their colours, one below the other from a place of the viewport.
void add_legend(vtkRenderer& renderer, const std::vector<std::pair<std::string, glm::dvec3>>& names, double x, double y,
                double scale);

}  // namespace cuticle::viz
