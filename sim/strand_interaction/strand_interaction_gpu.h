#pragma once
// GPU half: the same whole-number sums on the device, two dispatches a frame after those of the solver.
#include "sim/solver_gpu.h"
#include "sim/strand_interaction/strand_interaction.h"

namespace cuticle::sim::strand_interaction {

/// Where a solver keeps the velocities of the vertices in its state, a buffer of floats.
struct VelocityLayout {
  static constexpr std::uint32_t k_carried = 0xffffffffu;
  std::vector<std::uint32_t> places;   ///< of the first component, by vertex; k_carried: the head moves it
  std::uint32_t component_stride = 1;  ///< from component to component
  std::uint32_t before_offset = 0;  ///< from there to the velocity one substep earlier, which changes as well; 0: none
};

/// What a solver hands over: world places and velocities (vec4 by vertex), and its state.
struct SolverBuffers {
  const gpu::Buffer *world, *velocities, *state;
};

/// Of a skin: chains::SkinStrand by strand, and where it has the vertices at the frame's end (vec4).
struct SkinBuffers {
  const gpu::Buffer *strands, *end;
};

class StrandInteractionGpu {
 public:
  /// Error: that of make_strand_grid; out_of_memory.
  static Result<std::unique_ptr<StrandInteractionGpu>> create(gpu::Device& device, const strands::Groom& rest,
                                                              const Settings& settings, const VelocityLayout& layout);
  /// As StrandInteraction::changes, added to the state and to the velocities handed over. rotation, translation: the
  /// head's at the frame's end.
  void record(gpu::Commands& commands, const SolverBuffers& buffers, const glm::dmat3& rotation,
              const glm::dvec3& translation, double duration);
  /// Before the first frame on a skin.
  Result<void> make_for_skin(gpu::Device& device, const strands::Groom& rest);
  /// The same where each strand has a head of its own.
  void record_on_skin(gpu::Commands& commands, const SolverBuffers& buffers, const SkinBuffers& skin, double duration);
  /// After the recorded work: the nodes' sums, and vertices left out (GridSums::left_out).
  Result<std::vector<NodeSums>> sums(gpu::Device& device) const;
  Result<std::uint32_t> left_out(gpu::Device& device) const;

 private:
  using Bound = std::vector<const gpu::Buffer*>;
  void record_both(gpu::Commands& commands, const GridFrame<float>& frame, const gpu::Kernel& deposit,
                   const Bound& deposited, const gpu::Kernel& push, const Bound& pushed);

  StrandGrid grid_;
  Settings settings_;
  std::uint32_t component_stride_ = 1, before_offset_ = 0;
  gpu::Buffer masses_, rest_densities_, places_, sums_, strand_of_vertex_;
  gpu::Kernel deposit_, push_, deposit_on_skin_, push_on_skin_;
};

}  // namespace cuticle::sim::strand_interaction
