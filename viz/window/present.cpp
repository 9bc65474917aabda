#include <vtkAutoInit.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>

#include "viz/window/detail/interaction.h"
#include "viz/window/detail/open_window.h"
#include "viz/window/picture.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)
VTK_MODULE_INIT(vtkRenderingContextOpenGL2)
VTK_MODULE_INIT(vtkInteractionStyle)

namespace cuticle::viz {
namespace {

constexpr double k_panel_width = 290;  // pixels at a height of 900

vtkSmartPointer<vtkRenderWindow> make_window(const View& view, const ViewTarget& target) {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(!target.is_window());
  window->SetSize(target.size.x, target.size.y);
  window->SetMultiSamples(k_samples);
  window->SetWindowName(view.title().c_str());
  return window;
}

/// Beside the panel, where the window has one.
WindowArea area_of(vtkRenderWindow& window, const ViewTarget& target, bool has_panel) {
  const double scale = target.size.y / 900.0;
  return {&window, has_panel ? std::min(0.4, k_panel_width * scale / target.size.x) : 0, scale};
}

}  // namespace

vtkSmartPointer<vtkRenderer> WindowArea::add_renderer(double x0, double y0, double x1, double y1) const {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(left + x0 * (1 - left), y0, left + x1 * (1 - left), y1);
  renderer->SetBackground(1, 1, 1);
  window->AddRenderer(renderer);
  return renderer;
}

Result<OpenWindow> open_window(View& view, const ViewTarget& target, bool for_test) {
  OpenWindow opened;
  CUTICLE_ASSIGN(opened.display, open_display(target.is_window() && !for_test));
  opened.window = make_window(view, target);
  opened.area = area_of(*opened.window, target, target.is_window());
  CUTICLE_TRY(view.fill(opened.area));
  return opened;
}

Result<void> present(View& view, const ViewTarget& target) {
  CUTICLE_ASSIGN(const OpenWindow opened, open_window(view, target));
  if (target.is_window()) return interact(view, opened.area, target);
  opened.window->Render();
  if (!target.screenshot.empty()) CUTICLE_TRY(write_picture(*opened.window, target.screenshot));
  if (!target.movie.empty()) CUTICLE_TRY(write_movie(view, *opened.window, target));
  return {};
}

}  // namespace cuticle::viz
