#include "render/passes/floor/floor.h"
#include "render/passes/head/mesh_draw_gpu.h"

#include <floor_frag.spv.h>

namespace cuticle::render::floor {

namespace {

constexpr std::array<std::uint32_t, 3> k_triangles[] = {{0, 2, 1}, {1, 2, 3}};

class FloorPass : public GpuPass {
 public:
  FloorPass(std::shared_ptr<gpu::Device> device, head::MeshDraw draw, const head::Diffuse& diffuse)
      : device_(std::move(device)), draw_(std::move(draw)), diffuse_(diffuse) {}

  Result<void> make(const Floor& floor) {
    const auto half = float(floor.size / 2), height = float(floor.height);
    const glm::vec4 corners[] = {
        {-half, height, -half, 0}, {half, height, -half, 0}, {-half, height, half, 0}, {half, height, half, 0}};
    const glm::vec4 up(0, 1, 0, 0), normals[] = {up, up, up, up};
    CUTICLE_ASSIGN(positions_, gpu::make_buffer_from<glm::vec4>(*device_, corners));
    CUTICLE_ASSIGN(normals_, gpu::make_buffer_from<glm::vec4>(*device_, normals));
    return {};
  }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    return draw_.record(*device_, commands, resources, positions_, normals_, glm::dmat4(1), diffuse_);
  }

 private:
  std::shared_ptr<gpu::Device> device_;
  head::MeshDraw draw_;
  head::Diffuse diffuse_;
  gpu::Buffer positions_, normals_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const Surfaces& surfaces = resources.get<Surfaces>();
  CUTICLE_EXPECT(surfaces.floor.has_value(), "the floor's pass was planned without a floor");
  CUTICLE_ASSIGN(head::MeshDraw draw, head::MeshDraw::create(*device, resources, k_triangles, floor_frag, true));
  const head::Diffuse diffuse{surfaces.floor->albedo, surfaces.floor->albedo, 0,
                              parameters_of<Parameters>(resources).ambient};
  auto pass = std::make_unique<FloorPass>(std::move(device), std::move(draw), diffuse);
  CUTICLE_TRY(pass->make(*surfaces.floor));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"floor", create};
  return table;
}

}  // namespace cuticle::render::floor
