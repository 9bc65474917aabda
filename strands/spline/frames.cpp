#include "strands/spline/frames.h"

#include <algorithm>

#include "strands/spline/frame.glslh"
#include "strands/tangent.glslh"

namespace cuticle::strands {

StrandFrames frames_along(std::span<const glm::vec3> points, const glm::vec3& reference) {
  StrandFrames frames;
  if (points.empty()) return frames;
  glm::vec3 tangent = direction_or<float>(points.back() - points.front(), glm::vec3(0, 1, 0)), normal = reference;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3 chord = points[std::min(i + 1, points.size() - 1)] - points[i == 0 ? 0 : i - 1];
    const glm::vec3 next = direction_or<float>(chord, tangent);
    if (i > 0) normal = transported<float>(normal, tangent, next, normal);
    normal = across_or_any<float>(normal, next);
    tangent = next;
    frames.tangents.push_back(tangent);
    frames.normals.push_back(normal);
    frames.binormals.push_back(glm::cross(tangent, normal));
  }
  return frames;
}

}  // namespace cuticle::strands
