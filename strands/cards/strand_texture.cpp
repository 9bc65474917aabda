#include "strands/cards/strand_texture.h"

#include <algorithm>
#include <cmath>

namespace cuticle::strands {

namespace {

constexpr int k_points = 8;  ///< of a texel, each way

}  // namespace

StrandTexture::StrandTexture(const Groom& groom, const CardSet& set, const Card& card, int width, int height)
    : width_(width), height_(height), length_(card.length) {
  for (std::uint32_t s : card.members) {
    Strand strand{.points = on_card(set, card, groom.strand(s)), .radii = {}, .number = std::int32_t(strands_.size())};
    const auto first = groom.radii.begin() + groom.offsets[s];
    strand.radii.assign(first, first + std::ptrdiff_t(groom.strand_size(s)));
    for (const CardPoint& point : strand.points) strand.height += point.height / float(strand.points.size());
    strands_.push_back(std::move(strand));
  }
  std::ranges::stable_sort(strands_, {}, &Strand::height);
}

void StrandTexture::draw(double strand_width) {
  covered_.assign(std::size_t(width_) * std::size_t(height_), 0);
  top_.assign(covered_.size(), k_no_strand);
  for (const Strand& strand : strands_) draw_strand(strand, strand_width);
}

/// Each line of points is crossed once, for a strand's points rise in v.
void StrandTexture::draw_strand(const Strand& strand, double strand_width) {
  const int lines = k_points * height_;
  std::size_t k = 1;
  for (int line = 0; line < lines; ++line) {
    const float v = (float(line) + 0.5f) / float(lines);
    while (k < strand.points.size() && strand.points[k].v < v) ++k;
    if (k == strand.points.size()) return;
    const CardPoint &a = strand.points[k - 1], &b = strand.points[k];
    const float share = (v - a.v) / std::max(b.v - a.v, 1e-12f);
    const double width = 2 * double(std::lerp(a.half_width, b.half_width, share));
    const double slope = double(b.u - a.u) * width / std::max(double((b.v - a.v) * length_), 1e-12);
    const double half = double(std::lerp(strand.radii[k - 1], strand.radii[k], share)) * strand_width *
                        std::sqrt(1 + slope * slope) / width;
    const double middle = double(std::lerp(a.u, b.u, share));
    draw_run(line, strand.number, middle - half, middle + half);
  }
}

/// Points from u = `from` to `to` of a line.
void StrandTexture::draw_run(int line, std::int32_t number, double from, double to) {
  const double columns = k_points * (width_ - 2);
  const int first = int(std::ceil(std::clamp(from * columns - 0.5, 0.0, columns)));
  const int last = int(std::floor(std::clamp(to * columns - 0.5, -1.0, columns - 1)));
  for (int x = first / k_points; x <= last / k_points && first <= last; ++x) {
    const std::uint64_t from_left = 0xFFu << std::max(first - k_points * x, 0),
                        to_right = 0xFFu >> std::max(k_points * x + k_points - 1 - last, 0);
    const std::size_t texel = index(1 + x, line / k_points);
    covered_[texel] |= (from_left & to_right & 0xFF) << (k_points * (line % k_points));
    top_[texel] = number;
  }
}

double StrandTexture::mean_alpha() const {
  std::uint64_t points = 0;
  for (std::uint64_t texel : covered_) points += std::uint64_t(std::popcount(texel));
  return double(points) / (double(k_points * k_points) * (width_ - 2) * height_);
}

double StrandTexture::opaque_share() const {
  return double(std::ranges::count(covered_, ~std::uint64_t(0))) / (double(width_ - 2) * height_);
}

}  // namespace cuticle::strands
