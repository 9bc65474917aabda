#include "viz/lobes/lobes_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCamera.h>
#include <glm/geometric.hpp>

#include "viz/lobes/numbers.h"

namespace cuticle::viz {
namespace {

std::vector<std::pair<std::string, glm::dvec3>> colored_names(const LobeValues& values, const std::string& shown) {
  std::vector<std::pair<std::string, glm::dvec3>> names;
  for (const std::string& lobe : values.lobes)
    if (shown == "all" || shown == "sum" || shown == lobe) names.emplace_back(lobe, lobe_color(lobe));
  return names;
}

/// Curves of a model: solid of the first, dashed of the second, which has no names of its own where both are shown.
void add_curves(PlotContent& plot, const std::vector<LobeCurve>& curves, const std::string& shown, bool second) {
  constexpr std::size_t most = 3;
  for (std::size_t k = 0; k < curves.size() && k < most; ++k) {
    if (shown != "all" && shown != "sum" && shown != curves[k].lobe) continue;
    plot.curves.push_back(
        {second ? std::string() : curves[k].lobe, curves[k].points, lobe_color(curves[k].lobe), 2.2, second});
  }
}

void add_slices(PlotContent& plot, const std::vector<LobeCurve>& slices) {
  for (std::size_t k = 0; k < slices.size(); ++k)
    plot.curves.push_back({slices[k].lobe, slices[k].points,
                           ramp_color(Ramp::sequential, 0.9 * double(k) / double(slices.size())), 2.2, false});
}

/// Where a pixel's ray meets the plane of the fibre and the light, y = 0.
glm::dvec3 in_plane_of_light(vtkRenderer& renderer, const glm::ivec2& pixel) {
  const auto at_depth = [&](double depth) {
    renderer.SetDisplayPoint(pixel.x, pixel.y, depth);
    renderer.DisplayToWorld();
    const double* p = renderer.GetWorldPoint();
    return glm::dvec3(p[0], p[1], p[2]) / p[3];
  };
  const glm::dvec3 near = at_depth(0), far = at_depth(1);
  const double share = std::abs(far.y - near.y) > 1e-12 ? near.y / (near.y - far.y) : 0;
  return near + share * (far - near);
}

bool is_in(vtkRenderer& renderer, const glm::ivec2& pixel) { return renderer.IsInViewport(pixel.x, pixel.y); }

}  // namespace

void LobesPicture::lay_out(const WindowArea& area) {
  const bool two = view_.models.size() == 2 && !view_.difference;
  const auto plots_below = [&](double x0, double x1, double y0, double y1) {
    return area.add_renderer(x0, y0, x1, y1);
  };
  for (std::size_t k = 0; k < (two ? 2u : 1u); ++k) {
    const auto renderer =
        two ? area.add_renderer(0.5 * double(k), 0.4, 0.5 * double(k + 1), 1) : area.add_renderer(0, 0, 0.62, 1);
    scenes_.push_back(std::make_unique<LobesScene>(*renderer, area.scale));
  }
  longitudinal_.emplace(two ? *plots_below(0, 0.5, 0, 0.4) : *plots_below(0.62, 1, 0.5, 1), area.scale);
  azimuthal_.emplace(two ? *plots_below(0.5, 1, 0, 0.4) : *plots_below(0.62, 1, 0, 0.5), area.scale);
  if (shows_difference()) bar_.emplace(scenes_[0]->renderer(), area.scale);
}

Result<void> LobesPicture::fill(const WindowArea& area) {
  lay_out(area);
  return update(true);
}

std::string LobesPicture::words_of(const LobeValues& values) const {
  std::vector<std::string> shares;
  for (std::size_t lobe = 0; lobe < values.lobes.size(); ++lobe)
    shares.push_back(fmt::format("{} {:.3g}", values.lobes[lobe], scattered(values.grid, values.values[lobe])));
  const std::string radius = view_.settings.logarithmic
                                 ? fmt::format("radius: log10 S, {:g} decades up to {:.3g} 1/sr", k_decades, peak_)
                                 : fmt::format("radius: S, linear up to {:.3g} 1/sr", peak_);
  return fmt::format("{}\nscattered: {}, all {:.3g} of the light\nrings: M's cones at radius 1; S in the normal plane",
                     radius, fmt::join(shares, ", "), scattered(values.grid, values.sum()));
}

Result<void> LobesPicture::update_surfaces(const std::vector<LobeValues>& values) {
  peak_ = 0;
  const bool difference = shows_difference();
  for (const LobeValues& of_model : values)
    peak_ = std::max(peak_, peak_of(of_model, difference ? "sum" : view_.settings.lobe));
  if (difference) {
    scenes_[0]->set_surfaces({difference_surface(values[0], values[1], view_.settings, peak_)}, values[0].grid);
    const auto &first = view_.models[0].model->entry.name, &second = view_.models[1].model->entry.name;
    bar_->set({Ramp::diverging, -100, 100, false, fmt::format("({1} - {0}) / ({1} + {0}) [%]", first, second)});
    scenes_[0]->set_words(fmt::format("{} and {}: the larger S, coloured by their difference", first, second), "");
    return {};
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    CUTICLE_ASSIGN(const auto surfaces, make_surfaces(values[k], view_.settings, peak_));
    scenes_[k]->set_surfaces(surfaces, values[k].grid);
    const std::string near = is_near_field(view_.models[k]) ? fmt::format(", h = {:.3g}", view_.settings.h) : "";
    scenes_[k]->set_words(fmt::format("{}: S for light from theta_i = {:.4g} deg{}", view_.models[k].model->entry.name,
                                      view_.settings.theta_i / k_degree, near),
                          words_of(values[k]));
    scenes_[k]->set_colors(colored_names(values[k], view_.settings.lobe));
  }
  return {};
}

Result<void> LobesPicture::update_plots() {
  const std::string angle = fmt::format("{:.4g} deg", view_.settings.theta_i / k_degree);
  PlotContent m{"M: along the fibre", {"theta_o [deg]", -90, 90, PlotAxis::Kind::degrees}, {"M [1/rad]"}};
  PlotContent n{fmt::format("N: around the fibre, theta_d = {:.4g} deg", -view_.settings.theta_i / k_degree),
                {"phi [deg]", -180, 180, PlotAxis::Kind::degrees},
                {"N [1/rad]"}};
  for (std::size_t k = 0; k < view_.models.size(); ++k) {
    CUTICLE_ASSIGN(const auto along, longitudinal_curves(view_.models[k], view_.settings));
    add_curves(m, along, view_.settings.lobe, k == 1);
    if (k < scenes_.size()) scenes_[k]->set_light(view_.settings.theta_i, along);
    if (is_near_field(view_.models[k]) && view_.models.size() == 1) {
      CUTICLE_ASSIGN(const auto slices, azimuthal_slices(view_.models[k], view_.settings));
      add_slices(n, slices);
    } else {
      CUTICLE_ASSIGN(const auto around, azimuthal_curves(view_.models[k], view_.settings));
      add_curves(n, around, view_.settings.lobe, k == 1);
    }
  }
  if (view_.models.size() == 2)
    m.title +=
        fmt::format(" (solid {}, dashed {})", view_.models[0].model->entry.name, view_.models[1].model->entry.name);
  fit_y(m);
  fit_y(n);
  longitudinal_->set(std::move(m));
  azimuthal_->set(std::move(n));
  return {};
}

Result<void> LobesPicture::update(bool resting) {
  std::vector<LobeValues> values;
  for (const ShownModel& shown : view_.models) {
    CUTICLE_ASSIGN(values.emplace_back(),
                   lobe_values(shown, view_.settings, resting ? DirectionGrid{} : k_moving_grid, resting));
  }
  CUTICLE_TRY(update_surfaces(values));
  for (const auto& scene : scenes_) scene->set_rings(view_.settings.logarithmic, peak_);
  return update_plots();
}

void LobesPicture::turn(double degrees) {
  for (const auto& scene : scenes_) {
    scene->renderer().GetActiveCamera()->Azimuth(degrees);
    scene->renderer().ResetCameraClippingRange();
  }
}

bool LobesPicture::grab(const glm::ivec2& pixel) {
  const glm::dvec3 light(std::cos(view_.settings.theta_i), 0, std::sin(view_.settings.theta_i));
  for (std::size_t k = 0; k < scenes_.size(); ++k) {
    vtkRenderer& renderer = scenes_[k]->renderer();
    if (!is_in(renderer, pixel)) continue;
    renderer.SetWorldPoint(1.2 * light.x, 0, 1.2 * light.z, 1);
    renderer.WorldToDisplay();
    const double* at = renderer.GetDisplayPoint();
    held_ = k;
    if (std::hypot(at[0] - pixel.x, at[1] - pixel.y) < 30) return true;
  }
  return false;
}

Result<void> LobesPicture::drag(const glm::ivec2& pixel, bool resting) {
  const glm::dvec3 at = in_plane_of_light(scenes_[held_]->renderer(), pixel);
  view_.settings.theta_i = std::clamp(std::atan2(at.z, std::max(at.x, 1e-9)), -89 * k_degree, 89 * k_degree);
  return update(resting);
}

Result<void> LobesPicture::write_files(const std::string& folder) { return write_lobes(view_, folder); }

}  // namespace cuticle::viz
