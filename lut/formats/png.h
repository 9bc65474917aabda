#pragma once
// What the PNG formats share: whole numbers of 8 or 16 bits from 0 to 1, no transfer curve.
#include <cmath>

#include "lut/format.h"

namespace cuticle::lut {

template <int bits>
double nearest_step(double stored) {
  constexpr double steps = (1 << bits) - 1;
  return std::round(stored * steps) / steps;
}

template <int bits>
Result<void> write_steps(const std::string& path, const Image& image, const std::string&) {
  return write_png(path, image, bits);
}

template <int bits>
Format png_format(std::string_view name, std::string_view summary) {
  return {name,       "png",      summary, 1, true, 1.0 / ((1 << bits) - 1), nearest_step<bits>, write_steps<bits>,
          read_image, mip_levels, bits / 8};
}

}  // namespace cuticle::lut
