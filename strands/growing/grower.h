#pragma once
// The path of one control hair: planted on a scalp vertex, grown by small steps, combed and kept outside the head.
#include "strands/growing/bun.h"
#include "strands/growing/growing.h"
#include "strands/growing/surface.h"

namespace cuticle::strands {

/// The parameters as numbers.
struct Style {
  explicit Style(const registry::ParameterValues& values)
      : vertices(int(values.integer("control_vertices"))),
        length(values.real("length")),
        variation(values.real("length_variation")),
        growth(values.real("segment_growth")),
        parting(values.real("parting")),
        comb(values.real("comb")),
        droop(values.real("droop")),
        volume(values.real("volume")),
        under(values.real("under")),
        cut_height(values.real("cut_height")),
        fringe(values.real("fringe")),
        clump(values.real("clump")),
        radius(values.real("radius")),
        seed(std::uint64_t(values.integer("seed"))) {}
  int vertices;
  double length, variation, growth, parting, comb, droop, volume, under, cut_height, fringe, clump, radius;
  std::uint64_t seed;
};

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
