#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkColorTransferFunction.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>

#include "viz/detail/stage.h"

namespace cuticle::viz {
namespace {

struct Range {
  double lower = 0, upper = 1;
};

/// The scalar's range; about the neutral value when diverging, and never empty.
Range range_of(const StrandsView& view) {
  const auto [low, high] = std::minmax_element(view.scalar.begin(), view.scalar.end());
  const double lower = double(*low), upper = double(*high);
  if (!view.diverging) return {lower, upper > lower ? upper : lower + 1e-6};
  const double reach = std::max({std::abs(lower - view.neutral), std::abs(upper - view.neutral), 1e-6});
  return {view.neutral - reach, view.neutral + reach};
}

vtkSmartPointer<vtkColorTransferFunction> colors_for(const StrandsView& view, const Range& range) {
  auto colors = vtkSmartPointer<vtkColorTransferFunction>::New();
  const auto at = [&](double fraction, double r, double g, double b) {
    colors->AddRGBPoint(range.lower + fraction * (range.upper - range.lower), r, g, b);
  };
  if (view.diverging) {
    colors->SetColorSpaceToDiverging();
    at(0, 0.13, 0.30, 0.75), at(0.5, 0.80, 0.80, 0.80), at(1, 0.75, 0.10, 0.12);
  } else {
    at(0, 0.27, 0.00, 0.33), at(0.25, 0.23, 0.32, 0.55), at(0.5, 0.13, 0.57, 0.55), at(0.75, 0.37, 0.79, 0.38),
        at(1, 0.95, 0.85, 0.15);
  }
  return colors;
}

vtkSmartPointer<vtkPolyData> polylines(const StrandsView& view) {
  vtkNew<vtkPoints> points;
  for (const glm::vec3& p : view.groom.positions) points->InsertNextPoint(double(p.x), double(p.y), double(p.z));
  vtkNew<vtkCellArray> lines;
  for (std::size_t s = 0; s < view.groom.strand_count(); ++s) {
    lines->InsertNextCell(int(view.groom.strand_size(s)));
    for (std::size_t v = view.groom.offsets[s]; v < view.groom.offsets[s + 1]; ++v)
      lines->InsertCellPoint(vtkIdType(v));
  }
  vtkNew<vtkFloatArray> scalars;
  for (float value : view.scalar) scalars->InsertNextValue(value);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetPointData()->SetScalars(scalars);
  return data;
}

/// Few strands are drawn wider, so that their colour can be read.
double line_width(std::size_t strands) { return strands < 1000 ? 3 : strands < 8000 ? 1.5 : 1; }

vtkSmartPointer<vtkActor> lines_actor(const StrandsView& view, vtkColorTransferFunction* colors) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(polylines(view));
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLineWidth(float(line_width(view.groom.strand_count())));
  actor->GetProperty()->LightingOff();
  return actor;
}

void add_color_bar(vtkRenderer& renderer, vtkColorTransferFunction* colors) {
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetOrientationToHorizontal();
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%-#.4g");
  bar->SetUnconstrainedFontSize(true);
  vtkTextProperty& text = *bar->GetLabelTextProperty();
  text.SetColor(0.1, 0.1, 0.1);
  text.SetFontSize(16);
  text.ShadowOff();
  text.ItalicOff();
  text.BoldOff();
  bar->SetPosition(0.2, 0.02);
  bar->SetWidth(0.6);
  bar->SetHeight(0.075);
  renderer.AddActor2D(bar);
}

std::string words_of(const StrandsView& view) {
  const auto [low, high] = std::minmax_element(view.scalar.begin(), view.scalar.end());
  return fmt::format("{} strands, {} vertices; {} from {:.4g} to {:.4g}", view.groom.strand_count(),
                     view.groom.vertex_count(), view.scalar_title, *low, *high);
}

/// From the front and slightly above, y up, with room for title and colour bar.
void look_at_strands(vtkRenderer& renderer) {
  renderer.GetActiveCamera()->SetViewUp(0, 1, 0);
  renderer.GetActiveCamera()->SetFocalPoint(0, 0, 0);
  renderer.GetActiveCamera()->SetPosition(0.45, 0.25, 1);
  renderer.ResetCamera();
  renderer.GetActiveCamera()->SetWindowCenter(0, -0.07);
  renderer.GetActiveCamera()->Zoom(0.9);
}

}  // namespace

Result<void> show(const StrandsView& view, const ViewTarget& target) {
  CUTICLE_ASSIGN(const OpenDisplay display, open_display());
  if (view.scalar.empty()) return bad_input(fmt::format("{}: no vertices to show", view.title));
  vtkNew<vtkRenderer> renderer;
  const auto colors = colors_for(view, range_of(view));
  renderer->AddActor(lines_actor(view, colors));
  add_color_bar(*renderer, colors);
  add_text(*renderer, view.scalar_title, 0.2, 0.135, 16);
  add_text(*renderer, view.title, 0.02, 0.98, 20, true);
  add_text(*renderer, words_of(view), 0.02, 0.94, 16);
  look_at_strands(*renderer);
  return present(*renderer, target, "cuticle view strands");
}

}  // namespace cuticle::viz
