#include "cli/shadow_cut.h"

#include <glm/geometric.hpp>

#include "core/image/image.h"
#include "strands/statistics.h"

namespace cuticle::cli {

namespace {

/// Centres of the picture's pixels, top row first.
std::vector<glm::vec3> points_of_plane(int size, const shadows::Casters& casters) {
  const strands::Bounds bounds = strands::bounds(*casters.groom);
  const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.lower) + glm::dvec3(bounds.upper));
  const double half = 0.5 * glm::distance(glm::dvec3(bounds.lower), glm::dvec3(bounds.upper)) / 1.3;
  const glm::dvec3 up = glm::normalize(casters.to_light);
  const glm::dvec3 aside = std::abs(up.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 across = glm::normalize(glm::cross(up, aside));
  std::vector<glm::vec3> points;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = (2 * (x + 0.5) / size - 1) * half, v = (1 - 2 * (y + 0.5) / size) * half;
      points.emplace_back(middle + across * u + up * v);
    }
  return points;
}

}  // namespace

Result<void> draw_cut(const ShadowCut& cut, const shadows::Casters& casters,
                      std::span<const study::Candidate> candidates) {
  const std::vector<glm::vec3> points = points_of_plane(cut.size, casters);
  std::vector<Image> pictures;
  for (const study::Candidate& candidate : candidates) {
    CUTICLE_ASSIGN(const auto found, candidate.method->evaluate(casters, {points}, candidate.values));
    Image& picture = pictures.emplace_back(make_image(cut.size, cut.size, {"R", "G", "B"}));
    for (std::size_t k = 0; k < picture.pixels.size(); ++k) picture.pixels[k] = found.values[k / 3];
  }
  return write_png(cut.file, contact_sheet(pictures, int(pictures.size())));
}

}  // namespace cuticle::cli
