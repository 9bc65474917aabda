#include "viz/strand_lines.h"

#include <filesystem>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#include <glm/geometric.hpp>

#include "strands/formats/formats.h"

namespace cuticle::viz {
namespace {

/// Takes VTK's error messages in place of its printing them.
class ErrorCatcher : public vtkCommand {
 public:
  static ErrorCatcher* New() { return new ErrorCatcher; }
  void Execute(vtkObject*, unsigned long, void*) override { caught = true; }
  bool caught = false;
};

void append_line(vtkPolyData& data, vtkIdType count, const vtkIdType* ids, vtkDataArray* stretch, StrandsView& view) {
  for (vtkIdType k = 0; k < count; ++k) {
    double p[3];
    data.GetPoint(ids[k], p);
    view.groom.positions.emplace_back(float(p[0]), float(p[1]), float(p[2]));
    if (stretch) view.scalar.push_back(float(stretch->GetComponent(ids[k], 0)));
  }
  view.groom.offsets.push_back(std::uint32_t(view.groom.positions.size()));
}

StrandsView view_of(vtkPolyData& data) {
  StrandsView view;
  vtkDataArray* stretch = data.GetPointData()->GetArray("stretch");
  vtkCellArray* lines = data.GetLines();
  lines->InitTraversal();
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  while (lines->GetNextCell(count, ids)) append_line(data, count, ids, stretch, view);
  view.groom.radii.assign(view.groom.positions.size(), strands::k_default_radius);
  return view;
}

void color_by_stretch(StrandsView& view) {
  view.scalar_title = "stretch (length / rest length)";
  view.diverging = true;
  view.neutral = 1;
}

}  // namespace

std::vector<float> arc_lengths(const strands::Groom& groom) {
  std::vector<float> lengths(groom.vertex_count(), 0.0F);
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t v = groom.offsets[s] + 1; v < groom.offsets[s + 1]; ++v)
      lengths[v] = lengths[v - 1] + glm::distance(groom.positions[v], groom.positions[v - 1]);
  return lengths;
}

Result<StrandsView> read_state(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return bad_input(fmt::format("{}: no such file", path));
  vtkNew<vtkXMLPolyDataReader> reader;
  vtkNew<ErrorCatcher> catcher;
  reader->AddObserver(vtkCommand::ErrorEvent, catcher);
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  if (catcher->caught || !data || data->GetNumberOfLines() == 0)
    return bad_input(fmt::format("{}: not a state of strands (VTK XML poly data with lines)", path),
                     "a .vtp written by cuticle simulate");
  StrandsView view = view_of(*data);
  if (!view.scalar.empty()) color_by_stretch(view);
  return view;
}

Result<StrandsView> load_strands(const std::string& path, double metres_per_unit) {
  StrandsView view;
  if (path.ends_with(".vtp")) {
    CUTICLE_ASSIGN(view, read_state(path));
  } else {
    CUTICLE_ASSIGN(strands::GroomFile file, strands::read_groom(path, {.metres_per_unit = metres_per_unit}));
    view.groom = std::move(file.groom);
  }
  if (view.scalar.empty()) {
    view.scalar = arc_lengths(view.groom);
    view.scalar_title = "arc length from the root [m]";
  }
  view.title = std::filesystem::path(path).filename().string();
  return view;
}

}  // namespace cuticle::viz
