#include <algorithm>

#include <fmt/core.h>

#include "plan/plan.h"
#include "study/engine/split.h"
#include "study/registry/entries.h"
#include "study/render/render_study.h"

namespace cuticle::study {
namespace {

Result<Study> declare_render(const StudyRequest& request, Progress& progress) {
  const std::string& scene = request.options.at("scene");
  RenderRequest render;
  const std::string usual = request.share + (request.quick ? "/scenes/still.json" : "/scenes/ladder/blond.json");
  CUTICLE_ASSIGN(render.scene, scene::load_scene(scene.empty() ? usual : scene, plan::catalogue()));
  for (const std::string& name : split_commas(request.options.at("grooms"))) {
    if (request.quick) break;
    CUTICLE_ASSIGN(scene::Scene groom,
                   scene::load_scene(fmt::format("{}/scenes/ladder/{}.json", request.share, name), plan::catalogue()));
    render.grooms.push_back({name, std::move(groom)});
  }
  if (request.quick) {
    render.grows = false;
    render.rounds = 1;  // the only frame that is timed
  }
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = request.device}));
  return render_study(device, render, progress);
}

}  // namespace

const StudyEntry& render_entry() {
  static const StudyEntry entry{
      .name = "render",
      .summary = "ways to draw a scene's hair against brute force: error against time",
      .options = {{"scene", "",
                   "scene file (JSON); without it the long blond hair of the ladder, with --quick scenes/still.json",
                   true},
                  {"grooms", "blond,curls,fur",
                   "further grooms of the ladder, still and moving, a,b,c; not with --quick"}},
      .declare = declare_render,
      .quick_seconds = 11,
      .seconds = 1800};
  return entry;
}

}  // namespace cuticle::study
