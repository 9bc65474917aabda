#include "bsdf/together.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cuticle::bsdf {
namespace {

constexpr int k_most_effort = 256;

Result<void> check_together(const Model& model, int effort, const Request& request) {
  if (effort < 1 || effort > k_most_effort)
    return usage_error(fmt::format("together: {} is outside 1 .. {}", effort, k_most_effort));
  if (request.quantity != Quantity::S) return usage_error("together: only S of a viewer's lights is made together");
  if (model.scattering_from_viewer) return {};
  std::vector<std::string_view> names;
  for (const Model* each : models())
    if (each->scattering_from_viewer) names.push_back(each->entry.name);
  return usage_error(fmt::format("together: {} is not one of the models that make a viewer's lights together ({})",
                                 model.entry.name, fmt::join(names, ", ")),
                     "leave it out");
}

auto viewer_of(const Point& at) { return std::tie(at.theta_o, at.phi_o, at.h); }

}  // namespace

Result<void> evaluate_together(const Model& model, const registry::ParameterValues& values, int effort,
                               const Request& request, std::span<glm::dvec3> out) {
  CUTICLE_TRY(check_together(model, effort, request));
  CUTICLE_TRY(check_request(model, request, out.size()));
  std::vector<std::size_t> order(request.points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return viewer_of(request.points[a]) < viewer_of(request.points[b]); });
  std::vector<Point> points;
  for (std::size_t i : order) points.push_back(request.points[i]);
  std::vector<glm::dvec3> results(points.size());
  CUTICLE_TRY(scattering_from_viewers(model, values, effort, request.lobe, points, results));
  for (std::size_t i = 0; i < order.size(); ++i) out[order[i]] = results[i];
  return {};
}

}  // namespace cuticle::bsdf
