// What the view of strands draws in its scene, and what it finds there.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <glm/geometric.hpp>

#include "strands/lod/spread_order.h"
#include "viz/strands/strands_view.h"

namespace cuticle::viz {
namespace {

/// Their vertices alone: software OpenGL works through all points of a data set, drawn or not.
vtkSmartPointer<vtkPolyData> lines_of(const strands::Groom& groom, const std::vector<std::uint32_t>& strands,
                                      const std::vector<glm::dvec3>& colors) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  std::vector<glm::dvec3> own_colors;
  for (const std::uint32_t s : strands) {
    lines->InsertNextCell(int(groom.strand_size(s)));
    for (std::size_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) {
      const glm::dvec3 p(groom.positions[v]);
      lines->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
      own_colors.push_back(colors[v]);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetPointData()->SetScalars(color_array(own_colors));
  return data;
}

/// Few strands are drawn as tubes, so that their colour can be read.
double line_width(std::size_t strands) { return strands < 2000 ? 3 : strands < 8000 ? 1.5 : 1; }

}  // namespace

void StrandsPicture::draw(Part& part) {
  for (const auto& actor : {part.all, part.some})
    if (actor) part.renderer->RemoveActor(actor);
  std::vector<glm::dvec3> colors;
  for (const float value : part.colored.values) colors.push_back(scale_.color(double(value)));
  std::vector<std::uint32_t> order = strands::spread_order(strands::shapes_of(part.groom));
  const double width = line_width(order.size()) * size_;
  part.all = flat_actor(lines_of(part.groom, order, colors), width);
  if (view_.density_cell > 0) part.all->GetProperty()->SetOpacity(0.12);  // the density is looked at
  part.renderer->AddActor(part.all);
  part.some = nullptr;
  if (order.size() <= k_moving_strands) return;
  order.resize(k_moving_strands);
  part.some = flat_actor(lines_of(part.groom, order, colors), 2 * width);
  part.some->VisibilityOff();
  part.renderer->AddActor(part.some);
}

/// A black mark at the picked vertex, as long as a hundredth of the hair.
void StrandsPicture::show_strand(Part& part) {
  if (part.picked) part.renderer->RemoveActor(part.picked);
  if (strand_ >= part.groom.strand_count() || vertex_ >= part.groom.vertex_count()) return;
  const strands::Bounds box = strands::bounds(part.groom);
  const double reach = 0.005 * double(glm::distance(box.lower, box.upper));
  const glm::dvec3 at(part.groom.positions[vertex_]);
  part.picked = make_polyline({at - glm::dvec3(0, reach, 0), at + glm::dvec3(0, reach, 0)}, {0, 0, 0}, 9 * size_);
  part.renderer->AddActor(part.picked);
}

/// The vertex whose pixel lies nearest, within 8 pixels; of several, the one nearest to the eye.
std::optional<std::size_t> StrandsPicture::nearest_vertex(Part& part, const glm::ivec2& pixel) const {
  std::optional<std::size_t> best;
  double best_score = 1e300;
  for (std::size_t v = 0; v < part.groom.vertex_count(); ++v) {
    const glm::vec3& p = part.groom.positions[v];
    part.renderer->SetWorldPoint(double(p.x), double(p.y), double(p.z), 1);
    part.renderer->WorldToDisplay();
    const double* at = part.renderer->GetDisplayPoint();
    const double away = std::hypot(at[0] - pixel.x, at[1] - pixel.y);
    const double score = std::floor(away) + at[2];
    if (away > 8 || score >= best_score) continue;
    best = v;
    best_score = score;
  }
  return best;
}

Result<std::string> StrandsPicture::pick(const glm::ivec2& pixel) {
  for (Part& part : parts_) {
    if (!part.renderer->IsInViewport(pixel.x, pixel.y)) continue;
    const auto vertex = nearest_vertex(part, pixel);
    if (!vertex) return std::string();
    const auto after = std::upper_bound(part.groom.offsets.begin(), part.groom.offsets.end(), std::uint32_t(*vertex));
    strand_ = std::size_t(after - part.groom.offsets.begin()) - 1;
    vertex_ = *vertex;
    CUTICLE_TRY(update_curves());
    const glm::vec3& p = part.groom.positions[vertex_];
    std::string words =
        fmt::format("strand,{}\nvertex,{}\nx_m,{:.9g}\ny_m,{:.9g}\nz_m,{:.9g}\n", strand_, vertex_, p.x, p.y, p.z);
    for (const auto& [name, attribute] : part.groom.attributes) {
      const std::size_t item = attribute.domain == strands::Attribute::Domain::vertex ? vertex_ : strand_;
      words += name;
      for (int c = 0; c < attribute.components; ++c)
        words += fmt::format(",{:.9g}", attribute.values[item * std::size_t(attribute.components) + std::size_t(c)]);
      words += '\n';
    }
    return words;
  }
  return std::string();
}

}  // namespace cuticle::viz
