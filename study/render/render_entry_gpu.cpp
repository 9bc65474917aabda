#include <algorithm>

#include "plan/plan.h"
#include "study/registry/entries.h"
#include "study/render/render_study.h"

namespace cuticle::study {
namespace {

Result<Study> declare_render(const StudyRequest& request, Progress& progress) {
  const std::string& scene = request.options.at("scene");
  RenderRequest render;
  CUTICLE_ASSIGN(render.scene, scene::load_scene(scene.empty() ? request.share + "/scenes/demo.json" : scene, plan::catalogue()));
  if (request.quick) {
    render.grows = false;
    render.truth_samples = 16;
    render.scene.camera.camera.resolution /= 4;
    render.scene.strand_count = std::min(render.scene.strand_count, 1000);
  }
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = request.device}));
  return render_study(device, render, progress);
}

}  // namespace

const StudyEntry& render_entry() {
  static const StudyEntry entry{.name = "render",
                                .summary = "ways to draw a scene's hair against brute force: error against time",
                                .options = {{"scene", "", "scene file (JSON); without it that of the demo", true}},
                                .declare = declare_render,
                                .quick_seconds = 30,
                                .seconds = 600};
  return entry;
}

}  // namespace cuticle::study
