#include "python/scene_frames.h"

#include <fmt/format.h>

#include "plan/drawn_strands.h"
#include "plan/plan.h"
#include "plan/traced_scene_runner.h"
#ifdef CUTICLE_HAS_GPU
#include "plan/frame_runner_gpu.h"
#endif

namespace cuticle::python {
namespace {

class TracedFrames final : public Frames {
 public:
  explicit TracedFrames(std::unique_ptr<plan::TracedSceneRunner> runner) : runner_(std::move(runner)) {}
  Result<PaintedFrame> run(int frame, Progress& progress) override {
    CUTICLE_ASSIGN(plan::TracedFrame traced, runner_->run(frame, progress));
    return PaintedFrame{std::move(traced.color), std::move(traced.layers), std::move(traced.shares), {traced.note}};
  }
  Result<strands::Groom> strands() override { return runner_->drawn_strands(); }
  std::string plan() const override { return plan::to_json(runner_->plan()); }
  std::string device() const override { return "cpu"; }

 private:
  std::unique_ptr<plan::TracedSceneRunner> runner_;
};

#ifdef CUTICLE_HAS_GPU
class DeviceFrames final : public Frames {
 public:
  DeviceFrames(std::string device, std::unique_ptr<plan::FrameRunner> runner)
      : device_(std::move(device)), runner_(std::move(runner)) {}
  Result<PaintedFrame> run(int frame, Progress& progress) override {
    progress.update("frame", 0, 1);
    CUTICLE_ASSIGN(plan::FrameResult done, runner_->run(frame, {.progress = &progress}));
    return PaintedFrame{std::move(done.color), std::move(done.aovs), std::move(done.shares), std::move(done.notes)};
  }
  Result<strands::Groom> strands() override { return runner_->drawn_strands(); }
  std::string plan() const override { return plan::to_json(runner_->plan()); }
  std::string device() const override { return device_; }

 private:
  std::string device_;
  std::unique_ptr<plan::FrameRunner> runner_;
};

Result<std::unique_ptr<Frames>> open_on_device(const scene::Scene& scene, const std::string& choice,
                                               Progress& progress) {
  CUTICLE_ASSIGN(std::shared_ptr<gpu::Device> device, gpu::Device::open({.choice = choice}));
  const std::string name = device->info().name;
  CUTICLE_ASSIGN(auto runner, plan::FrameRunner::create(std::move(device), scene, progress));
  return std::unique_ptr<Frames>(std::make_unique<DeviceFrames>(name, std::move(runner)));
}
#else
Result<std::unique_ptr<Frames>> open_on_device(const scene::Scene& scene, const std::string&, Progress&) {
  return Error{ErrorKind::no_device,
               fmt::format("'{}' is drawn by Vulkan ('{}'), and this build has none", scene.name, scene.render_method),
               "build where Vulkan's headers and glslang are installed, or choose the method 'reference'"};
}
#endif

}  // namespace

Result<scene::Scene> parse_scene(const std::string& json, const std::string& folder) {
  return scene::parse_scene(json, folder, "scene", plan::catalogue());
}

Result<std::string> plan_of(const scene::Scene& scene) {
  CUTICLE_ASSIGN(const plan::StrandSet set, plan::build_strand_set(scene));
  return plan::to_json(plan::make_plan(scene, plan::shape_of(scene, set)));
}

Result<HairAtRest> hair_at_rest(const scene::Scene& scene) {
  CUTICLE_ASSIGN(plan::StrandSet set, plan::build_strand_set(scene));
  HairAtRest hair;
  hair.drawn = plan::drawn_strands_at(scene, set, set.control.positions, glm::dmat3(1));
  hair.control = std::move(set.control);
  hair.head = std::move(set.head);
  hair.spheres = std::move(set.colliders);
  hair.notes = std::move(set.notes);
  return hair;
}

Result<std::unique_ptr<Frames>> open_frames(const scene::Scene& scene, const std::string& device, Progress& progress) {
  if (!scene.outputs.color) return bad_input("scene: outputs.color = false leaves nothing to render");
  const bool on_cpu = scene.render_method == "reference" && device.empty() && !scene.character && !scene.fins;
  if (!on_cpu) return open_on_device(scene, device, progress);
  CUTICLE_ASSIGN(auto runner, plan::TracedSceneRunner::create(scene, progress));
  return std::unique_ptr<Frames>(std::make_unique<TracedFrames>(std::move(runner)));
}

}  // namespace cuticle::python
