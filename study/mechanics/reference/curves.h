#pragma once
// Master curves of slender rods as reference/make_curves.py computes them (high precision, nothing shared with sim):
// what each holds is said there. Unit length and stiffness; weight Gamma = rho g A L^3 / (EI).
#include <vector>

namespace cuticle::study {

/// A place on a curve; `second`: of curves with two values.
struct ReferencePoint {
  double at = 0, value = 0, second = 0;
};

const std::vector<ReferencePoint>& cantilever_curve();    ///< Gamma: drop over width
const std::vector<ReferencePoint>& drape_curve();         ///< Gamma: drop and width of the tip, over the length
const std::vector<ReferencePoint>& hanging_arc_curve();   ///< natural curvature K: Gamma above which it stays plane
const std::vector<ReferencePoint>& standing_arc_curve();  ///< K: Gamma above which it falls to the side
const std::vector<ReferencePoint>& greenhill();           ///< 0: Gamma above which a column falls
const std::vector<ReferencePoint>& stick_slip_curve();    ///< share lowered: friction at which the tip slips
const std::vector<ReferencePoint>& beam_roots();          ///< mode: beta L of a clamped beam
const std::vector<ReferencePoint>& chain_roots();         ///< mode: zero of J0

}  // namespace cuticle::study
