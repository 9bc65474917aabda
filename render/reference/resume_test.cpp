// A render that is killed goes on from its state. The test runs its own program again as the one that is killed.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::resume_test {
namespace {

constexpr const char* k_state = "CUTICLE_KILLED_STATE";
constexpr int k_samples = 160;
const TraceOptions k_options{.scatterings = 3, .layers = true};

TEST(Resume, DISABLED_RendersUntilItIsKilled) {
  picture_of(lit_ball(), k_options, {.samples = 1000000, .state = std::getenv(k_state), .save_seconds = 0});
}

pid_t start_render(const std::string& state) {
  const pid_t child = fork();
  if (child != 0) return child;
  setenv(k_state, state.c_str(), 1);
  const char* filter = "--gtest_filter=Resume.DISABLED_RendersUntilItIsKilled";
  execl("/proc/self/exe", "killed_render", filter, "--gtest_also_run_disabled_tests", nullptr);
  _exit(1);
}

TEST(Resume, KilledDuringARender_SameBits) {
  const std::string state =
      (std::filesystem::temp_directory_path() / fmt::format("cuticle_killed_{}", getpid())).string();
  const pid_t child = start_render(state);
  ASSERT_GT(child, 0);
  for (int k = 0; k < 3000 && !std::filesystem::exists(state); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // into some later round or its writing
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(std::filesystem::exists(state));
  const TracedScene scene = lit_ball();
  const Picture resumed = picture_of(scene, k_options, {.samples = k_samples, .state = state});
  std::filesystem::remove(state);
  ASSERT_EQ(resumed.samples, k_samples) << "the killed render went further than that";
  EXPECT_EQ(resumed.layers.pixels, picture_of(scene, k_options, {.samples = k_samples}).layers.pixels);
}

}  // namespace
}  // namespace cuticle::render::reference::resume_test
