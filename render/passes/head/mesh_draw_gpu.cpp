#include "render/passes/head/mesh_draw_gpu.h"

#include <array>

#include <glm/matrix.hpp>

#include "render/lights_gpu.h"
#include "render/passes/surface_shadow/surface_shadow_gpu.h"

#include <head_vert.spv.h>

namespace cuticle::render::head {
namespace {

/// As head.frag reads it.
struct DiffuseFrame {
  glm::vec4 albedo_0, albedo_1;
  LightRows lights;
  std::array<glm::mat4, k_max_lights> rest_to_map;
  float ambient, through;
  std::uint32_t map_resolution, map_columns;
  float map_filter, bleed, unused[2];
};
static_assert(sizeof(DiffuseFrame) == 16 * (2 + 3 * k_max_lights) + 64 * k_max_lights + 32);

void set_maps(DiffuseFrame& frame, const Resources& resources, const glm::dmat4& to_world) {
  const surface_shadow::Maps& maps = resources.get<surface_shadow::Maps>();
  for (std::size_t k = 0; k < resources.get<Lights>().all.size(); ++k)
    frame.rest_to_map[k] = glm::mat4(glm::dmat4(maps.frame.world_to_map[k]) * to_world);
  frame.map_resolution = maps.frame.resolution;
  frame.map_columns = maps.frame.columns;
  frame.map_filter = maps.surface_filter;
}

DiffuseFrame frame_of(const Resources& resources, const glm::dmat4& to_world, const Diffuse& diffuse) {
  const Lights& lights = resources.get<Lights>();
  DiffuseFrame frame{};
  frame.albedo_0 = glm::vec4(diffuse.albedo_0, diffuse.wrap);
  frame.albedo_1 = glm::vec4(diffuse.albedo_1, double(lights.all.size()));
  frame.lights = light_rows(lights.all, glm::inverse(to_world));
  frame.ambient = float(diffuse.ambient);
  frame.through = float(diffuse.through);
  frame.bleed = float(diffuse.bleed);
  if (resources.find<surface_shadow::Maps>()) set_maps(frame, resources, to_world);
  return frame;
}

}  // namespace

Result<MeshDraw> MeshDraw::create(gpu::Device& device, const Resources& resources,
                                  std::span<const std::array<std::uint32_t, 3>> triangles,
                                  std::span<const std::uint32_t> fragment, bool one_sided) {
  MeshDraw draw;
  gpu::GraphicsDescription description = target_description(resources);
  description.vertex_spirv = head_vert;
  description.fragment_spirv = fragment;
  description.cull_back_faces = one_sided;
  description.interface = {5,
                           1,
                           sizeof(glm::mat4),
                           with_channels({}, shadows::different_channels(resources.get<FibreOpacity>().alpha)),
                           {{4, gpu::TextureFormat::r32u}}};
  CUTICLE_ASSIGN(draw.pipeline_, device.make_graphics(description));
  CUTICLE_ASSIGN(draw.no_map_, device.make_texture({}));
  CUTICLE_ASSIGN(draw.no_hair_, device.make_texel_buffer(sizeof(std::uint32_t), gpu::TextureFormat::r32u));
  CUTICLE_ASSIGN(draw.frame_, device.make_buffer(sizeof(DiffuseFrame)));
  const std::span<const std::uint32_t> indices(triangles.data()->data(), triangles.size() * 3);
  CUTICLE_ASSIGN(draw.indices_, gpu::make_buffer_from<std::uint32_t>(device, indices));
  draw.index_count_ = std::uint32_t(indices.size());
  return draw;
}

Result<void> MeshDraw::record(gpu::Device& device, gpu::Commands& commands, const Resources& resources,
                              const gpu::Buffer& positions, const gpu::Buffer& normals, const glm::dmat4& to_world,
                              const Diffuse& diffuse) {
  CUTICLE_TRY(device.upload(frame_, gpu::bytes_of(frame_of(resources, to_world, diffuse))));
  const glm::mat4 to_clip(drawn_world_to_clip(resources) * to_world);
  const surface_shadow::Maps* const maps = resources.find<surface_shadow::Maps>();
  begin_target(commands, resources);
  commands.draw(pipeline_, {&positions, &normals, &indices_, &frame_, maps ? &maps->hair : &no_hair_},
                {maps ? &maps->surfaces : &no_map_}, gpu::bytes_of(to_clip), index_count_);
  commands.end_rendering();
  return {};
}

}  // namespace cuticle::render::head
