#pragma once
// Hair on a skin in hard cases, for every solver that follows one, on the CPU and on the device.
#include <array>

#include "sim/chains/test_stability.h"

namespace cuticle::sim::testing {

/// One frame on a skin whose places are these.
using AdvanceOnSkin = std::function<Result<void>(Solver&, std::span<const glm::vec3>, const FrameInput&)>;
using MakeSolver = std::function<std::unique_ptr<Solver>(const strands::Groom&, const std::string& settings)>;

/// Every shape of the stability matrix, a strand each.
inline strands::Groom all_shapes() {
  strands::Groom all;
  for (const auto& [name, shape] : shapes()) {
    all.positions.insert(all.positions.end(), shape.positions.begin(), shape.positions.end());
    all.offsets.push_back(std::uint32_t(all.positions.size()));
  }
  all.radii.assign(all.positions.size(), strands::k_default_radius);
  return all;
}

/// Every shape on a skin that this disturbance moves: all finite, nothing reset, and where the frame ends at the origin
/// the largest stretch over its bound.
inline double worst_on_skin(const MakeSolver& make, const AdvanceOnSkin& advance, double duration,
                            Disturbance disturbance, int frames) {
  const strands::Groom groom = all_shapes();
  auto solver = make(groom, "inner_step=1,max_substeps=1,damping=2");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const double size = disturbance == Disturbance::kicks ? 50 * std::min(duration, 2.0) : 100;
  double worst = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const bool away = disturbance != Disturbance::none && frame < frames * 2 / 3 && frame % 2 == 0;
    const glm::dvec3 shift = away ? glm::dvec3(unit(random), unit(random), unit(random)) * size : glm::dvec3(0);
    std::vector<glm::vec3> skinned;
    for (const glm::vec3& place : groom.positions) skinned.emplace_back(glm::dvec3(place) + shift);
    const Result<void> advanced =
        advance(*solver, skinned, {.duration = duration, .teleport = disturbance == Disturbance::teleports});
    EXPECT_TRUE(advanced.ok());
    const State state = solver->state().value();
    EXPECT_TRUE(all_finite(state)) << k_names[int(disturbance)] << ", step " << duration << ", frame " << frame;
    EXPECT_EQ(state.guards_fired, 0u);
    if (!away) worst = std::max(worst, worst_over_bound(groom, state));
  }
  return worst;
}

/// Prints a row for every disturbance; gives the largest stretch over its bound.
inline double matrix_on_skin(std::string_view name, const MakeSolver& make, const AdvanceOnSkin& advance, int frames) {
  double most = 0;
  for (int disturbance = 0; disturbance < 4; ++disturbance) {
    double worst = 0;
    for (double duration : k_durations)
      worst = std::max(worst, worst_on_skin(make, advance, duration, Disturbance(disturbance), frames));
    std::printf("%s on a skin, all shapes: %-13s stretch over its bound, steps of 1e-3 .. 100 s: %.2g\n", name.data(),
                k_names[disturbance], worst);
    most = std::max(most, worst);
  }
  return most;
}

/// What a strand suffers that a skin carries to `wrong` in three frames, 4 to 6 of 12.
struct Suffered {
  std::array<std::uint32_t, 12> resets;  ///< by frame
  std::array<bool, 12> finite;
};
/// The other strands move as they do without, to the bit.
inline Suffered suffered_beside_others(const MakeSolver& make, const AdvanceOnSkin& advance, float wrong) {
  const strands::Groom groom = ring(20);
  auto well = make(groom, ""), ill = make(groom, "");
  Suffered suffered;
  for (int frame = 0; frame < 12; ++frame) {
    std::vector<glm::vec3> skinned = on_turning_roots(groom, frame / 30.0);
    EXPECT_TRUE(advance(*well, skinned, {.duration = 1.0 / 30}).ok());
    for (int i = 0; i < 17 && frame >= 4 && frame < 7; ++i)
      skinned[std::size_t(17 * 5 + i)] = glm::vec3(wrong, i % 2 ? wrong : -wrong, wrong);
    EXPECT_TRUE(advance(*ill, skinned, {.duration = 1.0 / 30}).ok());
    const State expected = well->state().value(), state = ill->state().value();
    suffered.resets[std::size_t(frame)] = state.guards_fired;
    suffered.finite[std::size_t(frame)] = all_finite(state);
    for (std::size_t i = 0; i < groom.vertex_count(); ++i)
      if (i / 17 != 5 && (state.positions[i] != expected.positions[i] || state.velocities[i] != expected.velocities[i]))
        ADD_FAILURE() << "frame " << frame << ", vertex " << i << " of another strand";
  }
  return suffered;
}
/// Nothing before, and from two frames after on: finite, and not reset again.
inline void expect_recovery(const Suffered& suffered) {
  for (std::size_t frame : {0, 1, 2, 3, 8, 9, 10, 11}) EXPECT_TRUE(suffered.finite[frame]) << frame;
  for (std::size_t frame : {0, 1, 2, 3, 9, 10, 11}) EXPECT_EQ(suffered.resets[frame], 0u) << frame;
  std::printf("resets and finite by frame:");
  for (std::size_t frame = 0; frame < 12; ++frame)
    std::printf(" %u%s", suffered.resets[frame], suffered.finite[frame] ? "" : "!");
  std::printf("\n");
}

}  // namespace cuticle::sim::testing
