// The light of facets toward many directions, compiled once for each instruction set (CMakeLists.txt, which gives it
// the name CUTICLE_ADD_FACETS): the loop over directions is one block of arithmetic.
#include "bsdf/huang/facets_met.h"
#include "bsdf/huang/meeting.glslh"
#include "core/flush_to_zero.h"

namespace cuticle::bsdf::huang {
namespace {

FNI Place<float> place_of(const FacetMet& met) {
  Place<float> at;
  at.circle = glm::vec2(0);
  at.normal = glm::vec3(met.normal[0], met.normal[1], 0);
  at.scale = at.normal;
  return at;
}

FNI Among<float> ray_of(const FacetMet& met) {
  Among<float> ray;
  ray.direction = glm::vec3(met.direction[0], met.direction[1], met.direction[2]);
  ray.facing = glm::vec3(met.facing[0], met.facing[1], met.facing[2]);
  ray.side = met.side;
  ray.depth = met.depth;
  return ray;
}

FNI void add_one(const Huang<float>& fibre, const FacetMet& met, int count, const LightPointers& lights) {
  const Place<float> at = place_of(met);
  const Among<float> ray = ray_of(met);
  const float energy[3] = {met.energy[0], met.energy[1], met.energy[2]};
  const LightPointers to = lights;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const float seen = seen_from_light(fibre, at, ray, glm::vec3(to.x[i], to.y[i], to.z[i]), 1.0F);
    to.red[i] += seen * energy[0];
    to.green[i] += seen * energy[1];
    to.blue[i] += seen * energy[2];
  }
}

void add_facets(const float* numbers, const FacetsMet& met, int count, const LightPointers& lights) {
  [[maybe_unused]] const FlushToZero guard;
  const Huang<float> fibre = *reinterpret_cast<const Huang<float>*>(numbers);
  for (int k = 0; k < met.count; ++k) add_one(fibre, met.facets[k], count, lights);
}

}  // namespace

extern const AddFacets CUTICLE_ADD_FACETS;
const AddFacets CUTICLE_ADD_FACETS = add_facets;

}  // namespace cuticle::bsdf::huang
