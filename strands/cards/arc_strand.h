#pragma once
// A strand by its arc length.
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace cuticle::strands {

class ArcStrand {
 public:
  /// At least two vertices, some apart; they stay where they are while this is used.
  explicit ArcStrand(std::span<const glm::vec3> vertices);
  float length() const { return along_.back(); }
  /// Of a vertex, metres from the root.
  float along(std::size_t vertex) const { return along_[vertex]; }
  /// The point so many metres from the root, 0 or more; beyond the tip straight on.
  glm::vec3 at(float distance) const;

 private:
  std::span<const glm::vec3> vertices_;
  std::vector<float> along_;
};

}  // namespace cuticle::strands
