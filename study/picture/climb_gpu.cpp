// Draws the rungs.
#include <chrono>

#include <fmt/core.h>

#include "render/passes/reference/reference_entry.h"
#include "study/picture/picture_study.h"

namespace cuticle::study {
namespace {

/// The hair alone, at rest, on nothing, without what is only drawn in real time (tints, ambient light).
scene::Scene hair_of(const scene::Scene& scene) {
  scene::Scene hair = scene;
  hair.head.present = false;
  hair.floor.reset();
  hair.motion.reset();
  hair.simulation = {};
  hair.passes.erase("resolve");
  hair.passes.erase("surface_shadow");
  return hair;
}

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

struct Drawn {
  std::shared_ptr<plan::FrameRunner> runner;
  plan::FrameResult frame;
  double seconds = 0, bytes = 0;
};

/// Paths that do not read the tables have small ones made: those of a near field take longer than the picture.
scene::Scene with_tables_in_use(scene::Scene scene) {
  const bool reads = render::parameters_of<render::reference::Parameters>(scene.passes).tables;
  if (scene.render_method == "reference" && !reads) scene.material.lut_size = 16;
  return scene;
}

Result<Drawn> draw(const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene, Progress& progress) {
  const std::size_t before = device->allocated_bytes();
  CUTICLE_ASSIGN(auto runner, plan::FrameRunner::create(device, with_tables_in_use(scene), progress));
  Drawn drawn{std::move(runner), {}};
  const auto start = std::chrono::steady_clock::now();
  CUTICLE_ASSIGN(drawn.frame, drawn.runner->run(0));
  drawn.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  drawn.bytes = double(device->allocated_bytes() - before);
  return drawn;
}

Result<void> add_truth(Ladder& ladder, const std::shared_ptr<gpu::Device>& device, scene::Scene scene,
                       Progress& progress) {
  scene.outputs.aovs = true;
  CUTICLE_ASSIGN(const Drawn layered, draw(device, scene, progress));
  ladder.strands = first_strands(layered.frame.aovs);
  scene.outputs.aovs = false;
  scene.passes.at("reference").set("seed", std::int64_t(1));
  CUTICLE_ASSIGN(Drawn again, draw(device, scene, progress));
  ladder.again = std::move(again.frame.color);
  return {};
}

}  // namespace

Result<Ladder> climb(std::shared_ptr<gpu::Device> device, const LadderRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const std::vector<Rung> rungs, rungs_of(request));
  return climb(std::move(device), rungs, request, progress);
}

Result<Ladder> climb(std::shared_ptr<gpu::Device> device, const std::vector<Rung>& rungs, const LadderRequest& request,
                     Progress& progress) {
  Ladder ladder;
  scene::Scene scene = hair_of(request.scene);
  std::size_t done = 0;
  for (const Rung& rung : rungs) {
    progress.update(fmt::format("rungs of {}", request.name), done++, rungs.size());
    if (!request.without.contains(rung.name)) CUTICLE_TRY(rung.apply(scene));
    CUTICLE_ASSIGN(Drawn drawn, draw(device, scene, progress));
    if (ladder.rungs.empty() && rungs.size() > 3) CUTICLE_TRY(add_truth(ladder, device, scene, progress));
    const bool on_device = scene.render_method != "reference" && scene.render_method != "truth";
    ladder.rungs.push_back(
        {rung, scene, std::move(drawn.frame.color), on_device ? drawn.runner : nullptr, drawn.seconds, drawn.bytes});
  }
  progress.update(fmt::format("rungs of {}", request.name), done, rungs.size());
  return ladder;
}

}  // namespace cuticle::study
