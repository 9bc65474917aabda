#include <algorithm>
#include <array>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cuticle/render/pass_gpu.h>
#include <cuticle/render/passes/head/head.h>
#include <cuticle/render/passes/surface_shadow/surface_shadow_gpu.h>

#include <head_frag.spv.h>
#include <head_vert.spv.h>

namespace cuticle::render::head {

namespace {

/// As head.frag reads it.
struct Frame {
  glm::vec4 skin, scalp_color, ambient;
  std::array<glm::vec4, k_max_lights> to_light, irradiance;
  std::array<glm::mat4, k_max_lights> rest_to_map;
  std::uint32_t map_resolution, map_columns;
  float map_filter, unused;
};
static_assert(sizeof(Frame) == 16 * (3 + 2 * k_max_lights) + 64 * k_max_lights + 16);

struct Geometry {
  gpu::Buffer positions, normals, indices;
  std::uint32_t index_count = 0;
};

float nearest_distance(const glm::vec3& point, std::span<const glm::vec3> others) {
  float nearest = std::numeric_limits<float>::max();
  for (const glm::vec3& other : others) nearest = std::min(nearest, glm::dot(other - point, other - point));
  return std::sqrt(nearest);
}

/// 1 on the scalp, falling to 0 within a centimetre of it, so that the hairline is soft.
float scalp_share(const glm::vec3& point, const strands::Mesh* scalp) {
  constexpr float k_full = 0.008f, k_none = 0.018f;
  if (!scalp || scalp->positions.empty()) return 0;
  return std::clamp((k_none - nearest_distance(point, scalp->positions)) / (k_none - k_full), 0.0f, 1.0f);
}

Result<Geometry> upload(gpu::Device& device, const strands::Mesh& mesh, const strands::Mesh* scalp) {
  std::vector<glm::vec4> positions, normals;
  for (const glm::vec3& point : mesh.positions) positions.emplace_back(point, scalp_share(point, scalp));
  for (const glm::vec3& normal : mesh.normals) normals.emplace_back(normal, 0);
  Geometry geometry;
  CUTICLE_ASSIGN(geometry.positions, gpu::make_buffer_from<glm::vec4>(device, positions));
  CUTICLE_ASSIGN(geometry.normals, gpu::make_buffer_from<glm::vec4>(device, normals));
  const std::span<const std::uint32_t> indices(mesh.triangles.data()->data(), mesh.triangles.size() * 3);
  CUTICLE_ASSIGN(geometry.indices, gpu::make_buffer_from<std::uint32_t>(device, indices));
  geometry.index_count = std::uint32_t(indices.size());
  return geometry;
}

class Head : public GpuPass {
 public:
  Head(std::shared_ptr<gpu::Device> device, Geometry geometry, gpu::GraphicsPipeline pipeline, gpu::Buffer frame,
       gpu::Texture no_map, registry::ParameterValues parameters)
      : device_(std::move(device)),
        geometry_(std::move(geometry)),
        pipeline_(std::move(pipeline)),
        frame_(std::move(frame)),
        no_map_(std::move(no_map)),
        parameters_(std::move(parameters)) {}

  Result<void> record(gpu::Commands& commands, const FrameResources& resources) override {
    CUTICLE_TRY(device_->upload(frame_, gpu::bytes_of(frame(resources))));
    const glm::mat4 rest_to_clip(projection_matrix(resources.camera) * view_matrix(resources.camera) *
                                 resources.head_transform);
    begin_target(commands, resources);
    const bool deforms = resources.head_positions != nullptr;
    commands.draw(pipeline_,
                  {deforms ? resources.head_positions : &geometry_.positions,
                   deforms ? resources.head_normals : &geometry_.normals, &geometry_.indices, &frame_},
                  {resources.surface_shadow ? &resources.surface_shadow->hair : &no_map_}, gpu::bytes_of(rest_to_clip),
                  geometry_.index_count);
    commands.end_rendering();
    return {};
  }

 private:
  Frame frame(const FrameResources& resources) const {
    Frame frame{};
    frame.skin = glm::vec4(parameters_.rgb("skin"), parameters_.real("wrap"));
    frame.scalp_color = glm::vec4(parameters_.rgb("scalp"), double(resources.lights.size()));
    const glm::dmat3 to_rest(glm::inverse(resources.head_transform));
    for (std::size_t k = 0; k < resources.lights.size(); ++k) {
      frame.to_light[k] = glm::vec4(to_rest * resources.lights[k].to_light, 0);
      frame.irradiance[k] = glm::vec4(resources.lights[k].irradiance, 0);
      frame.ambient += float(parameters_.real("ambient")) * frame.irradiance[k];
    }
    if (resources.surface_shadow) set_maps(frame, resources);
    return frame;
  }

  static void set_maps(Frame& frame, const FrameResources& resources) {
    const surface_shadow::Maps& maps = *resources.surface_shadow;
    for (std::size_t k = 0; k < resources.lights.size(); ++k)
      frame.rest_to_map[k] = glm::mat4(glm::dmat4(maps.frame.world_to_map[k]) * resources.head_transform);
    frame.map_resolution = maps.frame.resolution;
    frame.map_columns = maps.frame.columns;
    frame.map_filter = maps.surface_filter;
  }

  std::shared_ptr<gpu::Device> device_;
  Geometry geometry_;
  gpu::GraphicsPipeline pipeline_;
  gpu::Buffer frame_;
  gpu::Texture no_map_;  ///< bound where no hair casts
  registry::ParameterValues parameters_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  CUTICLE_EXPECT(resources.head && !resources.head->triangles.empty(), "the head pass was planned without a head");
  CUTICLE_ASSIGN(Geometry geometry, upload(*device, *resources.head, resources.scalp));
  gpu::GraphicsDescription description = target_description(resources);
  description.vertex_spirv = head_vert;
  description.fragment_spirv = head_frag;
  description.interface.storage_buffers = 4;
  description.interface.textures = 1;
  description.interface.push_constant_bytes = sizeof(glm::mat4);
  CUTICLE_ASSIGN(gpu::GraphicsPipeline pipeline, device->make_graphics(description));
  CUTICLE_ASSIGN(gpu::Buffer frame, device->make_buffer(sizeof(Frame)));
  CUTICLE_ASSIGN(gpu::Texture no_map, device->make_texture({}));
  return std::unique_ptr<GpuPass>(std::make_unique<Head>(std::move(device), std::move(geometry), std::move(pipeline),
                                                         std::move(frame), std::move(no_map),
                                                         parameters_of(resources, entry())));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"head", create};
  return table;
}

}  // namespace cuticle::render::head
