#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkLegendBoxActor.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include "viz/detail/stage.h"
#include "viz/lobe_surface.h"

namespace cuticle::viz {
namespace {

const glm::dvec3 k_grey(0.55, 0.55, 0.55);

vtkSmartPointer<vtkUnsignedCharArray> color_array(const std::vector<glm::dvec3>& colors) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  for (const glm::dvec3& c : colors) array->InsertNextTuple3(255 * c.x, 255 * c.y, 255 * c.z);
  return array;
}

vtkSmartPointer<vtkPolyData> surface_data(const LobeSurface& surface, const DirectionGrid& grid) {
  vtkNew<vtkPoints> points;
  for (const glm::dvec3& p : surface.positions) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> quads;
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const vtkIdType first = vtkIdType(row) * grid.columns + column;
      quads->InsertNextCell({first, first + 1, first + 1 + grid.columns, first + grid.columns});
    }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(quads);
  data->GetPointData()->SetScalars(color_array(surface.colors));
  return data;
}

vtkSmartPointer<vtkActor> surface_actor(const LobeSurface& surface, const DirectionGrid& grid) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface_data(surface, grid));
  normals->SplittingOff();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetSpecular(0.15);
  return actor;
}

std::vector<glm::dvec3> circle(double radius) {
  std::vector<glm::dvec3> points;
  for (int k = 0; k <= 120; ++k) {
    const double angle = 2 * std::numbers::pi * k / 120;
    points.push_back(radius * glm::dvec3(std::cos(angle), std::sin(angle), 0));
  }
  return points;
}

/// Rings in the normal plane at whole decades (or quarters of the peak) with their values.
void add_rings(vtkRenderer& renderer, const LobesView& view, double peak) {
  const int rings = view.logarithmic ? int(k_decades) : 4;
  for (int k = 1; k <= rings; ++k) {
    const double radius = double(k) / rings;
    renderer.AddActor(make_polyline(circle(radius), {0.75, 0.75, 0.75}, 1));
    const double value = view.logarithmic ? peak * std::pow(10.0, k - rings) : peak * radius;
    add_label(renderer, fmt::format("{:.2g}", value), radius * glm::dvec3(std::cos(-2.2), std::sin(-2.2), 0), 13);
  }
}

void add_axes(vtkRenderer& renderer, double theta_i) {
  renderer.AddActor(make_polyline({{0, 0, -1.25}, {0, 0, 1.25}}, k_grey, 6));
  add_label(renderer, "fibre axis u (to the tip)", {0.04, 0, 1.2}, 16);
  const glm::dvec3 light(std::cos(theta_i), 0, std::sin(theta_i));
  renderer.AddActor(make_polyline({1.3 * light, {0, 0, 0}}, {0.9, 0.75, 0.1}, 4));
  add_label(renderer, "light", 1.32 * light, 16);
  renderer.AddActor(make_polyline({{0, 0, 0}, {1.15, 0, 0}}, k_grey, 1.5));
  add_label(renderer, "phi = 0", {1.17, 0, 0}, 14);
  renderer.AddActor(make_polyline({{0, 0, 0}, {0, 1.15, 0}}, k_grey, 1.5));
  add_label(renderer, "phi = 90 deg", {0, 1.17, 0}, 14);
}

std::vector<int> lobes_shown(const LobesView& view) {
  std::vector<int> lobes;
  for (int lobe = 0; lobe < int(view.model->lobes.size()); ++lobe)
    if (view.lobe < 0 || view.lobe == lobe) lobes.push_back(lobe);
  return lobes;
}

void add_legend(vtkRenderer& renderer, const LobesView& view) {
  const std::vector<int> lobes = lobes_shown(view);
  vtkNew<vtkLegendBoxActor> legend;
  vtkNew<vtkPlaneSource> square;
  square->Update();
  legend->SetNumberOfEntries(int(lobes.size()));
  for (int k = 0; k < int(lobes.size()); ++k) {
    const std::string name(view.model->lobes[std::size_t(lobes[std::size_t(k)])]);
    glm::dvec3 color = lobe_color(name);
    legend->SetEntry(k, square->GetOutput(), name.c_str(), &color.x);
  }
  legend->BoxOff();
  legend->BorderOff();
  legend->GetEntryTextProperty()->SetBold(true);
  legend->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  legend->SetPosition(0.87, 0.78);
  legend->GetPosition2Coordinate()->SetCoordinateSystemToNormalizedViewport();
  legend->SetPosition2(0.11, 0.045 * double(lobes.size()));
  renderer.AddActor2D(legend);
}

std::string legend_words(const LobesView& view, double peak) {
  const std::string radius = view.logarithmic
                                 ? fmt::format("radius: log10 S, {:g} decades up to {:.3g} 1/sr", k_decades, peak)
                                 : fmt::format("radius: S, linear up to {:.3g} 1/sr", peak);
  return fmt::format(
      "{}; above it (caustics) cut\nmean of r, g, b, and over 3 deg of phi; no cosine; rings in the normal plane: S "
      "there",
      radius);
}

std::string title_of(const LobesView& view) {
  const std::string what = view.lobe >= 0    ? fmt::format("lobe {}", view.model->lobes[std::size_t(view.lobe)])
                           : view.lobe == -1 ? "sum of the lobes, coloured by share"
                                             : "each lobe";
  return fmt::format("{}: S over outgoing directions, {}, theta_i = {:.4g} deg", view.model->entry.name, what,
                     view.theta_i * 180 / std::numbers::pi);
}

void look_at_lobes(vtkRenderer& renderer) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.SetViewUp(0, 0, 1);
  camera.SetFocalPoint(0, 0, 0);
  camera.SetPosition(2.4, -4.6, 2.0);
  camera.SetViewAngle(29);
  renderer.ResetCameraClippingRange();
}

}  // namespace

Result<void> show(const LobesView& view, const ViewTarget& target) {
  CUTICLE_ASSIGN(const OpenDisplay display, open_display());
  CUTICLE_ASSIGN(const LobeSurfaces set, make_surfaces(view));
  vtkNew<vtkRenderer> renderer;
  for (const LobeSurface& surface : set.surfaces) renderer->AddActor(surface_actor(surface, set.grid));
  add_rings(*renderer, view, set.peak);
  add_axes(*renderer, view.theta_i);
  add_legend(*renderer, view);
  add_text(*renderer, title_of(view), 0.02, 0.98, 20, true);
  add_text(*renderer, legend_words(view, set.peak), 0.02, 0.075, 16);
  look_at_lobes(*renderer);
  return present(*renderer, target, "cuticle view lobes");
}

}  // namespace cuticle::viz
