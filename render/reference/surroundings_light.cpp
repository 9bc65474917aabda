#include "render/reference/surroundings_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace cuticle::render::reference {

namespace {

constexpr double k_pi = std::numbers::pi;
const glm::dvec3 k_luminance{0.2126, 0.7152, 0.0722};  // of linear Rec.709

}  // namespace

Result<SurroundingsLight> SurroundingsLight::make(const Surroundings& surroundings) {
  const Image& picture = surroundings.picture;
  if (picture.channels() < 3 || picture.height < 1 || picture.width != 2 * picture.height)
    return bad_input(
        fmt::format("surroundings of {} x {} texels and {} channels: they must be twice as wide as high, "
                    "of three channels at least",
                    picture.width, picture.height, picture.channels()));
  SurroundingsLight light;
  light.width_ = picture.width;
  light.height_ = picture.height;
  light.turn_ = surroundings.turn_degrees * k_pi / 180;
  double sum = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const glm::dvec3 texel(picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2));
      light.radiance_.push_back(surroundings.scale * texel);
      sum += light.solid_angle(std::size_t(y)) * glm::dot(light.radiance_.back(), k_luminance);
      light.cumulative_.push_back(sum);
    }
  if (!(sum > 0) || !std::isfinite(sum))
    return bad_input(fmt::format("surroundings of luminance {}: they must shine, and be finite", sum));
  for (double& share : light.cumulative_) share /= sum;
  light.is_even_ = std::ranges::all_of(light.radiance_, [&](const auto& texel) { return texel == light.radiance_[0]; });
  return light;
}

double SurroundingsLight::solid_angle(std::size_t row) const {
  return 2 * k_pi / width_ * (std::cos(k_pi * double(row) / height_) - std::cos(k_pi * double(row + 1) / height_));
}

SurroundingsLight::Drawn SurroundingsLight::draw(double u0, double u1, double u2) const {
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u0);
  const std::size_t at = std::size_t(found - cumulative_.begin()), row = at / std::size_t(width_);
  const double column = double(at % std::size_t(width_)) + u1;
  const double top = std::cos(k_pi * double(row) / height_), low = std::cos(k_pi * double(row + 1) / height_);
  const double up = top + u2 * (low - top), across = std::sqrt(std::max(0.0, 1 - up * up));
  const double right = k_pi * (2 * column / width_ - 1) - turn_;
  const double share = cumulative_[at] - (at > 0 ? cumulative_[at - 1] : 0);
  return {{-std::sin(right) * across, up, std::cos(right) * across}, radiance_[at], share / solid_angle(row)};
}

std::size_t SurroundingsLight::texel(const glm::dvec3& to_light) const {
  const double down = std::acos(std::clamp(to_light.y, -1.0, 1.0)) / k_pi * height_;
  double column = (std::atan2(-to_light.x, to_light.z) + turn_) / (2 * k_pi) + 0.5;
  column = (column - std::floor(column)) * width_;
  const int x = std::clamp(int(column), 0, width_ - 1), y = std::clamp(int(down), 0, height_ - 1);
  return std::size_t(y) * std::size_t(width_) + std::size_t(x);
}

glm::dvec3 SurroundingsLight::radiance(const glm::dvec3& to_light) const { return radiance_[texel(to_light)]; }

double SurroundingsLight::density(const glm::dvec3& to_light) const {
  const std::size_t at = texel(to_light);
  return (cumulative_[at] - (at > 0 ? cumulative_[at - 1] : 0)) / solid_angle(at / std::size_t(width_));
}

}  // namespace cuticle::render::reference
