#pragma once
// Which points of a card's texture its strands cover, and which strand lies on top.
#include <bit>
#include <cstdint>

#include "strands/cards/cards.h"

namespace cuticle::strands {

class StrandTexture {
 public:
  /// `width` of which two columns stay empty; strands of the card in order of their height.
  StrandTexture(const Groom& groom, const CardSet& set, const Card& card, int width, int height);
  /// Draws the strands, this much wider than they are.
  void draw(double strand_width);

  static constexpr std::int32_t k_no_strand = -1;
  float alpha(int x, int y) const { return float(std::popcount(covered_[index(x, y)])) / 64; }
  /// The highest strand that touches a texel: its number among the card's, or k_no_strand.
  std::int32_t top(int x, int y) const { return top_[index(x, y)]; }
  /// Over the columns that are not empty.
  double mean_alpha() const;
  double opaque_share() const;

 private:
  struct Strand {
    std::vector<CardPoint> points;
    std::vector<float> radii;
    float height = 0;
    std::int32_t number = 0;
  };
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(width_) + std::size_t(x); }
  void draw_strand(const Strand& strand, double strand_width);
  void draw_run(int sub_row, std::int32_t number, double from, double to);

  int width_, height_;
  float length_;
  std::vector<Strand> strands_;
  std::vector<std::uint64_t> covered_;  ///< 8 x 8 points of each texel
  std::vector<std::int32_t> top_;
};

}  // namespace cuticle::strands
