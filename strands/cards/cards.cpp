#include "strands/cards/cards.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "strands/cards/card_builder.h"
#include "strands/cards/k_means.h"

namespace cuticle::strands {

namespace {

/// Points of a strand that say which strands are near it.
constexpr std::size_t k_feature_points = 8;

bool is_finite_vector(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Result<void> check_strand(const Groom& groom, std::size_t s) {
  if (groom.strand_size(s) < 2)
    return bad_input(fmt::format("cards: strand {} has {} vertices, at least 2 are needed", s, groom.strand_size(s)),
                     "mend the groom: cuticle convert --repair");
  for (std::uint32_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v)
    if (!is_finite_vector(groom.positions[v]) || !std::isfinite(groom.radii[v]) || groom.radii[v] < 0)
      return bad_input(fmt::format("cards: strand {}: vertex {} at ({}, {}, {}) with radius {}: finite numbers are "
                                   "needed, and a radius of 0 or more",
                                   s, v - groom.offsets[s], groom.positions[v].x, groom.positions[v].y,
                                   groom.positions[v].z, groom.radii[v]),
                       "mend the groom: cuticle convert --repair");
  if (!(strand_length(groom, s) > 0))
    return bad_input(fmt::format("cards: strand {} has length {}, above 0 is needed", s, strand_length(groom, s)),
                     "mend the groom: cuticle convert --repair");
  return {};
}

Result<void> check(const Groom& groom, const CardParameters& parameters) {
  if (groom.strand_count() == 0) return bad_input("cards: the groom has 0 strands, at least 1 is needed");
  for (const auto& [name, count] : {std::pair("cards", parameters.cards), std::pair("layers", parameters.layers),
                                    std::pair("segments", parameters.segments)})
    if (count < 1) return bad_input(fmt::format("cards: {} = {}, at least 1 is needed", name, count));
  for (std::size_t s = 0; s < groom.strand_count(); ++s) CUTICLE_TRY(check_strand(groom, s));
  return {};
}

std::vector<float> features_of(std::span<const ArcStrand> strands) {
  std::vector<float> features;
  for (const ArcStrand& strand : strands)
    for (std::size_t k = 0; k < k_feature_points; ++k) {
      const glm::vec3 point = strand.at(strand.length() * float(k) / float(k_feature_points - 1));
      features.insert(features.end(), {point.x, point.y, point.z});
    }
  return features;
}

/// What the strands of one card add to the cover's error, each sum weighted by length.
struct CoverSums {
  double outside = 0, distance = 0, length = 0, strand_area = 0, card_area = 0;

  void add_strand(const Groom& groom, std::size_t s, std::span<const CardPoint> points) {
    const std::uint32_t first = groom.offsets[s];
    for (std::size_t k = 1; k < points.size(); ++k) {
      const double piece = double(glm::distance(groom.positions[first + k - 1], groom.positions[first + k]));
      const float u = 0.5f * (points[k - 1].u + points[k].u), v = 0.5f * (points[k - 1].v + points[k].v);
      if (u < 0 || u > 1 || v > 1) outside += piece;
      distance += piece * 0.5 * double(std::abs(points[k - 1].height) + std::abs(points[k].height));
      strand_area += piece * double(groom.radii[first + k - 1] + groom.radii[first + k]);
      length += piece;
    }
  }
  void add_card(const BuiltCard& card) {
    for (std::size_t r = 1; r < card.rows.size(); ++r)
      card_area += double(glm::distance(card.rows[r - 1].middle, card.rows[r].middle)) *
                   double(card.rows[r - 1].half_width + card.rows[r].half_width);
  }
  CoverError error() const {
    return {outside / length, distance / length, strand_area > 0 ? card_area / strand_area : 0};
  }
};

class Maker {
 public:
  Maker(const Groom& groom, const CardBody& body, const CardParameters& p)
      : groom_(groom), body_(body), layers_(p.layers), shape_{int(p.segments), p.width, p.within, p.outward} {
    for (std::size_t s = 0; s < groom.strand_count(); ++s) strands_.emplace_back(groom.strand(s));
    radius_ = float(std::reduce(groom.radii.begin(), groom.radii.end(), 0.0) / double(groom.radii.size()));
  }

  CardSet make(std::size_t clusters, int iterations, std::uint64_t seed) {
    const Clusters near = k_means(features_of(strands_), 3 * k_feature_points, clusters, iterations, seed);
    std::vector<std::vector<std::uint32_t>> members(near.count);
    for (std::size_t s = 0; s < near.of.size(); ++s) members[near.of[s]].push_back(std::uint32_t(s));
    for (std::size_t c = 0; c < members.size(); ++c) add_cluster(std::uint32_t(c), std::move(members[c]));
    set_.error = sums_.error();
    return std::move(set_);
  }

 private:
  /// Strands in order of their mean height above the card that all of them would make.
  void sort_by_height(std::vector<std::uint32_t>& members) const {
    const BuiltCard all = build_card(strands_, members, radius_, body_, shape_);
    std::vector<std::pair<float, std::uint32_t>> heights;
    for (std::uint32_t s : members) {
      float height = 0;
      for (const CardRow& row : all.rows)
        height += glm::dot(strands_[s].at(row.v * all.length) - row.middle, row.normal());
      heights.emplace_back(height, s);
    }
    std::ranges::sort(heights);
    std::ranges::transform(heights, members.begin(), [](const auto& pair) { return pair.second; });
  }

  void add_cluster(std::uint32_t cluster, std::vector<std::uint32_t> members) {
    const std::size_t layers = std::min(std::size_t(layers_), members.size());
    if (layers > 1) sort_by_height(members);
    for (std::size_t layer = 0; layer < layers; ++layer) {
      const std::size_t begin = layer * members.size() / layers, end = (layer + 1) * members.size() / layers;
      add_card(cluster, std::uint32_t(layer),
               {members.begin() + std::ptrdiff_t(begin), members.begin() + std::ptrdiff_t(end)});
    }
  }

  void add_card(std::uint32_t cluster, std::uint32_t layer, std::vector<std::uint32_t> members) {
    std::ranges::sort(members);
    BuiltCard built = build_card(strands_, members, radius_, body_, shape_);
    const Card card{.first_row = std::uint32_t(set_.rows.size()),
                    .row_count = std::uint32_t(built.rows.size()),
                    .cluster = cluster,
                    .layer = layer,
                    .length = built.length,
                    .members = std::move(members)};
    set_.rows.insert(set_.rows.end(), built.rows.begin(), built.rows.end());
    for (std::uint32_t s : card.members) sums_.add_strand(groom_, s, on_card(set_, card, groom_.strand(s)));
    sums_.add_card(built);
    set_.cards.push_back(card);
  }

  const Groom& groom_;
  const CardBody& body_;
  std::int64_t layers_;
  CardShape shape_;
  std::vector<ArcStrand> strands_;
  float radius_ = 0;
  CardSet set_;
  CoverSums sums_;
};

}  // namespace

glm::vec3 CardRow::normal() const { return glm::cross(tangent, across); }

CardBody body_of_roots(const Groom& groom) {
  glm::dvec3 sum(0);
  for (std::size_t s = 0; s < groom.strand_count(); ++s) sum += groom.positions[groom.offsets[s]];
  return {glm::vec3(sum / double(std::max<std::size_t>(1, groom.strand_count())))};
}

Result<CardSet> make_cards(const Groom& groom, const CardBody& body, const CardParameters& p) {
  CUTICLE_TRY(check(groom, p));
  const auto clusters = std::size_t(std::max<std::int64_t>(1, p.cards / p.layers));
  return Maker(groom, body, p).make(clusters, p.iterations, p.seed);
}

std::vector<CardPoint> on_card(const CardSet& set, const Card& card, std::span<const glm::vec3> strand) {
  const std::span<const CardRow> rows(set.rows.data() + card.first_row, card.row_count);
  const ArcStrand arc(strand);
  std::vector<CardPoint> points;
  for (std::size_t k = 0; k < strand.size(); ++k) {
    const float v = arc.along(k) / card.length;
    const CardRow row = row_at(rows, v);
    const glm::vec3 offset = strand[k] - row.middle;
    points.push_back({0.5f + glm::dot(offset, row.across) / (2 * row.half_width), v, glm::dot(offset, row.normal()),
                      row.half_width});
  }
  return points;
}

}  // namespace cuticle::strands
