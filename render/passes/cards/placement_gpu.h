#pragma once
// Cards on the device, carried by their strands.
#include <glm/vec4.hpp>

#include <cuticle/render/pass_gpu.h>
#include <cuticle/strands/cards/hair_cards.h>

namespace cuticle::render::cards {

/// As card_rows.glsl has it.
struct CardRest {
  glm::vec4 correction, across, tangent, follower_tangent;
  glm::uvec4 followers;
};
static_assert(sizeof(CardRest) == 80);

/// Strands that a card follows: as many of its members, evenly taken.
inline constexpr std::size_t k_most_followers = 8;

class Placement {
 public:
  /// `rest`: the drawn strands at rest, all of as many vertices.
  static Result<Placement> make(gpu::Device& device, const strands::Groom& rest, const strands::HairCards& cards);
  /// One dispatch: the rows where this frame's strands are.
  void record(gpu::Commands& commands, const FrameResources& resources) const;

  const gpu::Buffer& rests() const { return rests_; }
  const gpu::Buffer& placed() const { return placed_; }

 private:
  gpu::Buffer rests_, followers_, placed_;
  gpu::Kernel kernel_;
  std::uint32_t rows_ = 0;
};

}  // namespace cuticle::render::cards
