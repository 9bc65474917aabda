#pragma once
// From the verdicts of the checks to the mistake that most likely explains them.
#include "study/model_check/model_check.h"

namespace cuticle::study::model_check {

/// The mistakes that are recognised; `none` where every check passed, `unknown` where no mistake explains what failed.
enum class Cause {
  none,
  unknown,
  halved_bessel_correction,  ///< log I0 = x + (-log(2 pi x) + 1/(8x)) / 2 for large x
  lobe_not_normalised,       ///< energy and density lose the same, without that jump
  squared_absorption_path,   ///< absorbed along 2 + 2 cos 2 gamma_t, the square of the chord
  wrong_bravais_index,       ///< refracted in the normal plane by another index than eta'
  missing_cosine,            ///< S carries 1 / cos(theta_i)
  cosine_included,           ///< S carries cos(theta_i)
  spurious_one_over_pi,      ///< S is off by a factor of pi
  tilt_after_sampling,       ///< the tilt is put on the direction drawn, not on theta_o before drawing
  value_times_pdf,           ///< the weights are S or S pdf, not S / pdf
  short_bessel_series,       ///< I0 for small x by too few terms of its series (ten, up to 12: 2 % too little)
  frame_swapped              ///< tangent and binormal are exchanged
};

/// "halved_bessel_correction", ...
std::string_view name_of(Cause cause);

struct Diagnosis {
  Cause cause = Cause::none;
  std::string words;  ///< what was seen that points to it
};

/// Probes a subject whose verdicts are given; the probes take as long as a check.
Diagnosis diagnose(const Subject& subject, std::span<const Verdict> verdicts, const Options& options);

}  // namespace cuticle::study::model_check
