#pragma once
// N10: fins. A triangle mesh moved by the particles of `classic`, blended with the skinned mesh by painted weights.
#include <memory>

#include "sim/classic/settings.h"
#include "sim/solver.h"
#include "strands/mesh.h"

namespace cuticle::sim::cloth {

/// Those of `classic` that a sheet has.
struct Cloth : classic::Classic {
  static constexpr std::string_view name = "cloth";
  Cloth() {
    iterations = 8;
    shape_tip = 0.2f;
  }
};
void describe(registry::Members& members, Cloth& cloth);

}  // namespace cuticle::sim::cloth

namespace cuticle::sim {

/// A sheet in the head's rest space, metres. weights: one per vertex, 0 (root: rigid, goes with the skin) .. 1 (tip:
/// simulated); effects: "gravity", "wind", "water", "colliders". FrameInput::authored
/// is the skinned mesh at the frame's end (none: the mesh carried by the head); FrameInput::control must be empty or
/// factors of the skin's weight. The state is the blend, one entry per vertex of the mesh; not finite: the whole sheet
/// is put back and counted. Error: bad_input naming triangle or vertex when an index is out of range, a position is not
/// finite or a weight is outside 0 .. 1; usage for another effect.
Result<std::unique_ptr<Solver>> make_cloth(const strands::Mesh& mesh, std::span<const float> weights,
                                           const cloth::Cloth& cloth, const EffectBlocks& effects);

}  // namespace cuticle::sim
