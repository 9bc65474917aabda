#include "study/oracle/two_fibres.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace cuticle::study::oracle {

namespace {

constexpr double k_pi = std::numbers::pi;

struct Place {
  double y = 0, z = 0;
};

/// Where a half line across the fibres enters the circle around `middle`; negative: nowhere.
double entry(const Place& from, double azimuth, double middle, double radius) {
  const double y = middle - from.y, z = -from.z;
  const double along = y * std::cos(azimuth) + z * std::sin(azimuth);
  const double square = radius * radius - (y * y + z * z - along * along);
  return square > 0 ? along - std::sqrt(square) : -1;
}

class Walk {
 public:
  Walk(const TwoFibres& fibres, const OracleLight& light) : fibres_(fibres), light_(light) {}

  double radiance(int fibre, double offset, int scatterings, std::mt19937_64& random) const {
    std::uniform_real_distribution<double> unit(0, 1);
    Place at{fibres_.distance * fibre + fibres_.radius * offset, fibres_.radius * std::sqrt(1 - offset * offset)};
    double sum = 0, weight = 1;
    for (int count = 1;; ++count) {
      if (entry(at, light_.phi, other_axis(fibre), fibres_.radius) <= 0)
        sum += weight * fibres_.coefficient * std::cos(light_.theta);
      if (count == scatterings) return sum;
      // Directions by cos^2 theta over angles, of which S cos(theta) / density is the albedo: only the azimuth matters.
      const double azimuth = 2 * k_pi * unit(random), away = entry(at, azimuth, other_axis(fibre), fibres_.radius);
      if (away <= 0) return sum;
      at = {at.y + away * std::cos(azimuth), at.z + away * std::sin(azimuth)};
      fibre = 1 - fibre;
      weight *= k_pi * k_pi * fibres_.coefficient;
    }
  }

 private:
  double other_axis(int fibre) const { return fibres_.distance * (1 - fibre); }
  const TwoFibres& fibres_;
  const OracleLight& light_;
};

}  // namespace

SeenRadiance seen_radiance(const TwoFibres& fibres, const OracleLight& light, int scatterings, std::int64_t walks,
                           std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> across(-1, 1);
  const Walk walk(fibres, light);
  double sum = 0, squares = 0;
  for (std::int64_t k = 0; k < walks; ++k) {
    const double one = walk.radiance(int(k % 2), across(random), scatterings, random);
    sum += one;
    squares += one * one;
  }
  const double count = double(walks), mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / (count - 1))};
}

}  // namespace cuticle::study::oracle
