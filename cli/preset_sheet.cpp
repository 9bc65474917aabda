#include "cli/preset_sheet.h"

#ifdef CUTICLE_HAS_GPU
#include <filesystem>

#include <fmt/core.h>

#include "cli/shared_files.h"
#include "plan/frame_runner_gpu.h"
#endif

namespace cuticle::cli {

#ifdef CUTICLE_HAS_GPU
namespace {

Result<void> draw(scene::Scene scene, const std::string& file, const std::shared_ptr<gpu::Device>& device,
                  Progress& progress, std::vector<Image>& pictures) {
  CUTICLE_ASSIGN(scene.groom.specification, strands::load_specification(file));
  scene.strand_vertices = scene.groom.specification->strands.vertices;
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, progress));
  for (int frame : {0, 1}) {
    CUTICLE_ASSIGN(const plan::FrameResult result, runner->run(frame));
    pictures.push_back(tone_map(result.color, scene.outputs.exposure_stops));
  }
  progress.message(fmt::format("{}: {} strands of {} vertices drawn", std::filesystem::path(file).stem().string(),
                               runner->control_groom().strand_count(), scene.strand_vertices));
  return {};
}

}  // namespace

Result<void> draw_preset_sheet(const std::vector<std::string>& specifications, const std::string& file,
                               Context& context) {
  CUTICLE_ASSIGN(const scene::Scene scene, scene::load_scene(share_file("scenes/presets.json"), plan::catalogue()));
  CUTICLE_ASSIGN(const std::shared_ptr<gpu::Device> device, gpu::Device::open({.choice = context.device}));
  std::vector<Image> pictures;
  for (const std::string& specification : specifications)
    CUTICLE_TRY(draw(scene, specification, device, *context.progress, pictures));
  const int columns = specifications.size() % 2 == 0 ? 4 : 2;  // no place is left over
  return write_png(file, contact_sheet(pictures, columns));
}
#else
Result<void> draw_preset_sheet(const std::vector<std::string>&, const std::string&, Context&) {
  return Error{ErrorKind::no_device, "--sheet: this program was built without Vulkan", "leave --sheet out"};
}
#endif

}  // namespace cuticle::cli
