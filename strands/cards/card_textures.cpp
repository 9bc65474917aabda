#include "strands/cards/card_textures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "core/random.h"
#include "strands/cards/k_means.h"
#include "strands/cards/strand_texture.h"

namespace cuticle::strands {

namespace {

/// Of the texture whose means tell the kinds apart.
constexpr int k_coarse_columns = 4, k_coarse_rows = 4, k_coarse_texels = 4;

/// Mean alphas of a card's parts, row by row.
std::vector<float> coarse_alphas(const Groom& groom, const CardSet& set, const Card& card) {
  constexpr int width = k_coarse_columns * k_coarse_texels, height = k_coarse_rows * k_coarse_texels;
  StrandTexture texture(groom, set, card, width + 2, height);
  texture.draw(1);
  std::vector<float> means(k_coarse_columns * k_coarse_rows);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      means[std::size_t(y / k_coarse_texels * k_coarse_columns + x / k_coarse_texels)] +=
          texture.alpha(x + 1, y) / float(k_coarse_texels * k_coarse_texels);
  return means;
}

double mean_of(std::span<const float> values) {
  double sum = 0;
  for (float value : values) sum += double(value);
  return sum / double(values.size());
}

/// The member of a cluster that is nearest to its middle.
std::uint32_t representative(const Clusters& clusters, std::size_t kind, std::span<const float> features,
                             std::size_t size) {
  float least = std::numeric_limits<float>::max();
  std::uint32_t nearest = 0;
  for (std::size_t p = 0; p < clusters.of.size(); ++p) {
    if (clusters.of[p] != kind) continue;
    float sum = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const float apart = features[p * size + k] - clusters.centres[kind * size + k];
      sum += apart * apart;
    }
    if (sum < least) nearest = std::uint32_t(p);
    least = std::min(least, sum);
  }
  return nearest;
}

/// Draws with the least width at which the strands cover `fill`, as far as k_max_widening allows.
double draw_filled(StrandTexture& texture, double fill) {
  double low = 1, high = 1;
  texture.draw(high);
  while (texture.mean_alpha() < fill && high < k_max_widening) {
    low = high;
    high *= 2;
    texture.draw(high);
  }
  if (low == high || texture.mean_alpha() < fill) return high;
  for (int k = 0; k < 8; ++k) {
    const double middle = 0.5 * (low + high);
    texture.draw(middle);
    (texture.mean_alpha() < fill ? low : high) = middle;
  }
  texture.draw(high);
  return high;
}

/// Numbers that vary along a strand: random at so many places, straight between them.
class Noise {
 public:
  Noise(std::uint64_t seed, std::uint64_t stream, int places) {
    RandomStream random(seed, stream);
    for (int k = 0; k <= places; ++k) values_.push_back(float(random.next_unit()));
  }
  /// v: 0 .. 1.
  float at(float v) const {
    const float place = v * float(values_.size() - 1);
    const std::size_t k = std::min(std::size_t(place), values_.size() - 2);
    return std::lerp(values_[k], values_[k + 1], place - float(k));
  }

 private:
  std::vector<float> values_;
};

/// What a strand looks like along its length.
struct Look {
  Noise base, shift, mask;
  Look(std::uint64_t seed, std::uint64_t strand)
      : base(seed, 3 * strand, 4), shift(seed, 3 * strand + 1, 4), mask(seed, 3 * strand + 2, 48) {}
};

struct Variation {
  float base, shift;
};

class KindPainter {
 public:
  KindPainter(CardTextures& textures, int kind, Variation variation)
      : textures_(textures), left_(kind * textures.width), variation_(variation) {}

  void paint(const StrandTexture& texture, std::span<const Look> looks) {
    for (int y = 0; y < textures_.height; ++y) {
      paint_row(texture, looks, y);
      spread(y);
    }
  }

 private:
  float& at(int x, int y, int channel) { return textures_.atlas.at(left_ + x, y, channel); }
  /// What a texel without hair holds until a neighbour's look is spread over it.
  static constexpr float k_empty = -1;

