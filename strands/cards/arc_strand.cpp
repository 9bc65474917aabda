#include "strands/cards/arc_strand.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace cuticle::strands {

ArcStrand::ArcStrand(std::span<const glm::vec3> vertices) : vertices_(vertices), along_{0} {
  for (std::size_t k = 1; k < vertices.size(); ++k)
    along_.push_back(along_.back() + glm::distance(vertices[k - 1], vertices[k]));
}

glm::vec3 ArcStrand::at(float distance) const {
  auto end = std::upper_bound(along_.begin(), along_.end(), distance);
  if (end == along_.end()) end = std::lower_bound(along_.begin(), along_.end(), along_.back());  // the last with length
  const auto k = std::size_t(end - along_.begin());
  const float share = (distance - along_[k - 1]) / (along_[k] - along_[k - 1]);
  return vertices_[k - 1] + share * (vertices_[k] - vertices_[k - 1]);
}

}  // namespace cuticle::strands
