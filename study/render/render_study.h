#pragma once
// What drawing hair costs and how far it is from brute force: method x settings, near and far.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/image/image.h"
#include "core/progress.h"
#include "gpu/device.h"
#include "scene/scene.h"
#include "study/render/picture_error.h"

namespace cuticle::study {

struct RenderRow {
  std::string view, method, settings;
  PictureError error;
  double ms = 0;          ///< of a frame without simulation, wall clock, the best of the repeats
  std::size_t bytes = 0;  ///< of device memory that the scene took
};

struct RenderRequest {
  scene::Scene scene;  ///< its first frame, at rest, without head
  int repeats = 3;
  int truth_samples = 32;  ///< a side; 16 are off by .01 to .02 where hair is a tenth of a pixel wide
  bool grows = true;       ///< every setting, and what a frame costs as strands, pixels and overlap grow
};

struct RenderView {
  std::string name;
  std::vector<std::string> titles;
  std::vector<Image> pictures;  ///< the truth, then the methods at their defaults, then how far these are off
};

/// A frame's cost with one size of the scene (strands, pixels, overlap) so many times as large.
struct GrowthRow {
  std::string size, method;
  double factor = 1, ms = 0;
};

/// The row of a view that takes least time among those whose error of coverage is at most so large; null: none is.
const RenderRow* cheapest(const std::vector<RenderRow>& rows, std::string_view view, double error);

struct RenderStudy {
  std::vector<RenderRow> rows;
  std::vector<GrowthRow> growth;
  std::vector<RenderView> views;
  std::string device, scene;
  int truth_samples = 0;  ///< a side of a pixel
};

/// Draws the scene as framed and from four times as far, by every method and setting.
Result<RenderStudy> run_render_study(std::shared_ptr<gpu::Device> device, const RenderRequest& request,
                                     Progress& progress);

std::string to_csv(const RenderStudy& study);
/// Writes demo.json with the pictures of each view, and study/study.json, study/study.csv and study/growth.csv
/// (study/README.md).
Result<void> write_render_study(const RenderStudy& study, const std::string& folder);

}  // namespace cuticle::study
