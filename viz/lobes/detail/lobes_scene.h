#pragma once
// The surfaces of one model in a viewport, with the fibre, the light and the cones. Private to viz/lobes.
#include <vtkActor.h>
#include <vtkTextActor.h>

#include "viz/draw/detail/parts.h"
#include "viz/lobes/curves.h"
#include "viz/lobes/surface.h"

namespace cuticle::viz {

class LobesScene {
 public:
  LobesScene(vtkRenderer& renderer, double scale);
  /// Draws anew what the settings change.
  void set_surfaces(const std::vector<LobeSurface>& surfaces, const DirectionGrid& grid);
  void set_light(double theta_i, const std::vector<LobeCurve>& longitudinal);
  void set_rings(bool logarithmic, double peak);
  void set_words(const std::string& title, const std::string& below);
  void set_colors(const std::vector<std::pair<std::string, glm::dvec3>>& names);
  vtkRenderer& renderer() { return renderer_; }
  /// Positions of the surface drawn first, as VTK has them.
  vtkPolyData* surface_data() const { return first_; }

 private:
  void replace(std::vector<vtkSmartPointer<vtkProp>>& old, std::vector<vtkSmartPointer<vtkProp>> now);
  vtkSmartPointer<vtkProp> label(const std::string& text, const glm::dvec3& at, double size) const;

  vtkRenderer& renderer_;
  double scale_;
  vtkSmartPointer<vtkPolyData> first_;
  std::vector<vtkSmartPointer<vtkProp>> surfaces_, light_, rings_, names_;
  vtkSmartPointer<vtkTextActor> title_, below_;
};

}  // namespace cuticle::viz
