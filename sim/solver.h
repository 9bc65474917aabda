#pragma once
// The concept of a strand solver and of the effects that act in it. State is stored relative to the head's frame
// origin.
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/keyed_motion.h"
#include "core/registry/entry.h"
#include "core/registry/members.h"
#include "core/result.h"
#include "core/rounded_box.h"
#include "core/view.h"
#include "sim/push.h"
#include "strands/groom.h"

namespace cuticle::sim {

/// Parameters of the effects that the plan demands, by effect name ("gravity", "colliders", ...). An absent name: the
/// effect is not simulated and none of its work is dispatched.
using EffectBlocks = std::map<std::string, registry::ParameterValues, std::less<>>;

/// The parameters of the effect T::name, where it is simulated.
template <class T>
std::optional<T> find_effect(const EffectBlocks& effects) {
  const auto found = effects.find(T::name);
  return found == effects.end() ? std::nullopt : std::optional(registry::from_values<T>(found->second));
}

struct DistanceField;
using FieldPointer = std::shared_ptr<const DistanceField>;

/// A collider that moves by itself: its shape, in a frame that the keys place in world space or, `on_head`, in the
/// head's rest space, which the head then carries. A jump of the keys takes it along without velocity.
struct MovingCollider {
  std::variant<Sphere, RoundedBox, FieldPointer> shape;  ///< classic: spheres only
  KeyedMotion motion;
  bool on_head = false;
};

/// What moves between two frames. Transforms are rest -> world of the head and rigid; colliders are given in rest space
/// of the head and move with it. Between begin and end every substep interpolates (rotation by slerp). The state is
/// taken to stand at head_begin; the first frame starts from the rest pose there.
struct FrameInput {
  double duration = 1.0 / 60;  ///< seconds, 0 .. 100; 0: a motion acts as a teleport
  glm::dmat4 head_begin{1}, head_end{1};
  std::span<const Sphere> colliders = {};
  std::span<const RoundedBox> boxes = {};       ///< colliders as well, capsules among them: exact and rod only
  std::span<const FieldPointer> fields = {};    ///< the same of meshes (colliders/distance_field.h); none is null
  std::span<const MovingCollider> moving = {};  ///< colliders as well
  double clock_begin = 0, clock_end = 0;        ///< their keys' time at the frame's begin and end, seconds
  /// For each strand whether a collider may touch it in this frame; empty: all of them. The others must be out of every
  /// collider's reach: a solver need not look there (classic does not).
  std::span<const std::uint8_t> reached = {};
  bool teleport = false;  ///< the whole state moves rigidly with the head, velocity kept in its frame
  /// Of the effect "control", one entry per vertex or none. authored: world places at the frame's end, metres (none:
  /// the rest pose carried by the head); control: factors 0 .. 1 of its weight in this frame (none: 1).
  std::span<const glm::vec3> authored = {};
  std::span<const float> control = {};
  /// Hair on a skin that deforms: world places of all vertices at the frame's end as the skin carries them, metres. A
  /// substep takes roots and rest pose from between those of the frame before and these (first frame, teleport,
  /// duration 0: the hair is put there, at rest); head_begin and head_end do not count, colliders are in world space.
  /// Empty: the head carries the rest pose. All frames of a solver have it or none; only of an Effect that
  /// follows_skin.
  std::span<const glm::vec3> skinned = {};
};

/// State at the end of a frame, in world space, one entry per control vertex.
struct State {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> velocities;  ///< metres per second, the mean over the last substep
  /// Tension in the segment towards the root over the fibre's mass per length, m^2/s^2 (so times rho A: newtons); 0 in
  /// pressure, at roots and at carried vertices. Empty where the solver solves no tensions (classic).
  std::vector<float> tensions = {};
  std::uint32_t guards_fired = 0;  ///< strands reset in the last frame because something was not finite
  /// Vertices that "strand_interaction" could not count in the last frame: outside its grid, or faster than 128 m/s.
  std::uint32_t left_out = 0;
  std::uint32_t asleep = 0;  ///< strands that "sleep" has left as they are since they came to rest
  /// By strand: 1 where it is one of guards_fired. Empty of surfaces (cloth).
  std::vector<std::uint32_t> resets = {};
};

/// Per-segment stretch: length over rest length (one value per vertex, the segment towards the root; 1 at roots
/// and where the rest length is 0).
std::vector<float> stretch(const strands::Groom& rest, std::span<const glm::vec3> positions);

/// Curvature of the strands at these positions, 1/m: at a vertex 2 tan(a / 2) over the mean of the two segments'
/// lengths, a the angle between them, at most 1e6; 0 at ends and beside segments of no length.
std::vector<float> curvature(const strands::Groom& rest, std::span<const glm::vec3> positions);

class Solver {
 public:
  virtual ~Solver() = default;
  /// Error: bad_input naming the field when the input is not finite, not rigid or out of range; the state is then
  /// unchanged.
  virtual Result<void> advance(const FrameInput& input) = 0;
  virtual Result<State> state() = 0;
};

/// A solver (entry.name "classic", "exact") or an effect (entry.name "gravity"); effects have no `create`.
struct Effect {
  registry::Entry entry;
  Result<std::unique_ptr<Solver>> (*create)(const strands::Groom& rest, const registry::ParameterValues& solver,
                                            const EffectBlocks& effects) = nullptr;
  /// Substeps that the solver takes for a frame of this duration (seconds): FrameShape::substeps. Null for effects.
  std::uint32_t (*substeps)(const registry::ParameterValues& solver, double duration) = nullptr;
  /// What an effect does to all fibres alike ("wind", "water"); null for those that act otherwise.
  PushOverTime (*push)(const registry::ParameterValues& effect) = nullptr;
  /// The share of gravity that an effect leaves ("water"); null: all of it.
  double (*weight_left)(const registry::ParameterValues& effect) = nullptr;
  /// Whether a solver does the work of its effects in its own dispatches, so that they make none.
  bool fuses_effects = false;
  /// Whether an effect acts by dispatches of its own on what a solver found in a frame ("control",
  /// "strand_interaction"), or will find ("clumping").
  bool acts_on_result = false;
  /// Whether an effect moves the scene's fins, and does nothing to hair ("cloth").
  bool acts_on_fins = false;
  /// Whether a solver takes FrameInput::skinned.
  bool follows_skin = false;
};
std::span<const Effect* const> effects();
Result<const Effect*> find_effect(std::string_view name);

/// Of all simulated effects that push.
Pushes effect_pushes(const EffectBlocks& effects);

}  // namespace cuticle::sim
