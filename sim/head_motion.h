#pragma once
// From a frame's input to its substeps: what the CPU twin and the kernels take as constants.
#include <cstdint>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "sim/solver.h"

namespace cuticle::sim {

/// One substep. Rotations are unit quaternions (xyz, w), rest -> world. Positions in the state are relative to the
/// head's translation, so a substep only needs how far that moved: no precision is lost 100 m from the origin.
struct Substep {
  float duration = 0;           ///< seconds; 0: the state is carried, velocities kept
  float gravity_factor = 0;     ///< h (h + previous h) / 2: what an acceleration adds to a position, s^2
  glm::vec4 carry{0, 0, 0, 1};  ///< turn applied to the state before the step (first frame, teleport)
  glm::vec4 rotation_begin{0, 0, 0, 1}, rotation_end{0, 0, 0, 1};
  glm::vec3 translation_step{0};  ///< metres that the head moves in the substep
  glm::vec3 translation{0};       ///< the head's translation at the end of the frame, world
  double time = 0;                ///< seconds at its end since the first frame began
  bool onto_skin = false;         ///< on a skin: the state is put there, at rest, before the step
};

/// Where the head stands between a frame's begin and end; of a jump, at its end all along.
struct HeadWay {
  explicit HeadWay(const FrameInput& input);
  glm::dquat turn(double share) const { return glm::slerp(begin, end, share); }
  Placement at(double share) const { return {turn(share), glm::mix(from, to, share)}; }
  bool jump = false;
  glm::dquat before{1, 0, 0, 0}, begin{1, 0, 0, 0}, end{1, 0, 0, 0};  ///< `before`: at the begin, of a jump also
  glm::dvec3 from{0}, to{0};
};

/// Where a collider's own frame stands at a substep's begin and end: to the world's axes, its origin relative to the
/// head's translation then. A jump of its keys is no motion: it begins where it jumps to.
struct MovingPart {
  Placement begin, end;
};
/// Of collider i in substep k: [k * colliders.size() + i].
std::vector<MovingPart> moving_parts(const FrameInput& input, std::span<const MovingCollider* const> colliders,
                                     std::size_t substeps);

/// The same frame for hair on a skin: no head moves.
FrameInput without_head(const FrameInput& input);

/// ceil(duration / inner_step), between 1 and `most`: past that the step stretches.
std::uint32_t inner_steps(double duration, double inner_step, std::uint32_t most);

/// Error: bad_input naming FrameInput::skinned where it has another number of places or one is not finite.
Result<void> check_skinned(std::span<const glm::vec3> skinned, std::size_t vertices);

/// Follows the head from frame to frame.
class HeadMotion {
 public:
  /// `meets_all`: whether the solver meets other colliders than spheres.
  explicit HeadMotion(bool meets_all = false) : meets_all_(meets_all) {}
  /// Cuts a frame into `substeps` equal parts, and remembers where it ends. Error: bad_input naming the field when a
  /// matrix is not finite or not rigid within 1e-3, the duration is outside 0 .. 100 s, or a collider is not finite or
  /// has a negative radius; usage where there are colliders that the solver does not meet; nothing is then remembered.
  Result<std::vector<Substep>> advance(const FrameInput& input, std::uint32_t substeps);
  /// The same for hair on a skin, which no head moves: FrameInput::skinned is the caller's to read. Error: also usage
  /// where one follows the other.
  Result<std::vector<Substep>> advance_on_skin(const FrameInput& input, std::uint32_t substeps);

 private:
  enum class Carrier { none, head, skin };
  std::vector<Substep> cut(const FrameInput& input, std::uint32_t substeps);
  Result<void> follow(Carrier carrier);
  Result<void> check_shapes(const FrameInput& input) const;

  bool meets_all_ = false;
  Carrier carrier_ = Carrier::none;
  bool placed_ = false;
  double previous_duration_ = 0, time_ = 0;
};

}  // namespace cuticle::sim
