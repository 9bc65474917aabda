#pragma once
// H17: strand against strand, once a frame after the solver's substeps: what it adds to the vertices' velocities.
#include <memory>

#include <glm/mat3x3.hpp>

#include "sim/strand_interaction/settings.h"
#include "sim/strand_interaction/strand_grid.glslh"
#include "sim/strand_interaction/strand_grid.h"

namespace cuticle::sim::strand_interaction {

/// The density (masses at the nodes, as StrandGrid counts them) at which pressure on a vertex begins: that of the rest
/// pose at the vertex, or its mean over the groom where that is more, times the onset.
std::vector<float> rest_densities(const StrandGrid& grid, const strands::Groom& rest, double onset);

/// rotation, translation: the head's at the frame's end; duration: seconds, above zero.
GridFrame<float> frame_constants(const StrandGrid& grid, const Settings& settings, const glm::dmat3& rotation,
                                 const glm::dvec3& translation, double duration);

/// On the CPU. Results are bit-identical at any number of threads.
class StrandInteraction {
 public:
  /// Error: that of make_strand_grid.
  static Result<std::unique_ptr<StrandInteraction>> create(const strands::Groom& rest, const Settings& settings);
  /// To be filled with the frame's end: places in the head's space, or on a skin in that of each strand's root, at rest
  /// (metres), velocities in world space (m/s).
  std::span<glm::vec3> places() { return places_; }
  std::span<glm::vec3> velocities() { return velocities_; }
  /// What the interaction adds to each velocity, m/s; zero outside the grid. Smoothing alone keeps the momentum that
  /// the grid counts (StrandInteraction.Smoothing_KeepsMomentum). rotations: from the places' space to the world's, one
  /// for all strands or one for each; duration: as frame_constants.
  std::span<const glm::vec3> changes(std::span<const glm::dmat3> rotations, double duration);
  /// As GridSums::left_out, of the last frame.
  std::uint32_t left_out() const { return sums_.left_out(); }

 private:
  StrandInteraction(const StrandGrid& grid, const strands::Groom& rest, const Settings& settings);

  StrandGrid grid_;
  Settings settings_;
  std::vector<std::uint32_t> offsets_;  ///< of the strands' vertices
  std::vector<float> rest_densities_;
  GridSums sums_;
  std::vector<glm::vec3> places_, velocities_, changes_;
};

}  // namespace cuticle::sim::strand_interaction
