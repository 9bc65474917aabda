#pragma once
// A registered model as the subject of the checks.
#include <cuticle/study/model_check/subject.h>

namespace cuticle::study::model_check {

/// The model with these values as its own setting, on the CPU in float or double. Roughness, absorption and tilt are
/// recognised by the names of its parameters (beta.., ..roughness..; sigma_a; alpha.., ..tilt..). A lobe beside R, TT,
/// TRT and TRRT claims all orders.
Subject subject_of(const bsdf::Model& model, const registry::ParameterValues& values, bsdf::Precision precision);

}  // namespace cuticle::study::model_check
