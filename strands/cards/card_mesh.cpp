#include "strands/cards/card_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

#include "strands/cards/disjoint_sets.h"

namespace cuticle::strands {

namespace {

/// Swinging parts whose first rows are nearer than this, metres, swing together.
constexpr float k_link = 0.03f;

class MeshMaker {
 public:
  MeshMaker(const CardSet& set, const CardTextures& textures, const CardBody& body, double swings_from)
      : set_(set), textures_(textures), body_(body), swings_from_(float(swings_from)) {}

  CardMesh make() {
    for (std::size_t c = 0; c < set_.cards.size(); ++c) add_card(std::uint32_t(c));
    number_groups();
    for (const CardPart& part : made_.parts) add_triangles(part);
    sort_parts();
    return std::move(made_);
  }

 private:
  bool swings(const CardRow& row) const {
    return swings_from_ > 0 && glm::distance(row.middle, body_.center) > swings_from_;
  }

  /// The last row before the card swings; 0: it does from its root on; its last row: nowhere.
  std::uint32_t cut_of(const Card& card) const {
    for (std::uint32_t r = 0; r < card.row_count; ++r)
      if (swings(set_.rows[card.first_row + r])) return r > 0 ? r - 1 : 0;
    return card.row_count - 1;
  }

  void add_card(std::uint32_t c) {
    const Card& card = set_.cards[c];
    const std::uint32_t cut = cut_of(card), last = card.row_count - 1;
    if (cut > 0) add_part(c, 0, cut, 0);
    if (cut < last) add_part(c, cut, last, 1);
  }

  void add_part(std::uint32_t c, std::uint32_t first, std::uint32_t last, std::uint32_t group) {
    const Card& card = set_.cards[c];
    made_.parts.push_back(
        {.card = c, .first_row = std::uint32_t(made_.rows.size()), .row_count = last - first + 1, .group = group});
    for (std::uint32_t r = first; r <= last; ++r) add_row(card, set_.rows[card.first_row + r]);
  }

  void add_row(const Card& card, const CardRow& row) {
    made_.rows.push_back(row);
    for (float side : {0.0f, 1.0f}) {
      made_.mesh.positions.push_back(row.middle + (2 * side - 1) * row.half_width * row.across);
      made_.mesh.normals.push_back(row.normal());
      made_.mesh.uv.push_back(textures_.atlas_uv(card.kind, side, row.v));
    }
  }

  /// Counter-clockwise about tangent x across: from across toward the tangent is clockwise about it.
  void add_triangles(const CardPart& part) {
    for (std::uint32_t r = part.first_row; r + 1 < part.first_row + part.row_count; ++r) {
      const std::uint32_t a = 2 * r, b = a + 1, c = a + 2, d = a + 3;
      made_.mesh.triangles.push_back({a, c, b});
      made_.mesh.triangles.push_back({b, c, d});
    }
  }

  void number_groups() {
    std::vector<std::uint32_t> swinging;
    for (std::size_t p = 0; p < made_.parts.size(); ++p)
      if (made_.parts[p].group > 0) swinging.push_back(std::uint32_t(p));
    DisjointSets sets(made_.parts.size());
    for (std::size_t i = 0; i < swinging.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (are_near(made_.parts[swinging[i]], made_.parts[swinging[j]])) sets.join(swinging[j], swinging[i]);
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (std::uint32_t p : swinging) {
      const auto number = std::min(std::uint32_t(numbers.size()) + 1, k_max_groups - 1);
      made_.parts[p].group = numbers.try_emplace(sets.find(p), number).first->second;
    }
  }

  bool are_near(const CardPart& a, const CardPart& b) const {
    return glm::distance(made_.rows[a.first_row].middle, made_.rows[b.first_row].middle) < k_link;
  }

  void sort_parts() {
    std::vector<std::uint32_t> part_of_row(made_.rows.size());
    for (std::size_t p = 0; p < made_.parts.size(); ++p)
      std::fill_n(part_of_row.begin() + made_.parts[p].first_row, made_.parts[p].row_count, std::uint32_t(p));
    std::vector<CardPart> sorted;
    for (const MeshComponent& component : sort_inside_to_outside(made_.mesh, body_.center)) {
      CardPart part = made_.parts[part_of_row[made_.mesh.triangles[component.first_triangle][0] / 2]];
      part.first_triangle = component.first_triangle;
      part.triangle_count = component.triangle_count;
      sorted.push_back(part);
    }
    made_.parts = std::move(sorted);
  }

  const CardSet& set_;
  const CardTextures& textures_;
  const CardBody& body_;
  float swings_from_;
  CardMesh made_;
};

}  // namespace

CardMesh make_card_mesh(const CardSet& set, const CardTextures& textures, const CardBody& body, double swings_from) {
  return MeshMaker(set, textures, body, swings_from).make();
}

}  // namespace cuticle::strands
