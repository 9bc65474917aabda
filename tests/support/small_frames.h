#pragma once
// Frames of small scenes, made of parts of a scene file.
#include "plan/frame_runner_gpu.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "plan/plan.h"

namespace cuticle::tests {

inline constexpr std::string_view k_light = R"("lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}])";
inline constexpr std::string_view k_shadow =
    R"("shadow": {"method": {"opacity_map": {"resolution": 64}}, "fibre_alpha": 0.4})";
inline constexpr std::string_view k_simulation =
    R"("simulation": {"solver": {"classic": {}}, "effects": {"gravity": {}}})";
inline constexpr std::string_view k_colliders = R"("colliders": {"head": true})";
inline constexpr std::string_view k_tiles = R"("render": {"method": "tiles"})";
inline constexpr std::string_view k_lines = R"("render": {"method": "lines"})";
inline constexpr std::string_view k_cards = R"("render": {"method": "cards"})";
inline constexpr std::string_view k_quads = R"("render": {"method": "quads"})";
inline constexpr std::string_view k_supersampled = R"("render": {"method": "supersampled"})";
inline constexpr std::string_view k_velocity = R"("passes": {"velocity": {}})";
inline constexpr std::string_view k_points = R"("passes": {"shade_strands": {"point_px": 8}})";
inline constexpr std::string_view k_surfaces = R"("passes": {"surface_shadow": {"resolution": 128}})";
inline constexpr std::string_view k_motion = R"("motion": {"bvh": "motion/head_turn.bvh"})";

/// What a scene has unless a part of the same key is given.
inline constexpr std::string_view k_usual_parts[] = {
    R"("strand_count": 500)", R"("strand_vertices": 12)", R"("material": {"lut_size": 32, "layout": "nalu"})",
    R"("camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 30, "resolution_px": [64, 64]})"};

inline bool names_key_of(std::initializer_list<std::string_view> parts, std::string_view usual) {
  const std::string_view key = usual.substr(0, usual.find(':') + 1);
  return std::ranges::any_of(parts, [&](std::string_view part) { return part.find(key) != part.npos; });
}

inline scene::Scene scene_of(std::initializer_list<std::string_view> parts) {
  std::string text = R"({"schema_version": 1)";
  for (std::string_view usual : k_usual_parts)
    if (!names_key_of(parts, usual)) text += ", " + std::string(usual);
  for (std::string_view part : parts) text += ", " + std::string(part);
  const auto scene = scene::parse_scene(text + "}", CUTICLE_SOURCE_DIR "/scenes", "test", plan::catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  return *scene;
}

inline std::unique_ptr<plan::FrameRunner> runner(std::initializer_list<std::string_view> parts) {
  auto made = plan::FrameRunner::create(device(), scene_of(parts), silent_progress());
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return std::move(*made);
}

inline plan::FrameResult frame_of(plan::FrameRunner& runner, int frame) {
  auto result = runner.run(frame, {.render = true, .read_state = true});
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return std::move(*result);
}

inline constexpr int k_depth = 4, k_strand = 8, k_velocity_x = 13, k_speed_x = 15;  // channels of FrameResult::aovs

}  // namespace cuticle::tests
