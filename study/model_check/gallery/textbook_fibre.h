#pragma once
// A near-field fibre after Chiang et al. 2016 written plainly in double, independently of bsdf, into which one mistake
// at a time can be built: the reference of the checks, and what they must recognise.
#include <array>

#include "study/model_check/diagnose.h"

namespace cuticle::study::model_check {

/// `mistake`: Cause::none for the fibre as it should be. Angles in radians; absorption per radius; `tilt` of the
/// scales, positive, moves R to theta_i + theta_o = -2 tilt.
struct TextbookFibre {
  double eta = 1.55;
  glm::dvec3 sigma_a{0.1, 0.5, 2};
  double beta = 0.3;  ///< standard deviation of R in theta_i, and scale of the logistic distribution in phi
  double tilt = 0.05;
  Cause mistake = Cause::none;
};

glm::dvec3 scattering(const TextbookFibre& fibre, const bsdf::Point& at);
double density(const TextbookFibre& fibre, const bsdf::Point& at);
glm::dvec3 albedo(const TextbookFibre& fibre, double theta_o, double h);
bsdf::Sample sampled(const TextbookFibre& fibre, const bsdf::SampleQuery& query);

}  // namespace cuticle::study::model_check
