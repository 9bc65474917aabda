#include "viz/lobes/paths_view.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "viz/lobes/numbers.h"
#include "viz/lobes/surface.h"

namespace cuticle::viz {
namespace {

constexpr const char* k_lobes[] = {"R", "TT", "TRT"};
const glm::dvec2 k_gap(std::numeric_limits<double>::quiet_NaN());

void append(std::vector<glm::dvec2>& line, std::initializer_list<glm::dvec2> points) {
  line.insert(line.end(), points);
  line.push_back(k_gap);
}

std::vector<glm::dvec2> outline(const PathsView& view) {
  std::vector<glm::dvec2> points;
  const double along = view.aspect >= 1 ? 1 / view.aspect : 1, across = view.aspect >= 1 ? 1 : view.aspect;
  for (int k = 0; k <= 240; ++k) {
    const double angle = 2 * std::numbers::pi * k / 240, x = along * std::cos(angle), y = across * std::sin(angle);
    points.emplace_back(std::cos(view.turned) * x - std::sin(view.turned) * y,
                        std::sin(view.turned) * x + std::cos(view.turned) * y);
  }
  return points;
}

}  // namespace

/// Rays come from the right, as phi = 0 is back to the light.
PlotContent PathsPicture::section() const {
  PlotContent plot{fmt::format("cross-section, index {:.3f} in it", bravais_index(view_.eta, view_.theta)),
                   {"x [half the wider axis]", -2.6, 2.6},
                   {"y [half the wider axis]", -2.6, 2.6}};
  std::vector<glm::dvec2> incoming, inside, leaving[3];
  for (int k = 0; k < view_.rays; ++k) {
    const double h = view_.rays == 1 ? 0.5 : 0.98 * (2.0 * k / (view_.rays - 1) - 1);
    const SectionPath path = trace_section(view_, h);
    append(incoming, {{2.6, path.meets[0].y}, path.meets[0]});
    append(inside, {path.meets[0], path.meets[1], path.meets[2]});
    for (std::size_t lobe = 0; lobe < 3; ++lobe)
      append(leaving[lobe], {path.meets[lobe], path.meets[lobe] + 1.3 * path.leaves[lobe]});
  }
  plot.curves = {{"", incoming, {.75, .68, .45}, 1}, {"", inside, {.62, .62, .62}, 1}};
  for (std::size_t lobe = 0; lobe < 3; ++lobe)
    plot.curves.push_back({k_lobes[lobe], leaving[lobe], lobe_color(k_lobes[lobe]), 1.4});
  plot.curves.push_back({"", outline(view_), {.15, .15, .15}, 2.5});
  if (const double h = caustic_offset(view_); h > 0)
    for (const double side : {h, -h}) {
      const SectionPath path = trace_section(view_, side);
      plot.curves.push_back(
          {"",
           {{2.6, path.meets[0].y}, path.meets[0], path.meets[1], path.meets[2], path.meets[2] + 1.6 * path.leaves[2]},
           {.55, .05, .12},
           3});
    }
  plot.equal_scales = true;
  return plot;
}

PlotContent PathsPicture::azimuths() const {
  PlotContent plot{"where the light leaves to", {"h", -1, 1}, {"phi [deg]", -180, 180, PlotAxis::Kind::degrees}};
  for (std::size_t lobe = 0; lobe < 3; ++lobe) {
    Curve curve{k_lobes[lobe], {}, lobe_color(k_lobes[lobe]), 2.2};
    double last = 0;
    for (int k = 0; k <= 800; ++k) {
      const double h = 0.999 * (2.0 * k / 800 - 1), phi = trace_section(view_, h).phi[lobe] / k_degree;
      if (k > 0 && std::abs(phi - last) > 180) curve.points.push_back(k_gap);
      curve.points.emplace_back(h, phi);
      last = phi;
    }
    plot.curves.push_back(std::move(curve));
  }
  if (const double h = caustic_offset(view_); h > 0) {
    const double phi = trace_section(view_, h).phi[2] / k_degree;
    plot.marks.push_back({{h, phi}, fmt::format("caustic: h = {:.3f}, phi = {:.1f} deg", h, phi), {.55, .05, .12}});
  }
  return plot;
}

Result<void> PathsPicture::fill(const WindowArea& area) {
  section_.emplace(*area.add_renderer(0, 0, 0.6, 1), area.scale);
  azimuths_.emplace(*area.add_renderer(0.6, 0, 1, 1), area.scale);
  update();
  return {};
}

void PathsPicture::update() {
  section_->set(section());
  azimuths_->set(azimuths());
}

void PathsPicture::turn(double degrees) {
  view_.turned += degrees * k_degree;
  update();
}

Control PathsPicture::control(const std::string& name, const std::string& unit, double lower, double upper,
                              double& value, double unit_value) {
  return {name, unit, lower, upper, value / unit_value, {}, false, [this, &value, unit_value](double now, bool) {
            value = now * unit_value;
            update();
            return Result<void>();
          }};
}

std::vector<Control> PathsPicture::controls() {
  return {control("eta", "1", 1.05, 3, view_.eta, 1), control("theta_i", "deg", 0, 85, view_.theta, k_degree),
          control("aspect", "1", 0.4, 2.5, view_.aspect, 1), control("turned", "deg", -90, 90, view_.turned, k_degree)};
}

}  // namespace cuticle::viz
