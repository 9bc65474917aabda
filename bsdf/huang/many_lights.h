#pragma once
// S of one viewer and many lights: the walks from the viewer serve all of them.
#include <span>

#include "bsdf/huang/fibre.glslh"
#include "bsdf/model.h"

namespace cuticle::bsdf::huang {

/// Model::scattering_from_viewer.
void scattering_from_viewer(const Huang<double>& fibre, int lobe, std::span<const Point> points,
                            std::span<glm::dvec3> out);

}  // namespace cuticle::bsdf::huang
