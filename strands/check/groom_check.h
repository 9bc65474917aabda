#pragma once
// What a groom should hold before it is bound, simulated or drawn, and the mistake that it looks like where it does not.
#include <string>
#include <vector>

#include "strands/groom.h"

namespace cuticle::strands::check {

struct Verdict {
  std::string check;     ///< what was looked at
  bool passed = true;
  std::string measured;  ///< with its numbers and the bound
  std::string mistake;   ///< the likely cause by name; empty where it passed
  std::string remedy;    ///< empty where it passed
};

/// Verdicts on `groom` (valid, see validate), in a fixed order:
///
/// | check | passes where | else the mistake |
/// |---|---|---|
/// | units | the median strand is 1 mm to 2 m long | wrong_unit |
/// | radius | the median radius is 5 micrometres to 1 mm | wrong_radius |
/// | lengths | no strand is without length and no segment without one | repeated_points |
/// | segments | a strand's longest segment is at most 1000 times its shortest, which solvers are certified for | uneven_points |
/// | order | at most 1 in 1000 inner vertices turns back by more than 120 degrees | points_out_of_order |
/// | direction | not most of the strands that taper grow thicker towards their end | tip_first |
/// | copies | no two strands hold the same points | strands_twice |
/// | extent | no vertex is farther from the middle than 10 times nine in ten are | stray_points |
///
/// A groom without strands passes nothing but says so under `lengths` (mistake: no_strands), and nothing else is looked
/// at. Each mistake's groom is in groom_check_test.
std::vector<Verdict> check_groom(const Groom& groom);

}  // namespace cuticle::strands::check
