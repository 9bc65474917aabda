#pragma once
// What one instruction set's unit offers, and the rows that rods add to those of sim/chains/chain_rows.h.
#include "sim/chains/chain_rows.h"

namespace cuticle::sim::rod {

/// Of a vertex, for the hinge at its parent: stiffness k and g over the mean link's mass (m^2/s^2), C in the frame of
/// the director, natural difference of angles, inverse of the length used for bending (1/m), and the state: the angle
/// of the material about the link. Of the anchor: direction of the clamp and a director across it, rest space.
namespace hinge_row {
constexpr int stiffness = 0, twist = 1, bend_x = 2, bend_y = 3, natural_angle = 4, inverse_length = 5, angle = 6,
              count = 7;
constexpr int direction = 0, director = 3;  // of the anchor
}  // namespace hinge_row

/// Scratch of a vertex after that of sim/chains. The band: 4 rows (x, y, z, tension) of the symmetric matrix, each its
/// diagonal and 8 numbers to the left, then the right-hand side.
namespace rod_row {
constexpr int inertia = chains::scratch_row::inverse_mass;  // a row that rods leave free
constexpr int coast = 16, coasted = 19, director = 22, natural = 25, natural_spin = 28, across = 31, along = 32,
              moment = 33, rounding = 34, angle_coupling = 35, angle_value = 36, pull = 37, gain = 40, spin = 41,
              spin_pull = 42, band = 45, right = 81, pushed = 85, count = 88;
static_assert(coast == chains::scratch_row::count);
}  // namespace rod_row

/// By whether strands are pulled to a place (clumping) and whether there are spheres.
struct Kernels {
  chains::Advance<float> advance[2][2];
  chains::Advance<double> advance_double[2][2];
};

}  // namespace cuticle::sim::rod
