#include "render/passes/fins/fins.h"
#include "render/passes/head/mesh_draw_gpu.h"

#include <fins_frag.spv.h>

namespace cuticle::render::fins {

namespace {

class Fins : public GpuPass {
 public:
  Fins(std::shared_ptr<gpu::Device> device, head::MeshDraw draw, head::Diffuse diffuse)
      : device_(std::move(device)), draw_(std::move(draw)), diffuse_(diffuse) {}

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    return draw_.record(*device_, commands, resources, *resources.get<FinVertices>().positions,
                        *resources.get<FinVertices>().normals, glm::dmat4(1), diffuse_);
  }

 private:
  std::shared_ptr<gpu::Device> device_;
  head::MeshDraw draw_;
  head::Diffuse diffuse_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const Surfaces& surfaces = resources.get<Surfaces>();
  CUTICLE_EXPECT(surfaces.fins && !surfaces.fins->triangles.empty(), "the fins' pass was planned without fins");
  const auto parameters = parameters_of<Parameters>(resources);
  CUTICLE_ASSIGN(head::MeshDraw draw, head::MeshDraw::create(*device, resources, surfaces.fins->triangles, fins_frag));
  return std::unique_ptr<GpuPass>(std::make_unique<Fins>(
      std::move(device), std::move(draw),
      head::Diffuse{parameters.root, parameters.tip, parameters.wrap, parameters.ambient, parameters.through}));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"fins", create};
  return table;
}

}  // namespace cuticle::render::fins
