#pragma once
// What a twist does to a tube: how much of its volume linear blend and dual quaternions keep, beside the analytic
// value.
#include <string>
#include <vector>

#include "strands/skinning/skinning.h"
#include "study/engine/study.h"

namespace cuticle::study {

/// A closed tube along its axis, weights linear along it, one end still and the other turned by an angle.
struct TwistRow {
  double angle_deg = 0;
  strands::Skinning method = strands::Skinning::linear_blend;
  double volume_kept = 0, volume_analytic = 0;  ///< over the volume at rest
  double middle_radius_kept = 0;                ///< of the section half way, over that at rest
};
/// The radius of a section, over that at rest.
struct SectionRow {
  double place = 0;  ///< along the tube, 0 .. 1
  double linear_blend = 0, dual_quaternion = 0, linear_analytic = 0;
};
struct TwistStudy {
  std::vector<TwistRow> rows;
  std::vector<SectionRow> sections;  ///< of the greatest angle
};

/// Angles 0 .. 180 degrees. `rings`: sections of the tube, at least 3, odd so that one lies in the middle. Linear blend
/// keeps 1 - (1 - cos a) / 3 of the volume, for the section at place t has radius |1 - t + t exp(ia)|; dual quaternions
/// all of it. The measured volume is that of the triangles: within 1e-4 of the analytic value with 1,025 rings
/// (twist_study_test).
TwistStudy run_twist_study(int rings = 1025);

/// The two ways to skin as points; the error at an angle is the share of the volume that is lost. Truth: the volume at
/// rest, which a twist keeps. Plots: volume against angle, and radius along the tube at the greatest angle.
Study twist_declaration(int rings = 1025);

}  // namespace cuticle::study
