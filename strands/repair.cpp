#include "strands/repair.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/finite.h"

namespace cuticle::strands {

namespace {

bool is_finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A vertex of the mended groom, between two of the damaged one: (1 - t) a + t b.
struct Place {
  std::uint32_t a, b;
  float t;
};

std::size_t replace_not_finite(std::span<float> values) {
  if (all_finite(values)) return 0;
  const auto is_bad = [](float value) { return !std::isfinite(value); };
  const auto count = std::count_if(values.begin(), values.end(), is_bad);
  std::replace_if(values.begin(), values.end(), is_bad, 0.0f);
  return std::size_t(count);
}

std::size_t replace_values(Groom& groom) {
  std::size_t count = replace_not_finite(groom.radii);
  for (float& radius : groom.radii)
    if (radius < 0) {
      radius = 0;
      ++count;
    }
  for (std::vector<glm::vec2>* pairs : {&groom.root_uv, &groom.root_barycentrics})
    count += replace_not_finite({reinterpret_cast<float*>(pairs->data()), 2 * pairs->size()});
  for (auto& [name, attribute] : groom.attributes) count += replace_not_finite(attribute.values);
  return count;
}

/// The vertices of a strand that stay.
std::vector<std::uint32_t> kept_vertices(const Groom& groom, std::size_t strand, Repairs& repairs) {
  std::vector<std::uint32_t> kept;
  std::size_t finite = 0;
  for (std::uint32_t v = groom.offsets[strand]; v < groom.offsets[strand + 1]; ++v) {
    if (!is_finite(groom.positions[v])) {
      ++repairs.points_not_finite;
      continue;
    }
    ++finite;
    if (kept.empty() || groom.positions[kept.back()] != groom.positions[v])
      kept.push_back(v);
    else
      ++repairs.coincident_points;
  }
  if (kept.size() < 2) ++(finite < 2 ? repairs.strands_of_one_point : repairs.strands_without_length);
  return kept;
}

/// Into how many pieces each segment is divided so that there are `size` vertices.
std::vector<std::uint32_t> pieces_of(const Groom& groom, const std::vector<std::uint32_t>& kept, std::size_t size) {
  std::vector<std::uint32_t> pieces(kept.size() - 1, 1);
  std::vector<double> lengths;
  for (std::size_t i = 0; i + 1 < kept.size(); ++i)
    lengths.push_back(glm::distance(glm::dvec3(groom.positions[kept[i]]), glm::dvec3(groom.positions[kept[i + 1]])));
  std::vector<double> piece = lengths;
  for (std::size_t count = kept.size(); count < size; ++count) {
    const std::size_t longest = std::size_t(std::max_element(piece.begin(), piece.end()) - piece.begin());
    piece[longest] = lengths[longest] / ++pieces[longest];
  }
  return pieces;
}

void append_places(const Groom& groom, const std::vector<std::uint32_t>& kept, std::size_t size,
                   std::vector<Place>& places) {
  const std::vector<std::uint32_t> pieces = pieces_of(groom, kept, size);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::uint32_t p = 0; p < pieces[i]; ++p) places.push_back({kept[i], kept[i + 1], float(p) / float(pieces[i])});
  places.push_back({kept.back(), kept.back(), 0});
}

/// Values of the mended groom's vertices, `components` each.
std::vector<float> values_at(const std::vector<Place>& places, std::span<const float> values, std::size_t components) {
  std::vector<float> result;
  result.reserve(places.size() * components);
  for (const Place& place : places)
    for (std::size_t c = 0; c < components; ++c) {
      const float a = values[place.a * components + c], b = values[place.b * components + c];
      result.push_back(place.t == 0 ? a : float(glm::mix(double(a), double(b), double(place.t))));
    }
  return result;
}

std::vector<glm::vec3> positions_at(const std::vector<Place>& places, const std::vector<glm::vec3>& positions) {
  std::vector<glm::vec3> result;
  result.reserve(places.size());
  for (const Place& place : places)
    result.push_back(place.t == 0 ? positions[place.a]
                                  : glm::vec3(glm::mix(glm::dvec3(positions[place.a]), glm::dvec3(positions[place.b]),
                                                       double(place.t))));
  return result;
}

/// Items of the strands that stay, `components` each.
template <class T>
std::vector<T> of_strands(const std::vector<std::size_t>& strands, const std::vector<T>& items,
                          std::size_t components = 1) {
  std::vector<T> result;
  for (std::size_t i = 0; !items.empty() && i < strands.size(); ++i)
    for (std::size_t c = 0; c < components; ++c) result.push_back(items[strands[i] * components + c]);
  return result;
}

Groom mended(const Groom& groom, const std::vector<std::size_t>& strands, std::vector<std::uint32_t> offsets,
             const std::vector<Place>& places) {
  Groom result;
  result.offsets = std::move(offsets);
  result.positions = positions_at(places, groom.positions);
  result.radii = values_at(places, groom.radii, 1);
  result.root_uv = of_strands(strands, groom.root_uv);
  result.root_triangle = of_strands(strands, groom.root_triangle);
  result.root_barycentrics = of_strands(strands, groom.root_barycentrics);
  for (const auto& [name, attribute] : groom.attributes) {
    const std::size_t components = std::size_t(attribute.components);
    result.attributes[name] = {attribute.domain, attribute.components,
                               attribute.domain == Attribute::Domain::vertex
                                   ? values_at(places, attribute.values, components)
                                   : of_strands(strands, attribute.values, components)};
  }
  return result;
}

}  // namespace

Repairs repair(Groom& groom) {
  Repairs repairs;
  repairs.values_replaced = replace_values(groom);
  std::vector<std::size_t> strands;
  std::vector<std::uint32_t> offsets{0};
  std::vector<Place> places;
  places.reserve(groom.vertex_count());
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::vector<std::uint32_t> kept = kept_vertices(groom, s, repairs);
    if (kept.size() < 2) continue;
    repairs.points_added += groom.strand_size(s) - kept.size();
    strands.push_back(s);
    append_places(groom, kept, groom.strand_size(s), places);
    offsets.push_back(std::uint32_t(places.size()));
  }
  if (repairs.points_not_finite + repairs.coincident_points > 0 || strands.size() < groom.strand_count())
    groom = mended(groom, strands, std::move(offsets), places);
  return repairs;
}

std::vector<std::string> sentences(const Repairs& repairs) {
  const std::pair<std::size_t, const char*> kinds[] = {
      {repairs.points_not_finite, "points that are not finite taken out"},
      {repairs.coincident_points, "points that coincide with the one before them taken out"},
      {repairs.strands_of_one_point, "strands of fewer than two finite points taken out"},
      {repairs.strands_without_length, "strands without length taken out"},
      {repairs.points_added, "points put into longest segments, so that strands keep their number of points"},
      {repairs.values_replaced, "radii, uv or attribute values set to 0"}};
  std::vector<std::string> result;
  for (const auto& [count, what] : kinds)
    if (count > 0) result.push_back(fmt::format("repaired: {} {}", count, what));
  return result;
}

}  // namespace cuticle::strands
