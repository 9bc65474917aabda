// Draws the rungs.
#include <chrono>
#include <ctime>
#include <numeric>

#include <fmt/core.h>

#include "study/picture/picture_study.h"

namespace cuticle::study {
namespace {

/// Channels of a layered picture by name; -1: none.
int channel(const Image& image, std::string_view name) {
  for (int c = 0; c < image.channels(); ++c)
    if (image.channel_names[std::size_t(c)] == name) return c;
  return -1;
}

std::vector<int> first_strands(const Image& layers) {
  const int id = channel(layers, "strand.id"), covered = channel(layers, "coverage.Y");
  std::vector<int> strands;
  for (int y = 0; y < layers.height; ++y)
    for (int x = 0; x < layers.width; ++x)
      strands.push_back(id >= 0 && covered >= 0 && layers.at(x, y, covered) > 0 ? int(layers.at(x, y, id)) : -1);
  return strands;
}

}  // namespace

scene::Scene hair_of(const scene::Scene& scene) {
  scene::Scene hair = scene;
  hair.head.present = false;
  hair.floor.reset();
  hair.passes.erase("resolve");
  hair.passes.erase("surface_shadow");
  return hair;
}

Result<RungPicture> Stage::draw(const Rung& rung, const scene::Scene& scene) {
  RungPicture picture{.rung = rung, .scene = scene};
  CUTICLE_TRY(take_pose(scene));
  picture.pose = pose_;
  CUTICLE_TRY(scene.render_method == "reference" ? trace(scene, picture) : run(scene, picture));
  return picture;
}

Result<std::vector<int>> Stage::strands_seen(scene::Scene scene) {
  scene.outputs.aovs = true;
  scene.passes.at("reference").set("bounces", std::int64_t(1));
  CUTICLE_ASSIGN(const std::vector<plan::TracedFrame> layered, trace_batches(scene, 0, 1));
  return first_strands(layered.front().layers);
}

Result<void> Stage::take_pose(const scene::Scene& scene) {
  if (pose_ && simulation_ == scene.simulation) return {};
  CUTICLE_ASSIGN(pose_, Pose::make(device_, scene, request_.frame, progress_));
  simulation_ = scene.simulation;
  return {};
}

Result<std::vector<plan::TracedFrame>> Stage::trace_batches(scene::Scene scene, int first, int count) {
  scene.passes.at("reference").set("samples", std::int64_t(std::max(1, request_.samples / request_.batches)));
  std::vector<std::uint64_t> seeds(static_cast<std::size_t>(count));
  std::iota(seeds.begin(), seeds.end(), std::uint64_t(first));
  return plan::trace_frames(pose_->at_rest(scene), {}, {.hair = pose_->drawn()}, pose_->camera(), seeds, progress_);
}

Result<void> Stage::trace(const scene::Scene& scene, RungPicture& picture) {
  CUTICLE_ASSIGN(auto frames, trace_batches(scene, 0, request_.batches));
  for (plan::TracedFrame& frame : frames) {
    picture.seconds += device_->info().is_software ? frame.processor_seconds : frame.seconds;
    picture.picture.batches.push_back(std::move(frame.color));
  }
  return {};
}

Result<void> Stage::run(const scene::Scene& scene, RungPicture& picture) {
  const std::size_t before = device_->allocated_bytes();
  CUTICLE_ASSIGN(auto runner, plan::FrameRunner::create(device_, pose_->at_rest(scene), progress_));
  const double start = now();
  CUTICLE_ASSIGN(plan::FrameResult frame, runner->run(0));
  picture.seconds = now() - start;
  picture.picture.batches.push_back(std::move(frame.color));
  picture.bytes = double(device_->allocated_bytes() - before);
  if (scene.render_method != "supersampled") picture.runner = std::move(runner);
  return {};
}

/// Seconds of the clock that the study's times are of.
double Stage::now() const {
  if (device_->info().is_software) return double(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Result<Ladder> climb(std::shared_ptr<gpu::Device> device, const LadderRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const std::vector<Rung> rungs, rungs_of(request));
  return climb(std::move(device), rungs, request, progress);
}

Result<Ladder> climb(std::shared_ptr<gpu::Device> device, const std::vector<Rung>& rungs, const LadderRequest& request,
                     Progress& progress) {
  Ladder ladder;
  Stage stage(std::move(device), request, progress);
  scene::Scene scene = hair_of(request.scene);
  std::size_t done = 0;
  for (const Rung& rung : rungs) {
    progress.update(fmt::format("rungs of {}", request.name), done++, rungs.size());
    if (!request.without.contains(rung.name)) CUTICLE_TRY(rung.apply(scene));
    CUTICLE_ASSIGN(ladder.rungs.emplace_back(), stage.draw(rung, scene));
    if (ladder.rungs.size() > 1 || rungs.size() <= 3) continue;
    CUTICLE_ASSIGN(ladder.strands, stage.strands_seen(scene));
  }
  progress.update(fmt::format("rungs of {}", request.name), done, rungs.size());
  return ladder;
}

}  // namespace cuticle::study
