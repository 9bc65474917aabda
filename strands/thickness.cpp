#include "strands/thickness.h"

#include <algorithm>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cuticle::strands {

namespace {

constexpr int k_cells = 64;

/// Of one view: cells of the unit square that fibres pass, and their projected area in cells.
class Silhouette {
 public:
  void add(const glm::dvec2& a, const glm::dvec2& b, double width) {
    const double length = glm::distance(a, b);
    area_ += length * width;
    const int pieces = 1 + int(length);
    for (int i = 0; i <= pieces; ++i) {
      const glm::ivec2 cell = glm::clamp(glm::ivec2(glm::mix(a, b, double(i) / pieces)), 0, k_cells - 1);
      covered_[std::size_t(cell.y * k_cells + cell.x)] = 1;
    }
  }
  double thickness() const {
    const auto cells = double(std::ranges::count(covered_, 1));
    return cells > 0 ? area_ / cells : 0;
  }

 private:
  std::vector<char> covered_ = std::vector<char>(k_cells * k_cells, 0);
  double area_ = 0;
};

}  // namespace

double optical_thickness(const Groom& groom) {
  const Bounds box = bounds(groom);
  const glm::dvec3 low(box.lower), size = glm::dvec3(box.upper) - low;
  const double cell = std::max({size.x, size.y, size.z}) / k_cells;
  if (!(cell > 0)) return 0;
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto seen = [&](std::uint32_t v) {
      const glm::dvec3 at = (glm::dvec3(groom.positions[v]) - low) / cell;
      return glm::dvec2(at[(axis + 1) % 3], at[(axis + 2) % 3]);
    };
    Silhouette silhouette;
    for (std::size_t s = 0; s < groom.strand_count(); ++s)
      for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v)
        silhouette.add(seen(v), seen(v + 1), double(groom.radii[v] + groom.radii[v + 1]) / cell);
    sum += silhouette.thickness();
  }
  return sum / 3;
}

}  // namespace cuticle::strands
