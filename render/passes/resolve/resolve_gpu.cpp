#include "render/pass_gpu.h"
#include "render/passes/resolve/resolve.h"

#include <resolve_frag.spv.h>
#include <resolve_vert.spv.h>

namespace cuticle::render::resolve {

namespace {

struct Push {
  glm::vec4 background;
  int supersampling;
};

class Resolve : public GpuPass {
 public:
  Resolve(gpu::GraphicsPipeline pipeline, glm::vec3 background)
      : pipeline_(std::move(pipeline)), background_(background) {}

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const Targets& targets = resources.get<Targets>();
    const gpu::Commands::Target target{.color = resources.get<Output>().picture};
    commands.begin_rendering({&target, 1}, nullptr);
    const Push push{glm::vec4(background_, background_ == glm::vec3(0) ? 0.0f : 1.0f), targets.supersampling};
    commands.draw(pipeline_, {}, {targets.resolved}, gpu::bytes_of(push), 3);
    commands.end_rendering();
    return {};
  }

 private:
  gpu::GraphicsPipeline pipeline_;
  glm::vec3 background_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  gpu::GraphicsDescription description;
  description.vertex_spirv = resolve_vert;
  description.fragment_spirv = resolve_frag;
  description.interface.textures = 1;
  description.interface.push_constant_bytes = sizeof(Push);
  description.color_formats = {resources.get<Output>().picture->format()};
  CUTICLE_ASSIGN(gpu::GraphicsPipeline pipeline, device->make_graphics(description));
  return std::unique_ptr<GpuPass>(
      std::make_unique<Resolve>(std::move(pipeline), glm::vec3(parameters_of<Parameters>(resources).background)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"resolve", create};
  return table;
}

}  // namespace cuticle::render::resolve
