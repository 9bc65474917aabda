#include "scene/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace cuticle::scene {

namespace {

constexpr double k_pi = std::numbers::pi;
const glm::dvec3 k_luminance{0.2126, 0.7152, 0.0722};  // of linear Rec.709

/// Columns and rows [begin, end), and the light that comes from them.
struct Region {
  glm::ivec2 begin, end;
  double luminance = 0;
};

/// The sphere that the picture shows.
class Sphere {
 public:
  Sphere(const Image& picture, double turn) : picture_(picture), turn_(turn) {}

  Region region(glm::ivec2 begin, glm::ivec2 end) const {
    Region region{begin, end};
    for (int y = begin.y; y < end.y; ++y)
      for (int x = begin.x; x < end.x; ++x) region.luminance += luminance(x, y);
    return region;
  }
  glm::dvec3 direction(int x, int y) const {
    const double down = k_pi * (y + 0.5) / picture_.height, right = k_pi * (2 * (x + 0.5) / picture_.width - 1) - turn_;
    return {-std::sin(right) * std::sin(down), std::cos(down), std::cos(right) * std::sin(down)};
  }
  bool is_wide(const Region& region) const {
    const glm::ivec2 size = region.end - region.begin;
    const double ring = std::sin(k_pi * (region.begin.y + region.end.y) / (2.0 * picture_.height));
    return size.y < 2 || (size.x > 1 && 2.0 * size.x * ring / picture_.width >= double(size.y) / picture_.height);
  }
  /// Luminance of a column or a row of a region.
  double line(const Region& region, int axis, int at) const {
    double sum = 0;
    for (int k = region.begin[1 - axis]; k < region.end[1 - axis]; ++k)
      sum += axis == 0 ? luminance(at, k) : luminance(k, at);
    return sum;
  }
  Light light(const Region& region) const {
    Light light{.name = "environment", .to_light = {}, .irradiance = {}};
    for (int y = region.begin.y; y < region.end.y; ++y)
      for (int x = region.begin.x; x < region.end.x; ++x) {
        light.to_light += luminance(x, y) * direction(x, y);
        light.irradiance += solid_angle(y) * radiance(x, y);
      }
    const double length = glm::length(light.to_light);
    light.to_light = length > 0 ? light.to_light / length : direction(region.begin.x, region.begin.y);
    return light;
  }

 private:
  glm::dvec3 radiance(int x, int y) const { return {picture_.at(x, y, 0), picture_.at(x, y, 1), picture_.at(x, y, 2)}; }
  double solid_angle(int y) const {
    return 2 * k_pi / picture_.width *
           (std::cos(k_pi * y / picture_.height) - std::cos(k_pi * (y + 1) / picture_.height));
  }
  double luminance(int x, int y) const { return solid_angle(y) * glm::dot(radiance(x, y), k_luminance); }

  const Image& picture_;
  double turn_;
};

/// Halves of like luminance, neither empty.
std::pair<Region, Region> halves(const Sphere& sphere, const Region& region) {
  const int axis = sphere.is_wide(region) ? 0 : 1;
  int cut = region.begin[axis] + 1;
  for (double sum = sphere.line(region, axis, cut - 1); cut < region.end[axis] - 1; ++cut) {
    const double next = sphere.line(region, axis, cut);
    if (2 * sum + next >= region.luminance) break;
    sum += next;
  }
  glm::ivec2 first_end = region.end, second_begin = region.begin;
  first_end[axis] = second_begin[axis] = cut;
  return {sphere.region(region.begin, first_end), sphere.region(second_begin, region.end)};
}

bool can_be_cut(const Region& region) {
  const glm::ivec2 size = region.end - region.begin;
  return region.luminance > 0 && size.x * size.y > 1;
}

Result<void> check(const Image& picture) {
  if (picture.channels() < 3 || picture.height < 1 || picture.width != 2 * picture.height)
    return bad_input(
        fmt::format("an environment of {} x {} texels and {} channels: it must be twice as wide as high, of "
                    "three channels at least",
                    picture.width, picture.height, picture.channels()));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c)
        if (const float value = picture.at(x, y, c); !(value >= 0) || !std::isfinite(value))
          return bad_input(
              fmt::format("texel ({}, {}) of the environment holds {}: allowed is 0 or more", x, y, value));
  return {};
}

}  // namespace

Image built_in_sky() {
  constexpr int k_height = 32;
  const glm::dvec3 zenith(0.16, 0.27, 0.52), horizon(0.62, 0.66, 0.70), ground(0.10, 0.09, 0.08), sun(1.0, 0.93, 0.80);
  const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.75, 0.6, 0.55));
  Image sky = make_image(2 * k_height, k_height, {"R", "G", "B"});
  const Sphere sphere(sky, 0);
  for (int y = 0; y < sky.height; ++y)
    for (int x = 0; x < sky.width; ++x) {
      const glm::dvec3 toward = sphere.direction(x, y);
      const double up = toward.y, haze = std::pow(1 - std::max(up, 0.0), 3), toward_sun = glm::dot(toward, to_sun);
      const glm::dvec3 glow = sun * (9 * std::exp((toward_sun - 1) / 0.03));
      const glm::dvec3 radiance = up > 0 ? zenith + haze * (horizon - zenith) + glow : ground;
      for (int c = 0; c < 3; ++c) sky.at(x, y, c) = float(radiance[c]);
    }
  return sky;
}

Result<Image> surroundings_of(const std::string& file) {
  constexpr float k_least = -1e-3f;  // lossy compression leaves such next to black
  if (file.empty()) return built_in_sky();
  CUTICLE_ASSIGN(Image picture, read_image(file));
  for (float& value : picture.pixels)
    if (value < 0 && value >= k_least) value = 0;
  return picture;
}

Result<std::vector<Light>> environment_lights(const Image& picture, const Environment& environment) {
  CUTICLE_TRY(check(picture));
  const Sphere sphere(picture, environment.turn_degrees * k_pi / 180);
  std::vector<Region> regions{sphere.region({0, 0}, {picture.width, picture.height})};
  while (regions.size() < std::size_t(environment.lights)) {
    const auto brightest = std::ranges::max_element(
        regions, {}, [](const Region& region) { return can_be_cut(region) ? region.luminance : -1.0; });
    if (!can_be_cut(*brightest)) break;
    const auto [first, second] = halves(sphere, *brightest);
    *brightest = first;
    regions.push_back(second);
  }
  std::vector<Light> lights;
  for (const Region& region : regions) {
    if (region.luminance <= 0) continue;
    lights.push_back(sphere.light(region));
    lights.back().irradiance *= environment.scale;
    if (regions.size() > 1) lights.back().name = fmt::format("environment {}", lights.size());
  }
  return lights;
}

}  // namespace cuticle::scene
