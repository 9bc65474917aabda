// Strands whose vertices lie anywhere, coincide, fold back: directions have length 1, smooth curves are finite.
#include <cmath>

#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

constexpr std::size_t k_strand_vertices = 5;
/// Distances whose squares are floats: of 1e-17 m, where vertices lie beside each other, to 1e18 m. Closer ones that do
/// not coincide have directions whose length is not 1.
constexpr double k_least_strand_metres = 1e-6, k_strand_metres = 1e18;

/// Many coordinates are 0, so that vertices coincide.
double strand_coordinate(Coordinates& at, double scale) {
  const double share = at.around_zero(1);
  return std::abs(share) < 1e-3 ? 0 : share * scale;
}

Json points_of(Coordinates& at) {
  const double scale = at.by_factors(k_least_strand_metres, k_strand_metres);
  Json strand = Json::list();
  for (std::size_t v = 0; v < k_strand_vertices; ++v) {
    Json point = Json::list();
    for (std::size_t k = 0; k < k_point; ++k) point.push_back(strand_coordinate(at, scale));
    strand.push_back(std::move(point));
  }
  return Json::list({strand});
}

Json strand_case(bool smooth, const Place& place) {
  Coordinates at(place);
  Json inputs{{"operation", smooth ? "smooth" : "tangents"}, {"groom", Json{{"points", points_of(at)}}}};
  if (smooth) inputs["vertices"] = 2 + at.below(63);
  const Json expect = smooth ? Json{{"bounds", Json::list({-2 * k_strand_metres, 2 * k_strand_metres})}}
                             : Json{{"value", 1}, {"absolute", 1e-5}};
  return Json{{"subject", "strands"}, {"inputs", std::move(inputs)}, {"expect", expect}};
}

}  // namespace

std::vector<Space> strand_spaces() {
  std::vector<Space> all;
  for (bool smooth : {false, true})
    all.push_back({.name = smooth ? "strands_smooth" : "strands_tangents",
                   .size = 2 + k_strand_vertices * k_point,
                   .case_at = [smooth](const Place& place) { return strand_case(smooth, place); },
                   .climbs = 40});
  return all;
}

}  // namespace cuticle::hard_cases::search
