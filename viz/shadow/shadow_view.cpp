#include "viz/shadow/shadow_view.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <glm/geometric.hpp>

#include "viz/draw/detail/volume.h"

namespace cuticle::viz {
namespace {

constexpr std::size_t k_lines = 1500;  // hairs drawn in grey about the sheets

/// The quads of a sheet where hair is; `is_kept`: of its corners.
template <class Kept>
vtkSmartPointer<vtkActor> sheet_actor(const Sheet& sheet, const ColorScale& colors, const Kept& is_kept) {
  vtkNew<vtkPoints> points;
  std::vector<glm::dvec3> shades;
  for (std::size_t i = 0; i < sheet.positions.size(); ++i) {
    const glm::vec3& p = sheet.positions[i];
    points->InsertNextPoint(double(p.x), double(p.y), double(p.z));
    shades.push_back(colors.color(double(sheet.depths[i])));
  }
  vtkNew<vtkCellArray> quads;
  for (int y = 0; y + 1 < sheet.rows; ++y)
    for (int x = 0; x + 1 < sheet.columns; ++x) {
      const vtkIdType a = vtkIdType(y) * sheet.columns + x, b = a + 1, c = b + sheet.columns, d = a + sheet.columns;
      const auto has = [&](vtkIdType corner) {
        return sheet.is_hair[std::size_t(corner)] != 0 && is_kept(sheet.positions[std::size_t(corner)]);
      };
      if (has(a) && has(b) && has(c) && has(d)) quads->InsertNextCell({a, b, c, d});
    }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(quads);
  data->GetPointData()->SetScalars(color_array(shades));
  return flat_actor(data, 1);
}

vtkSmartPointer<vtkActor> hair_actor(const strands::Groom& groom, double width) {
  std::vector<std::vector<glm::dvec3>> lines;
  const std::size_t step = std::max<std::size_t>(1, groom.strand_count() / k_lines);
  for (std::size_t s = 0; s < groom.strand_count(); s += step) {
    const auto strand = groom.strand(s);
    lines.emplace_back(strand.begin(), strand.end());
  }
  auto actor = flat_actor(polyline_data(lines), width);
  actor->GetProperty()->SetColor(0.35, 0.33, 0.31);
  actor->GetProperty()->SetOpacity(0.25);
  return actor;
}

}  // namespace

Result<void> ShadowPicture::fill(const WindowArea& area) {
  scale_ = area.scale;
  Part* const parts[] = {&opacity_, &deep_, &volume_};
  for (int k = 0; k < 3; ++k) {
    parts[k]->renderer = area.add_renderer(k / 3.0, 0.4, (k + 1) / 3.0, 1);
    parts[k]->title = add_text(*parts[k]->renderer, "", 0.03, 0.97, 16 * scale_, true);
  }
  depth_bar_.emplace(*opacity_.renderer, scale_);
  deep_bar_.emplace(*deep_.renderer, scale_);
  transmittance_bar_.emplace(*volume_.renderer, scale_);
  curves_.emplace(*area.add_renderer(0, 0, 1, 0.4), scale_);
  if (!view_.through) {
    CUTICLE_ASSIGN(view_.through, dark_place(view_));
  }
  CUTICLE_TRY(update());
  look();
  return {};
}

void ShadowPicture::look() {
  vtkCamera& camera = *opacity_.renderer->GetActiveCamera();
  const glm::dvec3 to_light = glm::normalize(view_.to_light);
  const glm::dvec3 side = aside();
  const glm::dvec3 eye = side + 0.3 * glm::dvec3(0, 1, 0) + 0.25 * glm::cross(to_light, side);
  camera.SetViewUp(0, 1, 0);
  camera.SetFocalPoint(0, 0, 0);
  camera.SetPosition(eye.x, eye.y, eye.z);
  opacity_.renderer->ResetCamera();
  camera.SetWindowCenter(0, -0.1);
  camera.Zoom(1.3);
  for (Part* part : {&deep_, &volume_}) part->renderer->SetActiveCamera(&camera);
  for (Part* part : {&opacity_, &deep_, &volume_}) part->renderer->ResetCameraClippingRange();
}

void ShadowPicture::draw_surroundings(Part& part) {
  const LightRay ray = light_ray(view_);
  const glm::dvec3 beyond = ray.from + 0.25 * (ray.from - ray.to);
  part.props.push_back(make_polyline({beyond, ray.to}, {.85, .62, .05}, 3 * scale_));
  for (const auto& prop : part.props) part.renderer->AddViewProp(prop);
}

/// Across the light, level: the side that the camera looks from.
glm::dvec3 ShadowPicture::aside() const {
  return glm::normalize(glm::cross(glm::dvec3(0, 1, 0.001), glm::normalize(view_.to_light)));
}

/// `cut_open`: without what lies before the ray, which would hide the layers within.
void ShadowPicture::draw_sheets(Part& part, const std::vector<Sheet>& sheets, bool cut_open) {
  for (const auto& prop : part.props) part.renderer->RemoveViewProp(prop);
  part.props.clear();
  if (!cut_open) part.props.push_back(hair_actor(view_.groom, 1 * scale_));
  const glm::dvec3 through = view_.through.value_or(glm::dvec3(0)), side = aside();
  const auto is_kept = [&](const glm::vec3& p) { return !cut_open || glm::dot(glm::dvec3(p) - through, side) <= 0; };
  for (const Sheet& sheet : sheets) part.props.push_back(sheet_actor(sheet, depths_, is_kept));
  draw_surroundings(part);
}

void ShadowPicture::draw_volume(Part& part, const TransmittanceVolume& volume) {
  for (const auto& prop : part.props) part.renderer->RemoveViewProp(prop);
  const double darkest = double(*std::min_element(volume.values.begin(), volume.values.end()));
  transmittances_.lower = std::min(darkest, 0.99);
  const auto opacity = [](double fraction) { return fraction == 1 ? 0 : 0.12 + 0.5 * (1 - fraction); };
  part.props = {make_volume(volume.size, volume.origin, volume.spacing, volume.values, transmittances_, opacity)};
  draw_surroundings(part);
}

Result<void> ShadowPicture::update_curves() {
  CUTICLE_ASSIGN(const auto curves, depth_curves(view_));
  PlotContent plot{"optical depth -ln T along the marked ray",
                   {"distance from where the ray enters the hair [mm]"},
                   {"optical depth"}};
  const glm::dvec3 colors[] = {{0, 0, 0},       {.16, .42, .68}, {.80, .40, .10}, {.30, .55, .25},
                               {.55, .30, .60}, {.75, .10, .15}, {.10, .60, .62}, {.55, .45, .15}};
  for (std::size_t k = 0; k < curves.size(); ++k) {
    Curve curve{curves[k].method, {}, colors[k % std::size(colors)], curves[k].method == "truth" ? 3.5 : 2};
    for (const auto& point : curves[k].points) curve.points.emplace_back(1e3 * point[0], point[1]);
    plot.x.upper = std::max(k == 0 ? 1e-6 : plot.x.upper, curve.points.back().x);
    plot.curves.push_back(std::move(curve));
  }
  plot.lists_names = true;
  fit_y(plot);
  curves_->set(std::move(plot));
  return {};
}

Result<void> ShadowPicture::update() {
  CUTICLE_ASSIGN(const auto opacity, opacity_sheets(view_, 96));
  CUTICLE_ASSIGN(const auto deep, deep_opacity_sheets(view_, 96));
  std::vector<float> all;
  for (const auto& sheets : {opacity, deep})
    for (const Sheet& sheet : sheets) all.insert(all.end(), sheet.depths.begin(), sheet.depths.end());
  std::sort(all.begin(), all.end());
  if (!all.empty()) depths_.upper = std::max(0.1, double(all[std::size_t(0.995 * double(all.size() - 1))]));
  draw_sheets(opacity_, opacity, false);
  draw_sheets(deep_, deep, true);
  CUTICLE_ASSIGN(const TransmittanceVolume volume, transmittance_volume(view_, 56));
  draw_volume(volume_, volume);
  depth_bar_->set(depths_);
  deep_bar_->set(depths_);
  transmittance_bar_->set(transmittances_);
  opacity_.title->SetInput(fmt::format("opacity map: {} slices, {}", view_.layers, view_.name).c_str());
  deep_.title->SetInput(fmt::format("deep opacity map: {} layers, cut open at the ray", view_.layers).c_str());
  volume_.title->SetInput("transmittance as a volume");
  return update_curves();
}

std::vector<Control> ShadowPicture::controls() {
  std::vector<Control> list;
  list.push_back({"layers", "", 1, 16, double(view_.layers), {}, true, [this](double value, bool resting) {
                    view_.layers = int(value);
                    return resting ? update() : Result<void>();
                  }});
  list.push_back({"alpha", "1", 0.01, 1, view_.alpha, {}, false, [this](double value, bool resting) {
                    view_.alpha = value;
                    return resting ? update() : Result<void>();
                  }});
  const strands::Bounds box = strands::bounds(view_.groom);
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 now = view_.through.value_or((glm::dvec3(box.lower) + glm::dvec3(box.upper)) / 2.0);
    list.push_back({fmt::format("ray through {}", "xyz"[axis]),
                    "m",
                    double(box.lower[axis]),
                    double(box.upper[axis]),
                    now[axis],
                    {},
                    false,
                    [this, axis, now](double value, bool resting) {
                      if (!view_.through) view_.through = now;
                      (*view_.through)[axis] = value;
                      return resting ? update() : Result<void>();
                    }});
  }
  return list;
}

