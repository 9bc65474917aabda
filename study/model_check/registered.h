#pragma once
// A registered model as the subject of the checks.
#include "study/model_check/subject.h"

namespace cuticle::study::model_check {

/// The model with these values as its own setting, on the CPU in float or double. Parameters are recognised by their
/// names: roughness (beta.., ..roughness..), absorption (sigma_a, sigma_ma), tilt in radians (alpha.., ..tilt..,
/// ..shift..). A model with a lobe `residual`, or one whose name ends in +, claims to carry all orders.
Subject subject_of(const bsdf::Model& model, const registry::ParameterValues& values, bsdf::Precision precision);

/// The settings under which a model is another function: none, each other value of each of its choices ("field=near"),
/// and an elliptical cross-section ("aspect=0.85").
std::vector<std::string> variants_of(const bsdf::Model& model);

/// The model's exceptions that hold with these values.
std::vector<bsdf::Exception> exceptions_of(const bsdf::Model& model, const registry::ParameterValues& values);

}  // namespace cuticle::study::model_check
