#pragma once
// A VTK scene and its window. The only headers of viz that show VTK types are private to it.
#include <memory>

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "viz/viz.h"

namespace cuticle::viz {

/// A connection to the X display, to be held while a view is drawn: a virtual display starts anew, and refuses for a
/// moment, when its only client leaves. Error: no_device where none answers, its hint names xvfb-run.
using OpenDisplay = std::shared_ptr<void>;
Result<OpenDisplay> open_display();

/// Text at a place of the window (fractions of its size from the lower left corner).
void add_text(vtkRenderer& renderer, const std::string& text, double x, double y, int size, bool bold = false);
/// Text at a place of the scene, facing the camera.
void add_label(vtkRenderer& renderer, const std::string& text, const glm::dvec3& at, int size = 16);
/// A polyline of one colour.
vtkSmartPointer<vtkActor> make_polyline(const std::vector<glm::dvec3>& points, const glm::dvec3& color, double width);

/// Draws the scene into the target's picture, or shows it until the window is closed.
Result<void> present(vtkRenderer& renderer, const ViewTarget& target, const std::string& window_title);

}  // namespace cuticle::viz