void ShadowPicture::turn(double degrees) {
  opacity_.renderer->GetActiveCamera()->Azimuth(degrees);
  for (Part* part : {&opacity_, &deep_, &volume_}) part->renderer->ResetCameraClippingRange();
}

/// The hair's vertex under the mouse becomes the place that the ray passes.
Result<std::string> ShadowPicture::pick(const glm::ivec2& pixel) {
  for (Part* part : {&opacity_, &deep_, &volume_}) {
    if (!part->renderer->IsInViewport(pixel.x, pixel.y)) continue;
    double best = 12;
    std::optional<glm::dvec3> found;
    for (const glm::vec3& p : view_.groom.positions) {
      part->renderer->SetWorldPoint(double(p.x), double(p.y), double(p.z), 1);
      part->renderer->WorldToDisplay();
      const double* at = part->renderer->GetDisplayPoint();
      const double away = std::hypot(at[0] - pixel.x, at[1] - pixel.y);
      if (away < best) best = away, found = glm::dvec3(p);
    }
    if (!found) return std::string();
    view_.through = found;
    CUTICLE_TRY(update());
    return fmt::format("ray_through_m,{:.9g},{:.9g},{:.9g}\n", found->x, found->y, found->z);
  }
  return std::string();
}

Result<void> ShadowPicture::write_files(const std::string& folder) { return write_shadow(view_, folder); }

}  // namespace cuticle::viz
