#include "viz/detail/stage.h"

#include <cstdlib>

#include <X11/Xlib.h>
#include <fmt/format.h>
#include <vtkAutoInit.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCellArray.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include "core/file.h"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)
VTK_MODULE_INIT(vtkInteractionStyle)

namespace cuticle::viz {
namespace {

Result<void> write_picture(vtkRenderWindow& window, const std::string& path) {
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(&window);
  grab->ReadFrontBufferOff();
  return write_through_temporary(path, [&grab](const std::string& temporary) -> Result<void> {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(grab->GetOutputPort());
    writer->SetFileName(temporary.c_str());
    writer->Write();
    if (writer->GetErrorCode() != 0) return bad_input(fmt::format("{}: cannot be written", temporary));
    return {};
  });
}

void interact(vtkRenderWindow& window) {
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor->SetInteractorStyle(style);
  interactor->SetRenderWindow(&window);
  interactor->Start();
}

}  // namespace

Result<OpenDisplay> open_display() {
  constexpr const char* hint = "xvfb-run -a cuticle view ... --screenshot FILE.png, or set DISPLAY";
  const char* name = std::getenv("DISPLAY");
  if (!name || !*name) return Error{ErrorKind::no_device, "views need an X display, and DISPLAY is not set", hint};
  Display* display = XOpenDisplay(name);
  if (!display)
    return Error{ErrorKind::no_device, fmt::format("views need an X display, and DISPLAY={} does not answer", name),
                 hint};
  return OpenDisplay(display, [](void* open) { XCloseDisplay(static_cast<Display*>(open)); });
}

void add_text(vtkRenderer& renderer, const std::string& text, double x, double y, int size, bool bold) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  actor->GetTextProperty()->SetFontSize(size);
  actor->GetTextProperty()->SetBold(bold);
  actor->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
  actor->GetTextProperty()->SetLineSpacing(1.2);
  actor->GetTextProperty()->SetVerticalJustificationToTop();
  renderer.AddActor2D(actor);
}

void add_label(vtkRenderer& renderer, const std::string& text, const glm::dvec3& at, int size) {
  vtkNew<vtkBillboardTextActor3D> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(at.x, at.y, at.z);
  actor->GetTextProperty()->SetFontSize(size);
  actor->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
  renderer.AddActor(actor);
}

vtkSmartPointer<vtkActor> make_polyline(const std::vector<glm::dvec3>& points, const glm::dvec3& color, double width) {
  vtkNew<vtkPoints> positions;
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(int(points.size()));
  for (const glm::dvec3& p : points) lines->InsertCellPoint(positions->InsertNextPoint(p.x, p.y, p.z));
  vtkNew<vtkPolyData> data;
  data->SetPoints(positions);
  data->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.x, color.y, color.z);
  actor->GetProperty()->SetLineWidth(float(width));
  actor->GetProperty()->LightingOff();
  return actor;
}

Result<void> present(vtkRenderer& renderer, const ViewTarget& target, const std::string& window_title) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(!target.screenshot.empty());
  window->SetSize(target.size.x, target.size.y);
  window->SetMultiSamples(4);
  window->SetWindowName(window_title.c_str());
  renderer.SetBackground(1, 1, 1);
  window->AddRenderer(&renderer);
  window->Render();
  if (!target.screenshot.empty()) return write_picture(*window, target.screenshot);
  interact(*window);
  return {};
}

}  // namespace cuticle::viz
