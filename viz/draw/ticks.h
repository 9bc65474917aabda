#pragma once
// Where an axis has its ticks, and their text. Needs no VTK.
#include <string>
#include <vector>

namespace cuticle::viz {

/// Round numbers (1, 2, 2.5 or 5 times a power of ten) within lower .. upper, about `count` of them.
std::vector<double> ticks(double lower, double upper, int count);
/// Powers of ten within, or round numbers where there are fewer than two.
std::vector<double> logarithmic_ticks(double lower, double upper, int count);
/// Multiples of 15, 30, 45 or 90 degrees.
std::vector<double> degree_ticks(double lower, double upper, int count);
struct Tick {
  double at = 0;
  std::string text;  ///< "0.25", "1e-05"; five digits, or as many as tell it from its neighbours
};
std::vector<Tick> labelled(const std::vector<double>& ticks);

}  // namespace cuticle::viz
