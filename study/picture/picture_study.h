#pragma once
// The ladder from path tracing to the real-time picture: one approximation at a time, what it adds in error to the
// final picture and what it saves in time.
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/progress.h"
#include "gpu/device.h"
#include "plan/frame_runner_gpu.h"
#include "scene/scene.h"
#include "study/engine/study.h"

namespace cuticle::study {

struct LadderRequest {
  std::string name = {};        ///< of the group ("blond")
  scene::Scene scene = {};      ///< its shadow method, tables and passes are those of the last rungs; hair alone is drawn
  std::string hair = {};        ///< physical fibre of both models; empty: the scene's material, and no rung `model`
  std::string truth_model = "chiang", model = "marschner";
  int samples = 256;            ///< paths of a pixel of the truth and of every traced rung
  int truth_coverage = 32;      ///< samples a side of brute-force coverage
  std::set<std::string> without = {};  ///< rungs that are switched off
};

/// A rung: what it changes of the scene of the rung before. Rungs are, in their order: path_tracing, far_field, model,
/// tables, single_scattering, shadow_method, strand_space, dual_scattering, coverage, level_of_detail.
struct Rung {
  std::string name = {}, words = {};
  std::function<Result<void>(scene::Scene&)> apply = {};
};
/// Those that the scene and this build have. Error: usage, for a name in `without` that is no rung; unknown models.
Result<std::vector<Rung>> rungs_of(const LadderRequest& request);

/// One rung's picture: linear, premultiplied; and what it took.
struct RungPicture {
  Rung rung = {};
  scene::Scene scene = {};
  Image color = {};
  std::shared_ptr<plan::FrameRunner> runner = {};  ///< of rungs that a device draws in full: to be timed again
  double seconds = 0, bytes = 0;              ///< of the frame, wall clock; of device memory
};
struct Ladder {
  std::vector<RungPicture> rungs;
  Image again;                   ///< path tracing with another seed: what noise alone changes
  std::vector<int> strands;      ///< of each pixel of the truth: the first strand seen, -1 none
};
/// Draws every rung. Error: what drawing says.
Result<Ladder> climb(std::shared_ptr<gpu::Device> device, const LadderRequest& request, Progress& progress);
/// The same of some of the rungs, the first of which is path tracing.
Result<Ladder> climb(std::shared_ptr<gpu::Device> device, const std::vector<Rung>& rungs, const LadderRequest& request,
                     Progress& progress);

/// Relative squared errors of each pixel that either picture covers: |a - b|^2 over (truth^2 + (mean of the truth)^2),
/// mean of the colours. Their mean over the pixels is the relative MSE.
std::vector<double> squared_errors(const Image& a, const Image& b, const Image& truth);
/// |mean radiance over a strand's pixels - that of the truth| over the mean of the truth, of every strand that is first
/// in four pixels or more; luminance.
std::vector<double> strand_errors(const Image& picture, const Image& truth, const std::vector<int>& strands);

/// Errors that rungs add (against the rung before), that they have (against the truth), and the part of the total that
/// the sum of what they add leaves: twice the products of their steps, which is exact for squared errors.
struct LadderSum {
  std::vector<double> added, against_truth;  ///< relative MSE, one for each rung after the first
  double sum = 0, total = 0, remainder = 0, products = 0, noise = 0;
};
LadderSum sum_of(const Ladder& ladder);

/// The ladder as a group, its table and its pictures.
void add_ladder(Study& study, const std::string& name, const Ladder& ladder);

}  // namespace cuticle::study
