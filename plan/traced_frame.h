#pragma once
// A frame of the method 'reference', drawn by paths on the CPU.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/image/deep.h"
#include "core/progress.h"
#include "plan/strand_set.h"

namespace cuticle::plan {

struct TracedFrame {
  Image color, layers;            ///< the colour over the scene's background; layers as render/reference has them
  std::vector<SeenShare> shares;  ///< with object 0 for the rest, where the scene asks for deep pictures or mattes
  std::string note;               ///< samples, error and time, in words
  /// Of the paths; what is made ready before (ray tree, tables, shadow maps) is left out.
  double seconds = 0, processor_seconds = 0;
};

/// Where things were in the frame before, world.
struct PlacesBefore {
  std::vector<glm::vec3> hair;  ///< vertices of the drawn strands
  Camera camera;
  glm::dmat4 head{1};                      ///< from rest
  std::optional<strands::Mesh> skin = {};  ///< a character's
  std::optional<strands::Mesh> fins = {};
};

/// Where things are in the frame, world.
struct TracedPlaces {
  strands::Groom hair = {};                 ///< drawn strands
  std::optional<PlacesBefore> before = {};  ///< for an open shutter; absent: all stands still
  glm::dmat4 head{1};                       ///< from rest
  std::optional<strands::Mesh> skin = {};   ///< a character's, as it is deformed: in place of the set's head
  const strands::Mesh* fins = nullptr;
};

/// Whether a frame shows the mean over a time: `passes.motion_blur` has a shutter above 0, and by the plan's facts
/// something moves. Hair, surfaces and camera then go on evenly as they moved since the frame before, half of the
/// shutter before the frame's time and half behind. In frame 0, which none precedes, they stand. Lights do not move in
/// scenes.
bool has_open_shutter(const scene::Scene& scene, const registry::Facts& facts);

/// `state`: file of the sums; empty: none. Head, floor and fins are diffuse, by the albedos of their passes. Errors:
/// usage, where the build has no Embree; those of render::reference::trace_picture.
Result<TracedFrame> trace_frame(const scene::Scene& scene, const StrandSet& set, TracedPlaces places,
                                const Camera& camera, const std::string& state, Progress& progress);

/// The same picture with each of these seeds in turn; the scene is made ready once. Errors: those of
/// trace_frame.
Result<std::vector<TracedFrame>> trace_frames(const scene::Scene& scene, const StrandSet& set, TracedPlaces places,
                                              const Camera& camera, std::span<const std::uint64_t> seeds,
                                              Progress& progress);

}  // namespace cuticle::plan
