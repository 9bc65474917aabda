// How hair moves, as its pixels say: motion vectors by the grid, and the velocities that the solver hands over.
#include "tests/support/small_frames.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>

#include "plan/camera_path.h"
#include "plan/head_path.h"
#include "plan/strand_set.h"

namespace cuticle::plan::frame_motion_gpu_test {
namespace {

using namespace tests;

/// What a pixel sees of the hair, in the world.
glm::dvec3 seen_point(const Image& layers, const Camera& camera, int x, int y) {
  const glm::dvec4 at_depth = projection_matrix(camera) * glm::dvec4(0, 0, -layers.at(x, y, k_depth), 1);
  const glm::dvec2 on_screen = 2.0 * (glm::dvec2(x, y) + 0.5) / glm::dvec2(layers.width, layers.height) - 1.0;
  return glm::inverse(projection_matrix(camera) * view_matrix(camera)) *
         glm::dvec4(on_screen * at_depth.w, at_depth.z, at_depth.w);
}

/// What the motion vectors of a frame are off, over how long they should be, where the hair was carried from `before`
/// to where it is: both summed over the pixels that see hair.
struct VectorError {
  double off = 0, length = 0;
};
VectorError vector_error(const Image& layers, const Camera& now, const Camera& then, const glm::dmat4& before) {
  const glm::dmat4 to_clip_then = projection_matrix(then) * view_matrix(then) * before;
  const glm::dvec2 size(layers.width, layers.height);
  VectorError error;
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x) {
      if (layers.at(x, y, k_strand) == 0) continue;
      const glm::dvec4 clip = to_clip_then * glm::dvec4(seen_point(layers, now, x, y), 1);
      const glm::dvec2 moved = glm::dvec2(x, y) + 0.5 - (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size;
      const glm::dvec2 given(layers.at(x, y, k_velocity_x), layers.at(x, y, k_velocity_x + 1));
      error.off += glm::length(given - moved);
      error.length += glm::length(moved);
    }
  return error;
}

// F8. Measured: 2.6 % of the motion.
TEST(FrameMotion, MotionVectorsOfAHeadThatTurns_AreThoseOfItsRigidMotion) {
  const scene::Scene scene = scene_of({k_tiles, k_motion, k_velocity});
  const HeadPath path = *HeadPath::create(scene, build_strand_set(scene)->pivot);
  const auto made = runner({k_tiles, k_motion, k_velocity});
  for (int frame : {11, 12}) {
    const Camera& camera = scene.camera.camera;
    const VectorError error =
        vector_error(frame_of(*made, frame).aovs, camera, camera, path.at(frame - 1) * glm::inverse(path.at(frame)));
    std::printf("frame %d: %.2f of %.2f pixels\n", frame, error.off, error.length);
    EXPECT_GT(error.length, 50);
    EXPECT_LT(error.off, 0.04 * error.length);
  }
}

TEST(FrameMotion, MotionVectorsOfHairThatStands_AreThoseOfTheCamera) {
  constexpr std::string_view turning = R"("camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0],
    "fov_deg": 30, "resolution_px": [64, 64], "turntable_deg_per_frame": 5})";
  const scene::Scene scene = scene_of({k_quads, k_velocity, turning});
  const VectorError error =
      vector_error(frame_of(*runner({k_quads, k_velocity, turning}), 3).aovs, camera_at(scene.camera, {}, {.frame = 3}),
                   camera_at(scene.camera, {}, {.frame = 2}), glm::dmat4(1));
  EXPECT_GT(error.length, 50);
  EXPECT_LT(error.off, 1e-3 * error.length);
}

/// The vertex of a strand that is nearest to a point.
std::size_t nearest_vertex(const strands::Groom& groom, std::size_t strand, const glm::dvec3& point) {
  std::size_t nearest = groom.offsets[strand];
  for (std::size_t v = nearest; v < groom.offsets[strand + 1]; ++v)
    if (glm::distance(glm::dvec3(groom.positions[v]), point) <
        glm::distance(glm::dvec3(groom.positions[nearest]), point))
      nearest = v;
  return nearest;
}

// F2: from the solver's own velocities, which are those of its last substep, a quarter of the frame. Measured: off by 6
// % of their length.
TEST(FrameMotion, VelocitiesOfSimulatedHair_AreThoseOfItsDrawnVertices) {
  const auto made = runner({k_tiles, k_simulation, k_motion, k_velocity});
  frame_of(*made, 11);
  const strands::Groom before = *made->drawn_strands();
  const Image layers = frame_of(*made, 12).aovs;
  const strands::Groom now = *made->drawn_strands();
  double off = 0, length = 0;
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x) {
      if (layers.at(x, y, k_strand) == 0) continue;
      const std::size_t vertex =
          nearest_vertex(now, std::size_t(layers.at(x, y, k_strand)) - 1, seen_point(layers, made->camera(12), x, y));
      const glm::dvec3 moved = 30.0 * glm::dvec3(now.positions[vertex] - before.positions[vertex]);
      const glm::dvec3 given(layers.at(x, y, k_speed_x), layers.at(x, y, k_speed_x + 1),
                             layers.at(x, y, k_speed_x + 2));
      off += glm::distance(given, moved);
      length += glm::length(moved);
    }
  std::printf("velocities off by %.3f of their length\n", off / length);
  EXPECT_GT(length, 10);
  EXPECT_LT(off, 0.09 * length);
}

}  // namespace
}  // namespace cuticle::plan::frame_motion_gpu_test