  void paint_row(const StrandTexture& texture, std::span<const Look> looks, int y) {
    const float v = (float(y) + 0.5f) / float(textures_.height);
    for (int x = 0; x < textures_.width; ++x) {
      const std::int32_t strand = texture.top(x, y);
      at(x, y, 3) = texture.alpha(x, y);
      at(x, y, 0) = k_empty;
      if (strand == StrandTexture::k_no_strand) continue;
      const Look& look = looks[std::size_t(strand)];
      at(x, y, 0) = 1 - variation_.base * look.base.at(v);
      at(x, y, 1) = 0.5f + variation_.shift * (look.shift.at(v) - 0.5f);
      at(x, y, 2) = look.mask.at(v);
    }
  }

  void copy(int x, int y, int from_x, int from_y) {
    for (int c = 0; c < 3; ++c) at(x, y, c) = at(from_x, from_y, c);
  }

  /// Filtering mixes texels, so that those without hair look like their neighbours to the left, then to the right; in a
  /// row without hair like the row before.
  void spread(int y) {
    for (int x = 1; x < textures_.width; ++x)
      if (at(x, y, 0) == k_empty && at(x - 1, y, 0) != k_empty) copy(x, y, x - 1, y);
    for (int x = textures_.width - 2; x >= 0; --x)
      if (at(x, y, 0) == k_empty && at(x + 1, y, 0) != k_empty) copy(x, y, x + 1, y);
    for (int x = 0; x < textures_.width && at(x, y, 0) == k_empty; ++x) {
      if (y > 0)
        copy(x, y, x, y - 1);
      else
        at(x, y, 0) = 1 - 0.5f * variation_.base, at(x, y, 1) = at(x, y, 2) = 0.5f;
    }
  }

  CardTextures& textures_;
  int left_;
  Variation variation_;
};

}  // namespace

glm::vec2 CardTextures::atlas_uv(std::uint32_t kind, float u, float v) const {
  return {(float(kind) * float(width) + 1 + u * float(width - 2)) / (float(kinds.size()) * float(width)), v};
}

namespace {

CardKind bake_kind(const Groom& groom, const CardSet& set, std::uint32_t chosen, const CardParameters& parameters,
                   CardTextures& textures) {
  const Card& card = set.cards[chosen];
  StrandTexture texture(groom, set, card, textures.width, textures.height);
  texture.draw(1);
  CardKind kind{.card = chosen, .coverage = texture.mean_alpha()};
  kind.strand_width = draw_filled(texture, parameters.fill);
  kind.alpha = texture.mean_alpha();
  kind.opaque = texture.opaque_share();
  std::vector<Look> looks;
  for (std::uint32_t strand : card.members) looks.emplace_back(parameters.seed, strand);
  const Variation variation{float(parameters.base_variation), float(parameters.shift_variation)};
  KindPainter(textures, int(textures.kinds.size()), variation).paint(texture, looks);
  return kind;
}

constexpr std::size_t k_features = k_coarse_columns * k_coarse_rows;

/// Gives every card its kind; the mean difference of coverage within kinds.
double assign_kinds(const Clusters& clusters, std::span<const float> features, std::span<const CardKind> kinds,
                    std::span<Card> cards) {
  double error = 0;
  for (std::size_t c = 0; c < cards.size(); ++c) {
    cards[c].kind = clusters.of[c];
    const double own = mean_of(features.subspan(c * k_features, k_features));
    const double shared = mean_of(features.subspan(kinds[clusters.of[c]].card * k_features, k_features));
    error += std::abs(own - shared) / double(cards.size());
  }
  return error;
}

}  // namespace

CardTextures bake_textures(const Groom& groom, CardSet& set, const CardParameters& parameters) {
  std::vector<float> features;
  for (const Card& card : set.cards) {
    const std::vector<float> alphas = coarse_alphas(groom, set, card);
    features.insert(features.end(), alphas.begin(), alphas.end());
  }
  const Clusters clusters = k_means(features, k_features, parameters.kinds, 8, parameters.seed);
  CardTextures textures{
      .width = parameters.texture_width, .height = parameters.texture_height, .atlas = {}, .kinds = {}};
  textures.atlas =
      make_image(textures.width * int(clusters.count), textures.height, {"base", "shift", "mask", "alpha"});
  for (std::size_t kind = 0; kind < clusters.count; ++kind)
    textures.kinds.push_back(
        bake_kind(groom, set, representative(clusters, kind, features, k_features), parameters, textures));
  textures.kind_error = assign_kinds(clusters, features, textures.kinds, set.cards);
  return textures;
}

}  // namespace cuticle::strands
