#pragma once
// The ladder from path tracing to the real-time picture: one approximation at a time, what it adds in error to the
// final picture and what it saves in time.
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/progress.h"
#include "gpu/device.h"
#include "plan/frame_runner_gpu.h"
#include "plan/traced_frame.h"
#include "scene/scene.h"
#include "study/engine/study.h"
#include "study/picture/noisy_pictures.h"
#include "study/picture/pose.h"

namespace cuticle::study {

struct LadderRequest {
  std::string name = {};    ///< of the group ("blond")
  scene::Scene scene = {};  ///< its shadow method, tables and passes are those of the last rungs; hair alone is drawn
  std::string hair = {};    ///< physical fibre of both models; empty: the scene's material, and no rung `model`
  std::string truth_model = "chiang", model = "marschner";
  int samples = 256;                   ///< paths of a pixel of the truth and of every traced rung
  int batches = 8;                     ///< that the paths come in, each with a seed of its own; two at least
  int frame = 16;                      ///< of hair that is simulated: where it is drawn
  int reference_steps = 64;            ///< of a frame: how finely it is simulated up to the rung simulation_steps
  int truth_coverage = 32;             ///< samples a side of brute-force coverage
  std::set<std::string> without = {};  ///< rungs that are switched off
};

/// A rung: what it changes of the scene of the rung before. Rungs are, in their order: path_tracing, far_field, model,
/// tables, single_scattering, shadow_method, strand_space, dual_scattering, coverage, level_of_detail,
/// simulation_steps.
struct Rung {
  std::string name = {}, words = {};
  std::function<Result<void>(scene::Scene&)> apply = {};
};
/// Those that the scene and this build have. Error: usage, for a name in `without` that is no rung; unknown models.
Result<std::vector<Rung>> rungs_of(const LadderRequest& request);

/// One rung's picture, and what it took.
struct RungPicture {
  Rung rung = {};
  scene::Scene scene = {};
  NoisyPicture picture = {};
  std::shared_ptr<Pose> pose = {};                 ///< of the hair
  std::shared_ptr<plan::FrameRunner> runner = {};  ///< of rungs that a device draws in full: to be timed again
  /// Of the frame, of a traced one its paths alone: processor time, or by wall clock on a device; of device memory.
  double seconds = 0, bytes = 0;
};
struct Ladder {
  std::vector<RungPicture> rungs;
  std::vector<int> strands;  ///< of each pixel of the truth: the first strand seen, -1 none
};
/// A model with a physical fibre's parameters. The fibre is round, whatever its aspect: a groom does not say how a flat
/// cross-section is turned, path tracing takes fixed axes and tables one side. Errors: usage, for unknown names and
/// models that take no physical fibre.
Result<scene::Block> model_of_fibre(const std::string& model, const std::string& hair);
/// The hair alone, on nothing, without what is only drawn in real time (tints, ambient light).
scene::Scene hair_of(const scene::Scene& scene);

/// Draws scenes of the same hair, each in its pose.
class Stage {
 public:
  Stage(std::shared_ptr<gpu::Device> device, const LadderRequest& request, Progress& progress)
      : device_(std::move(device)), request_(request), progress_(progress) {}
  /// By the scene's own way of drawing; path tracing comes in the request's batches. Errors: what drawing says.
  Result<RungPicture> draw(const Rung& rung, const scene::Scene& scene);
  /// Of each pixel the first strand that some of its paths see; -1: none.
  Result<std::vector<int>> strands_seen(scene::Scene scene);

 private:
  Result<void> take_pose(const scene::Scene& scene);
  /// A picture for each of the seeds first, first + 1, ...
  Result<std::vector<plan::TracedFrame>> trace_batches(scene::Scene scene, int first, int count);
  Result<void> trace(const scene::Scene& scene, RungPicture& picture);
  Result<void> run(const scene::Scene& scene, RungPicture& picture);
  double now() const;

  std::shared_ptr<gpu::Device> device_;
  const LadderRequest& request_;
  Progress& progress_;
  std::shared_ptr<Pose> pose_;
  scene::SimulationSource simulation_;  ///< that the pose is of
};

/// Draws every rung. Error: what drawing says.
Result<Ladder> climb(std::shared_ptr<gpu::Device> device, const LadderRequest& request, Progress& progress);
/// The same of some of the rungs, the first of which is path tracing.
Result<Ladder> climb(std::shared_ptr<gpu::Device> device, const std::vector<Rung>& rungs, const LadderRequest& request,
                     Progress& progress);

/// Relative squared errors (RelativeSquares) that rungs add, against the rung before; that they have, against the
/// truth; and the part of the total that the sum of what they add leaves: twice the products of their steps, which is
/// exact for squares. All without what noise adds; `noise` is what other seeds change of the truth.
struct LadderSum {
  std::vector<double> added, against_truth;  ///< one for each rung after the first
  double sum = 0, total = 0, remainder = 0, products = 0, noise = 0;
};
LadderSum sum_of(const Ladder& ladder);

/// The ladder as a group, its table and its pictures.
void add_ladder(Study& study, const std::string& name, const Ladder& ladder);

}  // namespace cuticle::study
