#pragma once
// A registered model as the subject of the checks.
#include <cuticle/study/model_check/subject.h>

namespace cuticle::study::model_check {

/// The model with these values as its own setting, on the CPU in float or double. Parameters are recognised by their names: roughness
/// (beta.., ..roughness..), absorption (sigma_a, sigma_ma), tilt in radians (alpha.., ..tilt.., ..shift..). A model with a lobe
/// `residual`, or one whose name ends in +, claims to carry all orders.
Subject subject_of(const bsdf::Model& model, const registry::ParameterValues& values, bsdf::Precision precision);

}  // namespace cuticle::study::model_check
