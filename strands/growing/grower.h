#pragma once
// The path of one control hair: planted on a scalp vertex, grown by small steps, combed and kept outside the head.
#include "strands/growing/bun.h"
#include "strands/growing/growing.h"
#include "strands/growing/surface.h"

namespace cuticle::strands {

/// Head coordinates: about the middle of the scalp, in units of its width (1 unit = 0.15 m on an adult head).
struct HeadFrame {
  glm::dvec3 center{0};
  double unit = 1;
  glm::dvec3 place(const glm::dvec3& point) const { return (point - center) / unit; }
};

class Grower {
 public:
  Grower(const Head& head, const Style& style, const Grooming& grooming);

  /// Metres; by chance, the fringe and the regions. A cut and a bun set the length along the path instead.
  double length_of(std::size_t vertex) const;
  /// A fine path along which the control vertices are then placed; longer than the hair, since chords are shorter than
  /// arcs.
  std::vector<glm::dvec3> path(std::size_t vertex, double length) const;
  /// Length of the hair on that path: `length`, the way to the cut, or with a bun the whole path.
  double length_on(const std::vector<glm::dvec3>& path, double length) const;
  /// Moves a point out of the head and its colliders. `travelled`: arc length from the root, metres.
  glm::dvec3 outside(glm::dvec3 point, double travelled) const;

 private:
  std::vector<glm::dvec3> free_path(std::size_t vertex, double length) const;
  std::vector<glm::dvec3> path_into_bun(std::size_t vertex) const;
  glm::dvec3 turned(const glm::dvec3& point, const glm::dvec3& direction, double side, double travelled,
                    double step) const;
  glm::dvec3 comb_at(const glm::dvec3& point, double side) const;

  const Head& head_;
  const Style& style_;
  const Grooming& grooming_;
  HeadFrame frame_;
  std::vector<double> sides_;
  NearestSurface surface_;
  std::optional<BunFrame> bun_;
};

}  // namespace cuticle::strands
