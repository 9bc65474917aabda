#include "render/passes/head/head.h"
#include "render/passes/head/mesh_draw_gpu.h"

#include <head_frag.spv.h>

namespace cuticle::render::head {

namespace {

struct Geometry {
  gpu::Buffer positions, normals;
};

Result<Geometry> upload(gpu::Device& device, const strands::Mesh& mesh, const strands::Mesh* scalp) {
  std::vector<glm::vec4> positions, normals;
  const std::vector<float> shares = scalp_shares(mesh, scalp);
  for (std::size_t v = 0; v < shares.size(); ++v) positions.emplace_back(mesh.positions[v], shares[v]);
  for (const glm::vec3& normal : mesh.normals) normals.emplace_back(normal, 0);
  Geometry geometry;
  CUTICLE_ASSIGN(geometry.positions, gpu::make_buffer_from<glm::vec4>(device, positions));
  CUTICLE_ASSIGN(geometry.normals, gpu::make_buffer_from<glm::vec4>(device, normals));
  return geometry;
}

class Head : public GpuPass {
 public:
  Head(std::shared_ptr<gpu::Device> device, Geometry geometry, MeshDraw draw, const Diffuse& diffuse)
      : device_(std::move(device)), geometry_(std::move(geometry)), draw_(std::move(draw)), diffuse_(diffuse) {}

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const auto* const deformed = resources.find<HeadVertices>();
    return draw_.record(*device_, commands, resources, deformed ? *deformed->positions : geometry_.positions,
                        deformed ? *deformed->normals : geometry_.normals, resources.get<Surfaces>().head_transform,
                        diffuse_);
  }

 private:
  std::shared_ptr<gpu::Device> device_;
  Geometry geometry_;
  MeshDraw draw_;
  Diffuse diffuse_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const Surfaces& surfaces = resources.get<Surfaces>();
  CUTICLE_EXPECT(surfaces.head && !surfaces.head->triangles.empty(), "the head pass was planned without a head");
  CUTICLE_ASSIGN(Geometry geometry, upload(*device, *surfaces.head, surfaces.scalp));
  CUTICLE_ASSIGN(MeshDraw draw, MeshDraw::create(*device, resources, surfaces.head->triangles, head_frag));
  const auto parameters = parameters_of<Parameters>(resources);
  const Diffuse diffuse{parameters.skin, parameters.scalp, parameters.wrap, parameters.ambient, 0, parameters.bleed};
  return std::unique_ptr<GpuPass>(
      std::make_unique<Head>(std::move(device), std::move(geometry), std::move(draw), diffuse));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"head", create};
  return table;
}

}  // namespace cuticle::render::head
