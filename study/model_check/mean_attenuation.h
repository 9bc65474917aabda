#pragma once
// What a smooth dielectric cylinder scatters of the light that meets it, from the textbook: the truth of the absorbing
// furnace, and the same with a mistake built in, by which a model that makes that mistake is recognised.
#include "study/model_check/subject.h"

namespace cuticle::study::model_check {

/// How light is absorbed inside: along the chord, bent by the index of Bravais; along the *square* of the chord (as
/// printed in Marschner et al. 2003); or bent by another index: the medium's own, or that of p-polarised light.
enum class Physics { correct, squared_path, index_not_projected, index_of_the_other_polarisation };

/// Share of the light at offset h that leaves again, over the cylinder's orders; theta [rad], |theta| < pi/2, |h| <= 1.
glm::dvec3 attenuation_at(const Cylinder& cylinder, double theta, double h, Physics physics = Physics::correct);
/// Its mean over the fibre's width, half the integral over h.
glm::dvec3 mean_attenuation(const Cylinder& cylinder, double theta, Physics physics = Physics::correct);

}  // namespace cuticle::study::model_check
