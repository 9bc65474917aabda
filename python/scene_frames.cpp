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
  TracedFrames(const scene::Scene& scene, std::unique_ptr<plan::TracedSceneRunner> runner)
      : resolution_(scene.camera.camera.resolution), runner_(std::move(runner)) {}
  Result<PaintedFrame> run(int frame, Progress& progress) override {
    CUTICLE_ASSIGN(plan::TracedFrame traced, runner_->run(frame, progress));
    return PaintedFrame{std::move(traced.color), std::move(traced.layers), std::move(traced.shares), {traced.note}};
  }
  Result<void> change(const scene::Scene&, const std::vector<std::string>&, Progress&) override {
    return usage_error("a scene that the reference traces on the CPU does not change", "open another Renderer");
  }
  glm::ivec2 resolution() const override { return resolution_; }
  Result<strands::Groom> strands() override { return runner_->drawn_strands(); }
  std::string plan() const override { return plan::to_json(runner_->plan()); }
  std::string device() const override { return "cpu"; }

 private:
  glm::ivec2 resolution_;
  std::unique_ptr<plan::TracedSceneRunner> runner_;
};

#ifdef CUTICLE_HAS_GPU
void take_block(std::string_view block, const scene::Scene& given, scene::Scene& scene) {
  if (block == "camera") scene.camera = given.camera;
  if (block == "material") scene.material = given.material;
  if (block == "passes") scene.passes = given.passes;
  if (block == "render") scene.render_method = given.render_method;
  if (block == "simulation") scene.simulation = given.simulation;
  if (block != "shadow") return;
  scene.shadow = given.shadow;
  scene.fibre_alpha = given.fibre_alpha;
  scene.caster_share = given.caster_share;
}

class DeviceFrames final : public Frames {
 public:
  DeviceFrames(std::string device, scene::Scene scene, std::unique_ptr<plan::FrameRunner> runner)
      : device_(std::move(device)), scene_(std::move(scene)), runner_(std::move(runner)) {}
  Result<PaintedFrame> run(int frame, Progress& progress) override {
    progress.update("frame", 0, 1);
    CUTICLE_ASSIGN(plan::FrameResult done, runner_->run(frame, {.progress = &progress}));
    return PaintedFrame{std::move(done.color), std::move(done.aovs), std::move(done.shares), std::move(done.notes)};
  }
  Result<void> change(const scene::Scene& given, const std::vector<std::string>& blocks, Progress& progress) override {
    scene::Scene next = scene_;
    for (const std::string& block : blocks) take_block(block, given, next);
    CUTICLE_TRY(runner_->change(next, progress));
    scene_ = std::move(next);
    return {};
  }
  glm::ivec2 resolution() const override { return scene_.camera.camera.resolution; }
  Result<strands::Groom> strands() override { return runner_->drawn_strands(); }
  std::string plan() const override { return plan::to_json(runner_->plan()); }
  std::string device() const override { return device_; }

 private:
  std::string device_;
  scene::Scene scene_;
  std::unique_ptr<plan::FrameRunner> runner_;
};

Result<std::unique_ptr<Frames>> open_on_device(const scene::Scene& scene, const std::string& choice,
                                               Progress& progress) {
  CUTICLE_ASSIGN(std::shared_ptr<gpu::Device> device, gpu::Device::open({.choice = choice}));
  const std::string name = device->info().name;
  CUTICLE_ASSIGN(auto runner, plan::FrameRunner::create(std::move(device), scene, progress));
  return std::unique_ptr<Frames>(std::make_unique<DeviceFrames>(name, scene, std::move(runner)));
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
  return std::unique_ptr<Frames>(std::make_unique<TracedFrames>(scene, std::move(runner)));
}

}  // namespace cuticle::python
