#pragma once
// The order in which parts of cards are drawn: the index buffer, static or of this frame.
#include "render/pass_gpu.h"
#include "render/passes/cards/cards.h"
#include "strands/cards/card_mesh.h"

namespace cuticle::render::cards {

class Sorting {
 public:
  static Result<Sorting> make(gpu::Device& device, const strands::CardMesh& mesh, Order order);
  /// Two dispatches, from far to near by the mean depth of a part's placed rows; none for the static order.
  void record(gpu::Commands& commands, const Camera& camera, const gpu::Buffer& placed) const;

  const gpu::Buffer& indices() const { return order_ == Order::inside_to_outside ? static_ : sorted_; }
  std::uint32_t index_count() const { return index_count_; }

 private:
  Order order_ = Order::inside_to_outside;
  gpu::Buffer static_, sorted_, parts_, depths_;
  gpu::Kernel depth_, sort_;
  std::uint32_t index_count_ = 0, part_count_ = 0;
};

}  // namespace cuticle::render::cards
