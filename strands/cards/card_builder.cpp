#include "strands/cards/card_builder.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "strands/mesh.h"
#include "strands/spline/frame.glslh"

namespace cuticle::strands {

namespace {

/// A card is as long as this share of its strands at most; longer ones reach beyond it.
constexpr double k_length_quantile = 0.9;
/// Across a card of one strand, so many fibre radii to each side.
constexpr float k_least_half_width = 2;

float quantile(std::vector<float> values, double share) {
  const auto place = values.begin() + std::ptrdiff_t(std::llround(share * double(values.size() - 1)));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

float length_of(std::span<const ArcStrand> all, std::span<const std::uint32_t> members) {
  std::vector<float> lengths;
  for (std::uint32_t strand : members) lengths.push_back(all[strand].length());
  return quantile(std::move(lengths), k_length_quantile);
}

/// Where a strand passes a row, seen from the row's middle: along two directions across the tangent.
using Offsets = std::vector<glm::vec2>;

struct Plane {
  glm::vec3 across, normal;
};

/// Across the tangent, with the normal away from the center.
Plane outward_plane(const CardRow& row, const glm::vec3& center) {
  const glm::vec3 normal = across_or_any<float>(row.middle - center, row.tangent);
  return {glm::cross(normal, row.tangent), normal};
}

/// The direction in the plane in which offsets spread most, with a pull toward its first axis and toward `before`.
float flattest_angle(const Offsets& offsets, double outward, const glm::vec2* before) {
  constexpr double k_steady = 0.5;  // weight of the row before, so that a card does not twist from row to row
  double xx = 0, xy = 0, yy = 0;
  for (const glm::vec2& o : offsets) {
    xx += double(o.x) * double(o.x);
    xy += double(o.x) * double(o.y);
    yy += double(o.y) * double(o.y);
  }
  const double trace = std::max(xx + yy, 1e-30);
  double difference = (xx - yy) / trace + outward, twice = 2 * xy / trace;
  if (before) {
    difference += k_steady * double(before->x * before->x - before->y * before->y);
    twice += k_steady * 2 * double(before->x * before->y);
  }
  return float(0.5 * std::atan2(twice, difference));
}

class Builder {
 public:
  Builder(std::span<const ArcStrand> all, std::span<const std::uint32_t> members, float fibre_radius,
          const CardBody& body, const CardShape& shape)
      : all_(all), members_(members), fibre_radius_(fibre_radius), body_(body), shape_(shape) {
    card_.length = length_of(all, members);
  }

  BuiltCard build() {
    place_middles();
    set_tangents();
    for (std::size_t r = 0; r < card_.rows.size(); ++r) turn(r);
    if (shape_.width == 0) smooth_widths();
    return std::move(card_);
  }

 private:
  glm::vec3 passes(std::uint32_t strand, const CardRow& row) const { return all_[strand].at(row.v * card_.length); }

  void place_middles() {
    for (int r = 0; r <= shape_.segments; ++r) {
      CardRow row;
      row.v = float(r) / float(shape_.segments);
      glm::dvec3 sum(0);
      for (std::uint32_t strand : members_) sum += passes(strand, row);
      row.middle = glm::vec3(sum / double(members_.size()));
      card_.rows.push_back(row);
    }
  }

  void set_tangents() {
    const std::size_t last = card_.rows.size() - 1;
    for (std::size_t r = 0; r <= last; ++r)
      card_.rows[r].tangent =
          unit_or_up(card_.rows[std::min(r + 1, last)].middle - card_.rows[r > 0 ? r - 1 : 0].middle);
  }

  void turn(std::size_t r) {
    CardRow& row = card_.rows[r];
    const Plane plane = outward_plane(row, body_.center);
    Offsets offsets;
    for (std::uint32_t strand : members_) {
      const glm::vec3 offset = passes(strand, row) - row.middle;
      offsets.emplace_back(glm::dot(offset, plane.across), glm::dot(offset, plane.normal));
    }
    glm::vec2 before(1, 0);
    if (r > 0) {
      const glm::vec3& across = card_.rows[r - 1].across;
      before = {glm::dot(across, plane.across), glm::dot(across, plane.normal)};
    }
    const float angle = flattest_angle(offsets, shape_.outward, r > 0 ? &before : nullptr);
    glm::vec2 axis(std::cos(angle), std::sin(angle));
    if (glm::dot(axis, before) < 0) axis = -axis;
    row.across = axis.x * plane.across + axis.y * plane.normal;
    set_extent(row, offsets, axis);
  }

  /// As wide as the share `within` of the strands lies, with as many beyond one side as beyond the other.
  void set_extent(CardRow& row, const Offsets& offsets, const glm::vec2& axis) const {
    row.half_width = float(0.5 * shape_.width);
    if (shape_.width > 0) return;
    std::vector<float> places;
    for (const glm::vec2& offset : offsets) places.push_back(glm::dot(offset, axis));
    const float from = quantile(places, 0.5 - 0.5 * shape_.within), to = quantile(places, 0.5 + 0.5 * shape_.within);
    row.middle += 0.5f * (from + to) * row.across;
    row.half_width = 0.5f * (to - from) + k_least_half_width * fibre_radius_;
  }

  void smooth_widths() {
    const std::vector<CardRow> rows = card_.rows;
    for (std::size_t r = 1; r + 1 < rows.size(); ++r)
      card_.rows[r].half_width =
          0.25f * rows[r - 1].half_width + 0.5f * rows[r].half_width + 0.25f * rows[r + 1].half_width;
  }

  std::span<const ArcStrand> all_;
  std::span<const std::uint32_t> members_;
  float fibre_radius_;
  const CardBody& body_;
  const CardShape& shape_;
  BuiltCard card_;
};

}  // namespace

BuiltCard build_card(std::span<const ArcStrand> all, std::span<const std::uint32_t> members, float fibre_radius,
                     const CardBody& body, const CardShape& shape) {
  return Builder(all, members, fibre_radius, body, shape).build();
}

CardRow row_at(std::span<const CardRow> rows, float v) {
  const float place = std::clamp(v, 0.0f, 1.0f) * float(rows.size() - 1);
  const std::size_t k = std::min(std::size_t(place), rows.size() - 2);
  const CardRow &a = rows[k], &b = rows[k + 1];
  const float share = place - float(k);
  CardRow row{.middle = glm::mix(a.middle, b.middle, share)};
  row.tangent = unit_or_up(glm::mix(a.tangent, b.tangent, share));
  row.across = across_or_any<float>(glm::mix(a.across, b.across, share), row.tangent);
  row.half_width = glm::mix(a.half_width, b.half_width, share);
  row.v = v;
  return row;
}

}  // namespace cuticle::strands
