// A camera moved by hand, and a session without its window.
#include "gpu/tests/test_device.h"
#include "play/session.h"

#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace cuticle::play::play_test {
namespace {

using registry::EntryKind;

scene::Scene small_scene() {
  const auto scene = scene::parse_scene(R"({"schema_version": 1, "strand_count": 300, "strand_vertices": 8,
    "material": {"lut_size": 16}, "lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}],
    "simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}, "wind": {}}},
    "motion": {"bvh": "motion/head_turn.bvh"},
    "camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 30, "resolution_px": [48, 48]}})",
                                        CUTICLE_SOURCE_DIR "/scenes", "test", plan::catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  return *scene;
}

using tests::device;

std::unique_ptr<Session> session(int frames = 10, int first = 0) {
  auto made = Session::create(device(), small_scene(), FrameRange{first, first + frames - 1}, silent_progress());
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return std::move(*made);
}

bool advanced(Session& session, const Actions& actions = {}) {
  const Result<bool> done = session.advance(actions);
  EXPECT_TRUE(done) << (done ? "" : done.error().message);
  return done && *done;
}

/// What `render` makes of the scene as it stands in the session, at the session's frame.
std::vector<float> rendered(const Session& session) {
  const auto runner = plan::FrameRunner::create(device(), session.scene(), silent_progress());
  return (*runner)->run(session.frame())->color.pixels;
}

TEST(CameraMove, AQuarterTurn_CirclesTheTarget) {
  const Camera camera{.position = {0, 0, 2}};
  const Camera after = moved(camera, {.turn = {0.5 * std::numbers::pi, 0}});
  EXPECT_LT(glm::distance(after.position, glm::dvec3(-2, 0, 0)), 1e-12);
  EXPECT_EQ(after.target, camera.target);
}

TEST(CameraMove, OverThePole_StopsBeforeIt) {
  const Camera after = moved({.position = {0, 0, 2}}, {.turn = {0, 10}});
  EXPECT_NEAR(glm::normalize(after.position).y, std::sin(89 * std::numbers::pi / 180), 1e-12);
}

TEST(CameraMove, OfAWholeHeight_ShiftsTheTargetByWhatIsSeen) {
  const Camera camera{.position = {0, 0, 2}, .vertical_field_of_view = 0.5 * std::numbers::pi};
  const Camera after = moved(camera, {.shift = {0, 1}});
  EXPECT_LT(glm::distance(after.target, glm::dvec3(0, 4, 0)), 1e-12);
}

TEST(CameraMove, AnyDistance_StaysBetweenThePlanes) {
  const Camera camera{.position = {0, 0, 1}};
  EXPECT_NEAR(moved(camera, {.distance = 1e-9}).position.z, 2 * camera.near_plane, 1e-12);
  EXPECT_NEAR(moved(camera, {.distance = 1e9}).position.z, 0.5 * camera.far_plane, 1e-9);
  EXPECT_EQ(moved(camera, {.distance = std::numeric_limits<double>::quiet_NaN()}), camera);
}

TEST(Session, Frames_GoOnAndBeginAnew) {
  const auto played = session(2);
  for (const int expected : {0, 1, 0, 1}) {
    EXPECT_TRUE(advanced(*played));
    EXPECT_EQ(played->frame(), expected);
  }
}

TEST(Session, Paused_DrawsNothingUntilStepped) {
  const auto played = session();
  EXPECT_TRUE(advanced(*played));
  EXPECT_FALSE(advanced(*played, {.toggle_pause = true}));
  EXPECT_FALSE(advanced(*played));
  EXPECT_TRUE(advanced(*played, {.step = true}));
  EXPECT_EQ(played->frame(), 1);
  EXPECT_TRUE(advanced(*played, {.restart = true}));
  EXPECT_EQ(played->frame(), 0);
}

TEST(Session, AfterChanges_ShowsWhatRenderMakesOfThem) {
  const auto played = session();
  for (int k = 0; k < 3; ++k) advanced(*played);
  advanced(*played, {.toggle_pause = true});
  const std::vector<float> before = played->shown().color.pixels;
  const std::vector<Actions> steps = {
      {.camera = {.turn = {0.3, 0.1}}},
      {.changes = {{EntryKind::model, "marschner", "sigma_a", glm::dvec3(3, 4, 5)}}},
      {.changes = {{EntryKind::effect, "wind", "velocity", glm::dvec3(8, 0, 0)}}},
      {.changes = {{EntryKind::effect, "exact", "damping", 9.0}}},
      {.method = "tiles"},
  };
  std::vector<float> last = before;
  for (const Actions& step : steps) {
    ASSERT_TRUE(advanced(*played, step));
    EXPECT_NE(played->shown().color.pixels, last);
    EXPECT_EQ(played->shown().color.pixels, rendered(*played));
    last = played->shown().color.pixels;
  }
}

TEST(Session, WhatCannotBe_IsRefusedAndChangesNothing) {
  const auto played = session();
  advanced(*played);
  const std::vector<Actions> wrong = {
      {.method = "oils"},
      {.changes = {{EntryKind::model, "marschner", "eta", 0.5}}},
      {.changes = {{EntryKind::model, "marschner", "shine", 0.5}}},
      {.changes = {{EntryKind::effect, "water", "density", 1000.0}}},
  };
  const std::vector<float> before = rendered(*played);
  for (const Actions& actions : wrong) {
    const Result<bool> done = played->advance(actions);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, ErrorKind::usage);
  }
  EXPECT_EQ(rendered(*played), before);
  EXPECT_TRUE(advanced(*played));
}

}  // namespace
}  // namespace cuticle::play::play_test
