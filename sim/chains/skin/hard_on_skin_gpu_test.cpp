// Hair on a skin whose places are on the device, in hard cases.
#include "sim/chains/skin/test_on_skin.h"
#include "sim/classic/test_gpu.h"

namespace cuticle::sim::hard_on_skin_gpu_test {
namespace {

using namespace testing;

class HardOnSkinKernel : public ::testing::TestWithParam<const char*> {
 protected:
  MakeSolver make = [](const strands::Groom& groom, const std::string& settings) {
    return make_gpu(GetParam(), groom, settings, gravity());
  };
  AdvanceOnSkin advance = [](Solver& solver, std::span<const glm::vec3> skinned,
                             const FrameInput& input) -> Result<void> {
    std::vector<glm::vec4> places;
    for (const glm::vec3& place : skinned) places.emplace_back(place, 0);
    const gpu::Buffer buffer = gpu::make_buffer_from(*device(), std::span<const glm::vec4>(places)).value();
    gpu::Commands commands = device()->record();
    CUTICLE_TRY(dynamic_cast<GpuSolver&>(solver).record_on_skin(commands, input, buffer));
    CUTICLE_ASSIGN([[maybe_unused]] const gpu::SubmitCost cost, device()->submit(std::move(commands)));
    return {};
  };
};
INSTANTIATE_TEST_SUITE_P(Solvers, HardOnSkinKernel, ::testing::Values("classic", "exact", "rod"),
                         [](const auto& info) { return info.param; });

TEST_P(HardOnSkinKernel, EveryShapeStepAndDisturbance_StaysFinite) {
  const double most = matrix_on_skin(GetParam(), make, advance, 6);
  const bool rigid = GetParam() != std::string("classic");  // which does not keep lengths
  EXPECT_TRUE(!rigid || most <= 1) << most;
}

TEST_P(HardOnSkinKernel, StrandCarriedOutOfRange_TouchesNoOtherAndRecovers) {
  expect_recovery(suffered_beside_others(make, advance, 1e30f));
}

TEST_P(HardOnSkinKernel, StrandCarriedToNoNumber_IsResetAndCountedAndTouchesNoOther) {
  const Suffered suffered = suffered_beside_others(make, advance, NAN);
  expect_recovery(suffered);
  for (std::size_t frame : {4, 5, 6}) EXPECT_EQ(suffered.resets[frame], 1u) << frame;
}

}  // namespace
}  // namespace cuticle::sim::hard_on_skin_gpu_test
