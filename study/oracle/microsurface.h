#pragma once
// Rough dielectric surfaces made of facets that do not know of each other (the Smith model): what happens to a ray that
// meets one. Sources: Walter et al. 2007 (distributions, masking), Heitz et al. 2016 (walks that follow light from
// facet to facet), Dupuy and Benyoub 2023 (visible normals of GGX).
#include <glm/vec3.hpp>

#include "core/random.h"

namespace cuticle::study::oracle {

enum class Facets { ggx, beckmann };

/// What becomes of light that other facets, or the next scale, would stop: `lost` is single scattering with the
/// separable masking G1(before) G1(after); `followed` walks on from facet to facet, so that no energy is missing.
enum class Blocked { lost, followed };

/// `roughness` is alpha of the distribution; 0 is a mirror-smooth surface.
struct Microsurface {
  Facets facets = Facets::ggx;
  double roughness = 0.2;
};

/// Smith's Lambda for a unit direction whose cosine to the mesonormal is given; for a cosine below 0, -1 -
/// Lambda(-cosine).
double smith_lambda(const Microsurface& surface, double cosine);

/// A facet's normal, drawn from those visible from `toward` (a unit vector, any side; the mesonormal is z).
glm::dvec3 visible_normal(const Microsurface& surface, glm::dvec3 toward, RandomStream& random);

/// After the surface: the direction of travel, whether the ray is now below it, and the share of its energy.
struct Meeting {
  glm::dvec3 direction{0};
  bool below = false;
  double energy = 0;  ///< 0: lost
};

/// A ray that travels down (direction.z < 0) in a medium of index `above` onto the surface of a medium of index
/// `below`.
Meeting meet_surface(const Microsurface& surface, Blocked blocked, glm::dvec3 direction, double above, double below,
                     RandomStream& random);

}  // namespace cuticle::study::oracle
