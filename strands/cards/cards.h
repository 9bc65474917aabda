#pragma once
// Hair cards: strips of quads in the place of strands (Scheuermann, GDC 2004).
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "core/registry/members.h"
#include "core/result.h"
#include "strands/groom.h"

namespace cuticle::strands {

/// A cross-line of a card: from middle - half_width * across (u = 0) to middle + half_width * across (u = 1).
struct CardRow {
  glm::vec3 middle{0}, across{1, 0, 0}, tangent{0, 1, 0};  ///< metres; unit and at right angles to each other
  float half_width = 0;                                    ///< metres
  float v = 0;                                             ///< 0 at the root, 1 at the tip
  glm::vec3 normal() const;                                ///< tangent x across: away from the head
};
/// A strip: rows root to tip. The strands that it stands for are `members`.
struct Card {
  std::uint32_t first_row = 0, row_count = 0;
  std::uint32_t cluster = 0, layer = 0;  ///< layers of a cluster count from the head outward
  std::uint32_t kind = 0;                ///< of card_textures.h
  float length = 0;                      ///< metres
  std::vector<std::uint32_t> members;    ///< strands of the groom, rising
};

/// What is lost where cards stand for strands.
struct CoverError {
  double outside = 0;   ///< share of the strands' length that lies beside or beyond its card
  double distance = 0;  ///< metres: mean distance of strands from the surface of their card
  double area = 0;      ///< area of the cards over that of the strands (length times width)
};
struct CardSet {
  std::vector<CardRow> rows;
  std::vector<Card> cards;
  CoverError error;
};

/// Units and ranges are those of its description.
struct CardParameters {
  std::int64_t cards = 600, layers = 2, segments = 12;
  double width = 0, within = 0.95, outward = 0.5;
  int iterations = 8;
  std::uint64_t seed = 1;
  std::size_t kinds = 12;
  int texture_width = 64, texture_height = 256;
  double fill = 0.6, base_variation = 0.5, shift_variation = 0.3;
  int occlusion_rays = 32;
  double swings_from = 0;
};
void describe(registry::Members& members, CardParameters& cards);

/// What the hair grows on, as far as cards need it: `center` of the head, metres.
struct CardBody {
  glm::vec3 center{0};
};
/// The mean of the roots; 0 without strands.
CardBody body_of_roots(const Groom& groom);

/// A1: strands resampled by arc length, put into clusters of near ones, each in layers from the head outward, each of
/// these a card along the mean of its strands, as wide as they lie, its face where they are flattest and away from the
/// head (`outward`). The same groom and seed give the same cards; there may be fewer than asked for where strands are
/// few. Error: bad_input without strands, for a strand of fewer than two vertices or no length, and where a position or
/// radius is not finite, naming the strand.
Result<CardSet> make_cards(const Groom& groom, const CardBody& body, const CardParameters& parameters);

/// A point of a strand as its card has it: u and v as a row has them (outside 0 .. 1: beside or beyond the card), and
/// the height above the card's surface, metres.
struct CardPoint {
  float u = 0, v = 0, height = 0, half_width = 0;
};
/// The vertices of a strand, with their arc length taken for the way along the card.
std::vector<CardPoint> on_card(const CardSet& set, const Card& card, std::span<const glm::vec3> strand);

}  // namespace cuticle::strands
