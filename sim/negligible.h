#pragma once
// What is too short to count.

namespace cuticle::sim {

/// Of a strand's length: files have segments of 1e-7 m, of which length and direction are rounding. `exact` and `rod`
/// weld what lies no farther from a vertex to it, and `stretch` counts the next segment from where the last that counts
/// ended.
inline constexpr double k_negligible_segment = 1e-4;

}  // namespace cuticle::sim
