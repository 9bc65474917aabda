#pragma once
// Cards on the device, carried by their strands.
#include <optional>

#include <glm/vec4.hpp>

#include "render/strand_shading/gathered_transmittance_gpu.h"
#include "strands/cards/hair_cards.h"

namespace cuticle::render::cards {

/// As card_rows.glsl has it.
struct CardRest {
  glm::vec4 correction, across, tangent, follower_tangent;
  glm::uvec4 followers;
};
static_assert(sizeof(CardRest) == 80);

/// Strands that a card follows: as many of its members, evenly taken.
inline constexpr std::size_t k_max_followers = 8;

class Placement {
 public:
  /// Of the drawn strands at rest, all of as many vertices.
  static Result<Placement> make(gpu::Device& device, const Resources& resources, const strands::HairCards& cards);
  /// One dispatch: the rows where this frame's strands are, and what of each light arrives there.
  void record(gpu::Commands& commands, const Resources& resources) const;

  const gpu::Buffer& rests() const { return rests_; }
  const gpu::Buffer& placed() const { return placed_; }
  /// Light by light and channel by channel a float per row, then light by light what passes surfaces, where they cast;
  /// one float where nothing shadows.
  const gpu::Buffer& reached() const { return reached_; }
  std::uint32_t row_count() const { return rows_; }

 private:
  gpu::Buffer rests_, followers_, placed_, reached_;
  std::optional<GatheredTransmittance> transmittance_;  ///< of the strands, where a method shadows
  gpu::Kernel kernel_;
  std::uint32_t rows_ = 0;
};

}  // namespace cuticle::render::cards
