#include "viz/lobes/detail/lobes_scene.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCamera.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

namespace cuticle::viz {
namespace {

const glm::dvec3 k_grey(0.6, 0.6, 0.6), k_light(0.85, 0.65, 0.05);

/// A circle about the fibre.
std::vector<glm::dvec3> circle(double radius, double height) {
  std::vector<glm::dvec3> points;
  for (int k = 0; k <= 120; ++k) {
    const double angle = 2 * std::numbers::pi * k / 120;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
  }
  return points;
}

void look_at_lobes(vtkRenderer& renderer) {
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.SetViewUp(0, 0, 1);
  camera.SetFocalPoint(0, 0, -0.05);
  camera.SetPosition(2.4, -4.6, 2.0);
  const int* size = renderer.GetSize();
  const double narrowness = std::max(1.0, 0.95 * size[1] / std::max(1, size[0]));
  camera.SetViewAngle(2 * std::atan(std::tan(15 * std::numbers::pi / 180) * narrowness) * 180 / std::numbers::pi);
  renderer.ResetCameraClippingRange();
}

}  // namespace

LobesScene::LobesScene(vtkRenderer& renderer, double scale) : renderer_(renderer), scale_(scale) {
  title_ = add_text(renderer, "", 0.025, 0.975, 19 * scale, true);
  below_ = add_text(renderer, "", 0.025, 84 * scale / renderer.GetSize()[1], 15 * scale);
  renderer.AddActor(make_polyline({{0, 0, -1.2}, {0, 0, 1.2}}, {.45, .36, .28}, 6 * scale));
  add_label(renderer, "fibre, to the tip", {0.05, 0, 1.1}, 15 * scale);
  renderer.AddActor(make_polyline({{0, 0, 0}, {1.1, 0, 0}}, k_grey, 1.5 * scale));
  add_label(renderer, "phi = 0", {1.11, 0, 0}, 14 * scale);
  renderer.AddActor(make_polyline({{0, 0, 0}, {0, 1.1, 0}}, k_grey, 1.5 * scale));
  add_label(renderer, "phi = 90 deg", {-0.5, 1.12, 0.1}, 14 * scale);  // beside its axis: the light's ray crosses there
  look_at_lobes(renderer);
}

void LobesScene::replace(std::vector<vtkSmartPointer<vtkProp>>& old, std::vector<vtkSmartPointer<vtkProp>> now) {
  for (const auto& prop : old) renderer_.RemoveViewProp(prop);
  for (const auto& prop : now) renderer_.AddViewProp(prop);
  old = std::move(now);
}

vtkSmartPointer<vtkProp> LobesScene::label(const std::string& text, const glm::dvec3& at, double size) const {
  auto actor = vtkSmartPointer<vtkBillboardTextActor3D>::New();
  actor->SetInput(text.c_str());
  actor->SetPosition(at.x, at.y, at.z);
  actor->GetTextProperty()->SetFontSize(int(size * scale_ + 0.5));
  actor->GetTextProperty()->SetColor(0.12, 0.12, 0.12);
  return actor;
}

void LobesScene::set_surfaces(const std::vector<LobeSurface>& surfaces, const DirectionGrid& grid) {
  std::vector<vtkSmartPointer<vtkProp>> now;
  for (const LobeSurface& surface : surfaces) {
    const auto data = grid_data(surface.positions, grid.columns, surface.colors);
    if (now.empty()) first_ = data;
    const auto actor = smooth_actor(data, 0.25);
    actor->GetProperty()->SetSpecular(0.15);
    now.push_back(actor);
  }
  replace(surfaces_, std::move(now));
}

void LobesScene::set_light(double theta_i, const std::vector<LobeCurve>& longitudinal) {
  const glm::dvec3 light(std::cos(theta_i), 0, std::sin(theta_i));
  std::vector<vtkSmartPointer<vtkProp>> now = {make_polyline({1.25 * light, {0, 0, 0}}, k_light, 4 * scale_),
                                               label("light", 1.27 * light, 15)};
  for (const LobeCurve& lobe : longitudinal) {
    const double cone = cone_of(lobe);
    now.push_back(make_polyline(circle(std::cos(cone), std::sin(cone)), lobe_color(lobe.lobe), 1.5 * scale_));
  }
  replace(light_, std::move(now));
}

/// Rings in the normal plane at whole decades (or quarters of the peak) with their values.
void LobesScene::set_rings(bool logarithmic, double peak) {
  std::vector<vtkSmartPointer<vtkProp>> now;
  const int rings = logarithmic ? int(k_decades) : 4;
  for (int k = 1; k <= rings; ++k) {
    const double radius = double(k) / rings;
    now.push_back(make_polyline(circle(radius, 0), {0.78, 0.78, 0.78}, 1 * scale_));
    const double value = logarithmic ? peak * std::pow(10.0, k - rings) : peak * radius;
    now.push_back(label(fmt::format("{:.2g}", value), {radius * std::cos(-2.2), radius * std::sin(-2.2), 0}, 13));
  }
  replace(rings_, std::move(now));
}

void LobesScene::set_words(const std::string& title, const std::string& below) {
  title_->SetInput(title.c_str());
  below_->SetInput(below.c_str());
}

void LobesScene::set_colors(const std::vector<std::pair<std::string, glm::dvec3>>& names) {
  if (names_.empty()) add_legend(renderer_, names, 0.97, 0.975, scale_), names_.emplace_back();
}

}  // namespace cuticle::viz
