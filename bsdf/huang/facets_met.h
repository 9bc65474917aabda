#pragma once
// Facets that walks from one viewer meet, kept so that their light toward any number of directions is a sum. Included
// by units that no symbol may leave, so it holds types only.

namespace cuticle::bsdf::huang {

/// A facet that is met on the way, as seen_from_light takes it: the way's direction; the mean normal of the facets near
/// it; that of the smooth fibre, across its axis; the side; the depth; and the energy that arrives, over all paths.
struct FacetMet {
  float direction[3], facing[3], normal[2], side, depth, energy[3];
};
struct FacetsMet {
  const FacetMet* facets;
  int count;
};

/// Directions of light, x and y across the fibre and z along it, and what is added to.
struct LightPointers {
  const float *x, *y, *z;
  float *red, *green, *blue;
};

/// The light of all facets toward `count` directions, a multiple of 16. `numbers`: of Huang.
using AddFacets = void (*)(const float* numbers, const FacetsMet& met, int count, const LightPointers& lights);

}  // namespace cuticle::bsdf::huang
