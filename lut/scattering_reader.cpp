#include "lut/scattering_reader.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lut/comparison.h"

namespace cuticle::lut {
namespace {

FactorPlace find_place(const TableSet& set, std::string_view factor, int colour) {
  for (const Table& table : set.tables)
    for (int c = 0; c < int(table.layout->channels.size()); ++c) {
      const std::string_view name = table.layout->channels[c].name;
      if (name == factor || name == fmt::format("{}.{}", factor, k_colours[colour])) return {&table, c};
    }
  CUTICLE_EXPECT(false, "a layout's terms name its channels");
  return {};
}
FactorPlace find_source(const TableSet& set, ChannelSource source) {
  for (const Table& table : set.tables)
    for (int c = 0; c < int(table.layout->channels.size()); ++c)
      if (table.layout->channels[c].source == source) return {&table, c};
  return {};
}

}  // namespace

std::vector<FactorPlace> places_of(const TableSet& set, int colour) {
  std::vector<FactorPlace> places;
  for (const Term& term : set.layout->terms) {
    for (std::string_view factor : term.factors)
      if (!factor.empty()) places.push_back(find_place(set, factor, colour));
    places.emplace_back();
  }
  return places;
}

bool has_source(const TableSet& set, ChannelSource source) { return find_source(set, source).table != nullptr; }

ScatteringReader::ScatteringReader(const TableSet& set)
    : set_(set), cosine_(find_source(set, ChannelSource::cos_theta_d)) {
  for (int colour = 0; colour < 3; ++colour) places_[std::size_t(colour)] = places_of(set, colour);
}

double ScatteringReader::scattering(bsdf::Point at, int colour) const {
  at = as_stored(at);
  const double sum = composed(places_[std::size_t(colour)], [&](const FactorPlace& place) {
    const glm::dvec2 coordinate = coordinates(*place.table, at);
    return sample(*place.table, place.channel, coordinate.x, coordinate.y) *
           left_out_factor(*place.table->layout, at, place.table->caustic_index);
  });
  return sum / divisor(at);
}

double ScatteringReader::divisor(const bsdf::Point& at) const {
  const double cosine = std::cos(at.theta_d);
  return set_.layout->over_cos2_theta_d ? std::max(cosine * cosine, 1e-6) : 1;
}

bool ScatteringReader::filters_singular(const bsdf::Point& at) const {
  return std::any_of(set_.tables.begin(), set_.tables.end(), [&](const Table& table) {
    const glm::dvec2 place = coordinates(table, at);
    return touches_singular(table, place.x, place.x, place.y);
  });
}

bsdf::Point ScatteringReader::as_stored(bsdf::Point at) const {
  if (!cosine_.table) return at;
  const glm::dvec2 place = coordinates(*cosine_.table, at);
  at.theta_d = std::acos(std::clamp(sample(*cosine_.table, cosine_.channel, place.x, place.y), 0.0, 1.0));
  return at;
}

glm::dvec2 ScatteringReader::coordinates(const Table& table, const bsdf::Point& at) const {
  return {axis_coordinate(table.layout->u, set_.size, at, table.caustic_index),
          axis_coordinate(table.layout->v, set_.size, at)};
}

}  // namespace cuticle::lut
