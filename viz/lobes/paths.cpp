#include "viz/lobes/paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "core/file.h"

namespace cuticle::viz {
namespace {

/// An ellipse with half axes `across` (along y before turning) and `along`, turned; the wider one is 1.
struct Section {
  explicit Section(const PathsView& view)
      : along(view.aspect >= 1 ? 1 / view.aspect : 1),
        across(view.aspect >= 1 ? 1 : view.aspect),
        cosine(std::cos(view.turned)),
        sine(std::sin(view.turned)) {}
  glm::dvec2 inner(const glm::dvec2& p) const { return {cosine * p.x + sine * p.y, cosine * p.y - sine * p.x}; }
  glm::dvec2 outer(const glm::dvec2& p) const { return {cosine * p.x - sine * p.y, cosine * p.y + sine * p.x}; }
  glm::dvec2 normal(const glm::dvec2& p) const {
    const glm::dvec2 q = inner(p);
    return glm::normalize(outer({q.x / (along * along), q.y / (across * across)}));
  }
  /// Half the width that a ray along x sees.
  double half_width() const { return std::sqrt(across * across * cosine * cosine + along * along * sine * sine); }
  /// The two distances along a line at which it meets the section.
  glm::dvec2 meets(const glm::dvec2& from, const glm::dvec2& direction) const {
    const glm::dvec2 scale(along, across), p = inner(from) / scale, d = inner(direction) / scale;
    const double a = glm::dot(d, d), b = glm::dot(p, d), c = glm::dot(p, p) - 1;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    return {(-b - root) / a, (-b + root) / a};
  }
  double along, across, cosine, sine;
};

/// Snell's law; the zero vector where all is reflected. `normal` points to where the ray comes from.
glm::dvec2 refracted(const glm::dvec2& direction, const glm::dvec2& normal, double ratio) {
  const double cosine = -glm::dot(direction, normal), square = 1 - ratio * ratio * (1 - cosine * cosine);
  if (square < 0) return glm::dvec2(0);
  return ratio * direction + (ratio * cosine - std::sqrt(square)) * normal;
}

/// Unpolarised Fresnel reflectance from index 1 to `index`, or from `index` to 1 with 1 / index.
double fresnel(double cosine_in, double index) {
  const double square = 1 - (1 - cosine_in * cosine_in) / (index * index);
  if (square <= 0) return 1;
  const double cosine_out = std::sqrt(square);
  const double s = (cosine_in - index * cosine_out) / (cosine_in + index * cosine_out);
  const double p = (index * cosine_in - cosine_out) / (index * cosine_in + cosine_out);
  return (s * s + p * p) / 2;
}

double azimuth(const glm::dvec2& direction) { return std::atan2(direction.y, direction.x); }

/// Leaves the section at a point from within: the direction outside, and the share that goes out.
std::pair<glm::dvec2, double> leave(const Section& section, const glm::dvec2& at, const glm::dvec2& direction,
                                    double index) {
  const glm::dvec2 inward = -section.normal(at);
  const glm::dvec2 out = refracted(direction, inward, index);
  return {out, 1 - fresnel(std::abs(glm::dot(direction, inward)), 1 / index)};
}

}  // namespace

double bravais_index(double eta, double theta) {
  const double sine = std::sin(theta);
  return std::sqrt(eta * eta - sine * sine) / std::max(std::cos(theta), 1e-6);
}

SectionPath trace_section(const PathsView& view, double h) {
  const Section section(view);
  const double index = bravais_index(view.eta, view.theta);
  SectionPath path;
  path.h = h;
  const glm::dvec2 light(-1, 0), start(4, h * section.half_width());
  glm::dvec2 at = start + section.meets(start, light).x * light;
  const glm::dvec2 normal = section.normal(at);
  const double cosine = std::max(0.0, -glm::dot(light, normal)), reflected = fresnel(cosine, index);
  path.meets.push_back(at);
  path.leaves[0] = light + 2 * cosine * normal;
  path.share[0] = reflected;
  glm::dvec2 direction = refracted(light, normal, 1 / index);
  double kept = 1 - reflected;
  for (std::size_t lobe = 1; lobe < 3; ++lobe) {
    at += section.meets(at, direction).y * direction;
    path.meets.push_back(at);
    const auto [out, share] = leave(section, at, direction, index);
    path.leaves[lobe] = out;
    path.share[lobe] = kept * share;
    kept *= 1 - share;
    const glm::dvec2 outward = section.normal(at);
    direction -= 2 * glm::dot(direction, outward) * outward;
  }
  for (std::size_t lobe = 0; lobe < 3; ++lobe) path.phi[lobe] = azimuth(path.leaves[lobe]);
  return path;
}

double caustic_offset(const PathsView& view) {
  constexpr int steps = 2000;
  const double first = trace_section(view, 0).phi[2];
  double best = -1, farthest = 0;
  for (int k = 1; k < steps; ++k) {
    const double h = double(k) / steps,
                 away = std::abs(std::remainder(trace_section(view, h).phi[2] - first, 2 * std::numbers::pi));
    if (away <= farthest) return best > 1.5 / steps ? best : -1;
    farthest = away;
    best = h;
  }
  return -1;
}

Result<void> write_paths(const PathsView& view, const std::string& folder) {
  CUTICLE_TRY(make_folder(folder));
  std::string text = "h,phi_R_deg,phi_TT_deg,phi_TRT_deg,share_R,share_TT,share_TRT\n";
  constexpr double degree = std::numbers::pi / 180;
  for (int k = 0; k < view.rays; ++k) {
    const double h = view.rays == 1 ? 0 : 0.999 * (2.0 * k / (view.rays - 1) - 1);
    const SectionPath path = trace_section(view, h);
    text += fmt::format("{},{},{},{},{},{},{}\n", h, path.phi[0] / degree, path.phi[1] / degree, path.phi[2] / degree,
                        path.share[0], path.share[1], path.share[2]);
  }
  return write_text_file(folder + "/paths.csv", text);
}

}  // namespace cuticle::viz
