// More drawn vertices than a storage buffer holds: they are written in parts, and nobody can tell from the picture.
#include "tests/support/small_frames.h"

#include <string>

#include <fmt/core.h>

namespace cuticle::plan::many_vertices_gpu_test {
namespace {

using namespace tests;

// 20,000 strands of 12 vertices: 3.8 MB of places, 1.9 MB of colours, 1 MB of what a light leaves.
constexpr std::uint32_t k_binding = 1200 * 1000;
constexpr std::string_view k_many = R"("strand_count": 20000)",
                           k_near = R"("camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0.06, 0.05, 0],
                                       "fov_deg": 2, "resolution_px": [48, 48]})",
                           k_small_map = R"("shadow": {"method": {"opacity_map": {"resolution": 64, "slices": 4}}})";

std::shared_ptr<gpu::Device> small_device() {
  auto made = gpu::Device::open({.choice = {}, .most_storage_bytes = k_binding});
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return *made;
}

struct Way {
  std::string name;
  std::string parts;                  ///< of the scene
  std::vector<std::string> in_parts;  ///< passes that a small device dispatches more often
  bool of_a_file = false;             ///< strands of a file, drawn as they are given
};
class ManyVertices : public testing::TestWithParam<Way> {};

/// The groom of a scene, written now.
std::string groom_of_a_file() {
  const std::string path = testing::TempDir() + "/many_vertices.txt";
  std::FILE* const file = std::fopen(path.c_str(), "w");
  for (int strand = 0; strand < 20000; ++strand) {
    for (int k = 0; k < 12; ++k)
      fmt::print(file, "{} {} {} 4e-5\n", -0.14 + 1e-4 * (strand % 4000), 0.08 - 0.006 * k,
                 1e-3 * (strand / 4000) + 1e-4 * k);
    fmt::print(file, "\n");
  }
  std::fclose(file);
  return fmt::format(R"("groom": {{"file": "{}", "metres_per_unit": 1}})", path);
}

FrameResult drawn_by(const std::shared_ptr<gpu::Device>& on, const Way& way, Plan& plan) {
  const std::string parts = way.of_a_file ? way.parts + ", " + groom_of_a_file() : way.parts;
  auto made =
      FrameRunner::create(on, scene_of({k_light, k_small_map, k_many, k_near, k_motion, parts}), silent_progress());
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  plan = (*made)->plan();
  frame_of(**made, 0);  // which finds how much room its lists need
  return frame_of(**made, 1);
}

std::uint32_t dispatched(const FrameResult& frame, std::string_view pass) {
  const auto found = std::ranges::find(frame.cost.passes, pass, &gpu::PassCost::name);
  return found == frame.cost.passes.end() ? 0 : found->dispatches;
}

TEST_P(ManyVertices, PastAStorageBuffer_GiveTheSamePicture) {
  Plan plan, whole_plan;
  const FrameResult parts = drawn_by(small_device(), GetParam(), plan),
                    whole = drawn_by(device(), GetParam(), whole_plan);
  EXPECT_TRUE(parts.color.pixels == whole.color.pixels);
  EXPECT_TRUE(parts.aovs.pixels == whole.aovs.pixels);
  EXPECT_EQ(parts.notes, whole.notes);
  EXPECT_GT(std::ranges::count_if(whole.color.pixels, [](float value) { return value > 0.01f; }), 1000) << "hair";
  for (const std::string& pass : GetParam().in_parts) {
    EXPECT_GT(dispatched(parts, pass), dispatched(whole, pass)) << pass;
    const PlannedPass* const planned = find_pass(plan, pass);
    EXPECT_EQ(planned ? planned->dispatches : 0, dispatched(parts, pass)) << pass << ", as planned";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ways, ManyVertices,
    testing::Values(Way{"tiles", R"("render": {"method": "tiles"})", {"interpolate_strands", "shade_strands", "tiles"}},
                    Way{"points",
                        R"("render": {"method": "tiles"}, "passes": {"shade_strands": {"point_px": 300}})",
                        {"interpolate_strands", "shade_strands", "tiles"}},
                    Way{"lines",
                        R"("render": {"method": "lines"}, "passes": {"velocity": {}})",
                        {"interpolate_strands", "interpolate_velocities"}},
                    Way{"quads",
                        R"("render": {"method": "quads"}, "passes": {"surface_shadow": {"resolution": 128}})",
                        {"interpolate_strands"}},
                    Way{"as_given",
                        R"("render": {"method": "tiles"}, "passes": {"velocity": {}})",
                        {"place_strands", "place_velocities", "shade_strands", "tiles"},
                        true}),
    [](const auto& tested) { return tested.param.name; });

TEST(ManyVertices, OfWhichALightsShareFillsABuffer_AreRefusedNamingTheLimit) {
  const auto made = FrameRunner::create(
      small_device(), scene_of({k_light, R"("strand_count": 26000)", k_near, R"("render": {"method": "tiles"})"}),
      silent_progress());
  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().message.find("300000 vertices"), std::string::npos) << made.error().message;
}

}  // namespace
}  // namespace cuticle::plan::many_vertices_gpu_test
