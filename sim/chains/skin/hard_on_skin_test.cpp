// Hair on a skin in hard cases, on the CPU.
#include "sim/chains/skin/test_on_skin.h"

namespace cuticle::sim::hard_on_skin_test {
namespace {

using namespace testing;

class HardOnSkin : public ::testing::TestWithParam<const char*> {
 protected:
  MakeSolver make = [](const strands::Groom& groom, const std::string& settings) {
    return make_solver(GetParam(), groom, settings, gravity());
  };
  AdvanceOnSkin advance = [](Solver& solver, std::span<const glm::vec3> skinned, FrameInput input) {
    input.skinned = skinned;
    return solver.advance(input);
  };
};
INSTANTIATE_TEST_SUITE_P(Solvers, HardOnSkin, ::testing::Values("classic", "exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(HardOnSkin, EveryShapeStepAndDisturbance_StaysFinite) {
  const double most = matrix_on_skin(GetParam(), make, advance, 12);
  const bool rigid = GetParam() != std::string("classic");  // which does not keep lengths
  EXPECT_TRUE(!rigid || most <= 1) << most;
}

TEST_P(HardOnSkin, StrandCarriedOutOfRange_IsResetAndCountedAndTouchesNoOther) {
  const Suffered suffered = suffered_beside_others(make, advance, 3e38f);
  expect_recovery(suffered);
  for (std::size_t frame : {4, 7}) EXPECT_EQ(suffered.resets[frame], 1u) << frame;  // when it moves
}

TEST_P(HardOnSkin, PlaceThatIsNoNumber_IsRefusedAndChangesNothing) {
  const strands::Groom groom = ring(3);
  auto well = make(groom, ""), ill = make(groom, "");
  for (int frame = 0; frame < 8; ++frame) {
    std::vector<glm::vec3> skinned = on_turning_roots(groom, frame / 30.0);
    ASSERT_TRUE(advance(*well, skinned, {.duration = 1.0 / 30}).ok());
    std::vector<glm::vec3> broken = skinned;
    broken[20].z = frame % 2 ? NAN : INFINITY;
    const auto refused = advance(*ill, broken, {.duration = 1.0 / 30});
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("skinned[20]"));
    ASSERT_TRUE(advance(*ill, skinned, {.duration = 1.0 / 30}).ok());
    EXPECT_EQ(ill->state()->positions, well->state()->positions) << frame;
  }
}

}  // namespace
}  // namespace cuticle::sim::hard_on_skin_test
