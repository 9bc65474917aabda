#pragma once
// How the flat cross-sections of a groom's strands are turned about their axes.
#include <vector>

#include "render/reference/fibre_point.h"

namespace cuticle::render::reference {

/// Real hair twists, and a groom does not say how: each strand has a turn of its own by chance, and may twist along its
/// length.
struct Turning {
  double twist = 0;        ///< whole turns per metre
  std::uint64_t seed = 0;  ///< of the strands' turns; not that of a picture's noise
};

/// The major axis of every strand's cross-section. At the root it stands at an angle that is drawn evenly for the
/// strand from the world's x axis, less its part along the strand (another axis where they are parallel); from there it
/// is carried by the smallest rotation between tangents, so that it is continuous and a straight strand keeps it, and
/// turned by `twist`. Test: cross_sections_test.cpp.
class CrossSections {
 public:
  /// `positions_at_end`: of the hair when the shutter closes; empty: it stands.
  CrossSections(const strands::Groom& hair, std::span<const glm::vec3> positions_at_end, const Turning& turning);
  /// Turns y, from which phi_o counts, and z into the cross-section at the point. `time`: of the shutter, 0 .. 1.
  void turn(FibrePoint& point, double time) const;

 private:
  struct Across {
    glm::vec3 normal{0};
    float length = 0;  ///< from the root, metres
  };
  static std::vector<Across> across(const strands::Groom& hair, std::span<const glm::vec3> positions);

  Turning turning_;
  std::vector<Across> at_begin_, at_end_;
};

}  // namespace cuticle::render::reference
