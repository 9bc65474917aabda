#include "study/growth/measured.h"

#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace cuticle::study {

strands::Groom ball_of_hair(int strands, int vertices) {
  constexpr double k_radius = 0.09, k_length = 0.25, k_fall = 6;
  strands::Groom groom;
  for (int s = 0; s < strands; ++s) {
    const double height = 1 - 2 * (s + 0.5) / strands, azimuth = s * std::numbers::pi * (3 - std::sqrt(5.0)),
                 around = std::sqrt(1 - height * height);
    const glm::dvec3 outward(around * std::cos(azimuth), height, around * std::sin(azimuth));
    glm::dvec3 place = k_radius * outward;
    for (int i = 0; i < vertices; ++i) {
      groom.positions.emplace_back(place);
      const double along = k_length * i / (vertices - 1);
      place += glm::normalize(outward - glm::dvec3(0, k_fall * along, 0)) * (k_length / (vertices - 1));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  return groom;
}

Group group_of_times(std::string name, std::string title) {
  return {.name = std::move(name), .title = std::move(title)};
}

void add_time(Group& group, std::string method, int strands, double seconds) {
  if (!(seconds > 0)) return;
  group.points.push_back({.method = std::move(method),
                          .knobs = {{"strands", std::to_string(strands)}},
                          .measure = [] { return Result<Measured>(Measured{}); },
                          .seconds = seconds});
}

void note_refusal(const GrowthRequest& request, std::string_view what, int strands, const Error& error) {
  request.notes->push_back(fmt::format("{}, {} strands: {}", what, strands, error.message));
}

}  // namespace cuticle::study
