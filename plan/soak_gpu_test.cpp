// Ten thousand frames with all that moves hair, teleports and changes of parameters (scripts/test.sh --full; else some
// hundred): memory stays flat, nothing drifts, nothing becomes NaN, and frames do not take longer and longer.
#include "tests/support/small_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>

#include <fmt/core.h>

namespace cuticle::plan::soak_gpu_test {
namespace {

using namespace tests;

int frames() { return std::getenv("CUTICLE_SWEEPS") ? 10000 : 240; }

/// A head that turns, and jumps by two metres every fifty frames, which the solver must take as they come.
std::string motion_file() {
  const std::string path = CUTICLE_BINARY_DIR "/soak.bvh";
  std::ofstream file(path);
  file << "HIERARCHY\nROOT Head\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
          "Yrotation\n"
          " End Site\n {\n OFFSET 0 1 0\n }\n}\nMOTION\nFrames: 10002\nFrame Time: 0.0333333\n";
  for (int k = 0; k < 10002; ++k)
    file << fmt::format("{} 0 0 0 {:.4f} {:.4f}\n", 2 * ((k / 50) % 2), 20 * std::sin(0.21 * k),
                        40 * std::sin(0.13 * k));
  return path;
}

scene::Scene scene_with(double wind) {
  const std::string simulation = fmt::format(
      R"("simulation": {{"solver": {{"exact": {{}}}}, "effects": {{"gravity": {{}}, "colliders": {{}}, "wind": {{"velocity": [{}, 0, 0]}},
         "strand_interaction": {{}}, "clumping": {{}}}}}})",
      wind);
  const std::string motion =
      fmt::format(R"("motion": {{"bvh": "{}", "joint": "Head", "metres_per_unit": 1}})", motion_file());
  return scene_of(
      {k_light, k_shadow, k_tiles, simulation, motion, R"("strand_count": 60)", R"("strand_vertices": 8)",
       R"("colliders": {"head": true, "spheres": [{"center_m": [0, 0, 0], "radius_m": 0.05, "motion": {"keys":
                      [{"time_s": 0, "position_m": [-0.4, 0.1, 0]}, {"time_s": 400, "position_m": [0.4, 0.1, 0]}]}}]})",
       R"("camera": {"position_m": [0.2, 0.15, 4], "target_m": [0, 0.05, 0], "fov_deg": 30, "resolution_px": [16, 16]})"});
}

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * 4096;
}

struct Quarter {
  /// Of the processor: the quickest frame without a picture, and with one. Sums vary by half beside other programs.
  std::array<double, 2> seconds{1e9, 1e9};
  std::size_t resident = 0, on_device = 0;
};

double longest_stretch(FrameRunner& runner, const FrameResult& frame) {
  double longest = 0;
  for (float stretch : sim::stretch(runner.control_groom(), frame.state.positions))
    longest = std::max(longest, double(stretch));
  return longest;
}

TEST(Soak, ThousandsOfFramesWithEverythingOn_StayFlatFiniteAndAtTheirLength) {
  const std::size_t before = device()->allocated_bytes();
  std::array<Quarter, 4> quarters;
  {
    auto made = FrameRunner::create(device(), scene_with(1), silent_progress());
    ASSERT_TRUE(made) << made.error().message;
    FrameRunner& runner = **made;
    const int count = frames();
    for (int frame = 0; frame < count; ++frame) {
      Quarter& quarter = quarters[std::size_t(4 * frame / count)];
      const std::clock_t begin = std::clock();
      const FrameResult result = runner.run(frame, {.render = frame % 8 == 0, .read_state = true}).value();
      double& quickest = quarter.seconds[frame % 8 == 0];
      quickest = std::min(quickest, double(std::clock() - begin) / CLOCKS_PER_SEC);
      quarter.resident = resident_bytes();
      quarter.on_device = std::max(quarter.on_device, device()->allocated_bytes() - before);
      for (const glm::vec3& place : result.state.positions)
        ASSERT_TRUE(std::isfinite(place.x + place.y + place.z)) << "frame " << frame;
      for (float value : result.color.pixels) ASSERT_TRUE(std::isfinite(value)) << "frame " << frame;
      ASSERT_EQ(result.state.guards_fired, 0u) << "frame " << frame;
      if (frame % 16 == 0) {
        ASSERT_LT(longest_stretch(runner, result), 1 + 1e-3) << "frame " << frame;
      }
      if (frame % 60 == 59) {  // a change of the picture's parameters keeps the hair where it is
        scene::Scene next = scene_with(1);
        next.material.lut_size = frame % 120 == 59 ? 16 : 32;
        ASSERT_TRUE(runner.change(next, silent_progress()));
      }
    }
  }
  for (const Quarter& quarter : quarters)
    std::printf("%.2f and %.2f ms, %zu KiB resident, %zu KiB on the device\n", 1e3 * quarter.seconds[0],
                1e3 * quarter.seconds[1], quarter.resident >> 10, quarter.on_device >> 10);
  EXPECT_EQ(device()->allocated_bytes(), before) << "all is given back";
  EXPECT_LE(quarters[3].on_device, quarters[1].on_device * 1.01);
  EXPECT_LT(double(quarters[3].resident), 1.05 * double(quarters[1].resident) + 4e6);
  for (std::size_t kind : {0, 1})
    EXPECT_LT(quarters[3].seconds[kind], 1.5 * quarters[1].seconds[kind]) << "frames take longer and longer";
}

}  // namespace
}  // namespace cuticle::plan::soak_gpu_test
