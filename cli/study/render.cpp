#include "cli/study/study.h"

#ifdef CUTICLE_HAS_GPU
#include <algorithm>

#include <fmt/core.h>

#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "plan/plan.h"
#include "study/render/render_study.h"
#endif

namespace cuticle::cli {

#ifdef CUTICLE_HAS_GPU
namespace {

struct RenderStudyOptions {
  std::string scene, out;
  bool quick = false;
};

Result<study::RenderStudy> run(const RenderStudyOptions& options, Context& context) {
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = context.device}));
  study::RenderRequest request;
  CUTICLE_ASSIGN(
      request.scene,
      scene::load_scene(options.scene.empty() ? share_file("scenes/demo.json") : options.scene, plan::catalogue()));
  if (options.quick) {
    request.repeats = 1;
    request.grows = false;
    request.scene.camera.camera.resolution /= 4;
    request.scene.strand_count = std::min(request.scene.strand_count, 1000);
  }
  CUTICLE_ASSIGN(study::RenderStudy study, study::run_render_study(device, request, *context.progress));
  CUTICLE_TRY(study::write_render_study(study, options.out));
  return study;
}

int study_render(const RenderStudyOptions& options, Context& context) {
  const auto study = run(options, context);
  if (!study) return report(study.error());
  fmt::print("{}", study::to_csv(*study));
  return make_page("--demo", options.out, *context.progress);
}

}  // namespace

void add_study_render(CLI::App& study, Context& context) {
  auto* command = study.add_subcommand("render", "ways to draw a scene's hair against brute force: error against time");
  auto options = std::make_shared<RenderStudyOptions>();
  command->add_option("scene", options->scene, "scene file (JSON); without it that of the demo");
  command->add_option("--out", options->out, "folder to write")->required();
  command->add_flag("--quick", options->quick,
                    "a quarter of the resolution, at most 1,000 strands, fewer settings, no growth, timed once");
  command->callback([&context, options] {
    context.action = [&context, options] {
      return in_folder(options->out, [&] { return study_render(*options, context); });
    };
  });
}
#else
void add_study_render(CLI::App&, Context&) {}
#endif

}  // namespace cuticle::cli
