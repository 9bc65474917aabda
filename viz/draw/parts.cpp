#include "viz/draw/detail/parts.h"

#include <vtkBillboardTextActor3D.h>
#include <vtkCellArray.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

#include "viz/draw/detail/plot_item.h"

namespace cuticle::viz {

class BarItem : public vtkContextItem {
 public:
  static BarItem* New();
  vtkTypeMacro(BarItem, vtkContextItem);
  bool Paint(vtkContext2D* painter) override {
    const double width = GetScene()->GetSceneWidth(), bar = std::min(0.7 * width, 520 * scale);
    const Rectangle place{(width - bar) / 2, 34 * scale, (width + bar) / 2, 50 * scale};
    draw_color_bar(*painter, colors, place, scale);
    return true;
  }
  ColorScale colors;
  double scale = 1;
};
vtkStandardNewMacro(BarItem);

ColorBar::ColorBar(vtkRenderer& renderer, double scale) : item_(vtkSmartPointer<BarItem>::New()) {
  item_->scale = scale;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item_);
  renderer.AddActor(actor);
}

void ColorBar::set(const ColorScale& colors) {
  item_->colors = colors;
  item_->GetScene()->SetDirty(true);
}

vtkSmartPointer<vtkTextActor> add_text(vtkRenderer& renderer, const std::string& text, double x, double y, double size,
                                       bool bold) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  vtkTextProperty& font = *actor->GetTextProperty();
  font.SetFontSize(int(size + 0.5));
  font.SetBold(bold);
  font.SetColor(0.12, 0.12, 0.12);
  font.SetLineSpacing(1.2);
  font.SetVerticalJustificationToTop();
  renderer.AddActor2D(actor);
  return actor;
}

void add_label(vtkRenderer& renderer, const std::string& text, const glm::dvec3& at, double size) {
  vtkNew<vtkBillboardTextActor3D> actor;
  actor->SetInput(text.c_str());
  actor->SetPosition(at.x, at.y, at.z);
  actor->GetTextProperty()->SetFontSize(int(size + 0.5));
  actor->GetTextProperty()->SetColor(0.12, 0.12, 0.12);
  renderer.AddActor(actor);
}

vtkSmartPointer<vtkPolyData> polyline_data(const std::vector<std::vector<glm::dvec3>>& lines) {
  vtkNew<vtkPoints> positions;
  vtkNew<vtkCellArray> cells;
  for (const auto& line : lines) {
    cells->InsertNextCell(int(line.size()));
    for (const glm::dvec3& p : line) cells->InsertCellPoint(positions->InsertNextPoint(p.x, p.y, p.z));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(positions);
  data->SetLines(cells);
  return data;
}

vtkSmartPointer<vtkActor> flat_actor(vtkPolyData* data, double line_width) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetLineWidth(float(line_width));
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> make_polyline(const std::vector<glm::dvec3>& points, const glm::dvec3& color, double width) {
  const auto actor = flat_actor(polyline_data({points}), width);
  actor->GetProperty()->SetColor(color.x, color.y, color.z);
  return actor;
}

vtkSmartPointer<vtkPolyData> grid_data(const std::vector<glm::dvec3>& points, int columns,
                                       const std::vector<glm::dvec3>& colors) {
  vtkNew<vtkPoints> placed;
  for (const glm::dvec3& p : points) placed->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> quads;
  for (vtkIdType row = 0; row + 1 < vtkIdType(points.size()) / columns; ++row)
    for (vtkIdType column = 0; column + 1 < columns; ++column) {
      const vtkIdType first = row * columns + column;
      quads->InsertNextCell({first, first + 1, first + 1 + columns, first + columns});
    }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(placed);
  data->SetPolys(quads);
  data->GetPointData()->SetScalars(color_array(colors));
  return data;
}

vtkSmartPointer<vtkActor> smooth_actor(vtkPolyData* data, double ambient) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SplittingOff();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(ambient);
  return actor;
}

vtkSmartPointer<vtkUnsignedCharArray> color_array(const std::vector<glm::dvec3>& colors) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(vtkIdType(colors.size()));
  for (std::size_t i = 0; i < colors.size(); ++i)
    array->SetTuple3(vtkIdType(i), 255 * colors[i].x, 255 * colors[i].y, 255 * colors[i].z);
  return array;
}

void add_legend(vtkRenderer& renderer, const std::vector<std::pair<std::string, glm::dvec3>>& names, double x, double y,
                double scale) {
  const double line = 26 * scale / renderer.GetSize()[1];
  for (const auto& [name, color] : names) {
    const auto text = add_text(renderer, name, x, y, 18 * scale, true);
    text->GetTextProperty()->SetJustificationToRight();
    text->GetTextProperty()->SetColor(0.85 * color.x, 0.85 * color.y, 0.85 * color.z);
    y -= line;
  }
}

}  // namespace cuticle::viz
