#pragma once
// What drawing hair costs and how far it is from brute force: method x settings, near and far.
#include <memory>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/progress.h"
#include "gpu/device.h"
#include "scene/scene.h"
#include "study/engine/study.h"
#include "study/render/picture_error.h"

namespace cuticle::study {

/// Another scene's hair, for coverage alone.
struct GroomInRender {
  std::string name = {};
  scene::Scene scene = {};
};
struct RenderRequest {
  scene::Scene scene = {};  ///< its first frame, at rest, without head
  int truth_samples = 32;   ///< a side; 16 are off by .01 to .02 where hair is a tenth of a pixel wide
  bool grows = true;        ///< every setting, and what a frame costs as strands, pixels and overlap grow
  int rounds = 5;           ///< of timing
  std::vector<GroomInRender> grooms = {};
};

/// A group for each of two views, as framed and from four times as far: every method and setting against brute force.
/// With `grows`, groups without errors: a frame's time with 1/16 to 4 times the strands, pixels or overlap. Pictures
/// of the methods at their defaults beside the truth, and where coverage is off: missing in red, too much in green,
/// four times as bright. Each of `grooms` adds such views, still and, where its scene simulates it, in the 17th frame
/// of its motion. Error: what drawing says.
Result<Study> render_study(std::shared_ptr<gpu::Device> device, const RenderRequest& request, Progress& progress);

}  // namespace cuticle::study
