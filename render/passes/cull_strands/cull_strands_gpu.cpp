#include "render/passes/cull_strands/cull_strands_gpu.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "gpu/groups.h"
#include "render/passes/lines/line_width_gpu.h"
#include "render/strand_shading/frame_gpu.h"
#include "render/visibility/drawn_part_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <cull_depth_many_comp.spv.h>
#include <cull_depth_one_comp.spv.h>
#include <cull_list_comp.spv.h>
#include <cull_see_comp.spv.h>

namespace cuticle::render::cull_strands {

namespace {

constexpr std::uint32_t k_tile = 16;  // as in cull_push.glsl

/// As cull_push.glsl has it.
struct Push {
  glm::mat4 world_to_clip;
  glm::uvec2 size;
  std::uint32_t strand_count, vertices_per_strand, drawn_segments, corners;
  float width_scale, least_half_width, near, far;
  std::uint32_t has_scene;
};

struct Kernels {
  gpu::Kernel depth, see, list;
};
struct Buffers {
  gpu::Buffer tile_depth, seen, lost;
};

Push push_of(const Resources& resources) {
  const Targets& targets = resources.get<Targets>();
  const Camera& camera = resources.get<FrameView>().camera;
  const StrandDraw& draw = resources.get<StrandDraw>();
  const visibility::DrawnPart part = visibility::drawn_part(resources, draw.full_px, draw.whole_segments);
  Push push{};
  push.world_to_clip = glm::mat4(projection_matrix(camera) * view_matrix(camera));
  push.size = glm::uvec2(targets.depth->size());
  push.strand_count = part.strands;
  push.vertices_per_strand = resources.get<DrawnHair>().vertices_per_strand;
  push.drawn_segments = part.segments;
  push.corners = draw.corners;
  push.width_scale =
      float(draw.width_factor * part.width * push.size.y / (2 * std::tan(camera.vertical_field_of_view / 2)));
  const float line_width = lines::line_width(resources);
  push.least_half_width = draw.of_one_width ? lines::widened(line_width, part.width) / 2 : 0;
  push.near = float(camera.near_plane);
  push.far = float(camera.far_plane);
  push.has_scene = targets.keep ? 1 : 0;
  return push;
}

glm::uvec2 grid_of(const Resources& resources) {
  return (glm::uvec2(resources.get<Targets>().depth->size()) + k_tile - 1u) / k_tile;
}

class CullStrands : public GpuPass {
 public:
  CullStrands(std::shared_ptr<gpu::Device> device, Kernels kernels, Buffers buffers, SeenStrands strands)
      : device_(std::move(device)),
        kernels_(std::move(kernels)),
        buffers_(std::move(buffers)),
        strands_(std::move(strands)) {}

  void publish(Resources& resources) const override { resources.put_reference(strands_); }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const Push push = push_of(resources);
    const auto bytes = gpu::bytes_of(push);
    const glm::uvec2 grid = grid_of(resources);
    const gpu::Groups tiles = gpu::groups_for(std::size_t(grid.x) * grid.y),
                      strands = gpu::groups_for(push.strand_count);
    commands.dispatch(kernels_.depth, {&buffers_.tile_depth}, {resources.get<Targets>().depth}, bytes, tiles.x,
                      tiles.y);
    commands.fill(buffers_.seen, 0);
    commands.fill(buffers_.lost, 0);
    commands.dispatch(
        kernels_.see,
        {resources.get<DrawnHair>().strands.vertices, &buffers_.tile_depth, &buffers_.seen, &buffers_.lost}, {}, bytes,
        strands.x, strands.y);
    commands.dispatch(kernels_.list, {&buffers_.seen, &strands_.list, &strands_.numbers}, {}, bytes, 1);
    all_ = push.strand_count;
    corners_ = push.corners * push.drawn_segments;
    return {};
  }

  Result<Settled> settle() override {
    CUTICLE_ASSIGN(const auto numbers, gpu::read_buffer<std::uint32_t>(*device_, strands_.numbers, 1));
    CUTICLE_ASSIGN(const auto lost, gpu::read_buffer<std::uint32_t>(*device_, buffers_.lost, 1));
    const std::uint32_t drawn = numbers[0] / std::max(1u, corners_);
    Settled settled;
    if (drawn != all_)
      settled.notes.push_back(
          fmt::format("cull_strands: {} of {} strands drawn, the others are not seen", drawn, all_));
    if (lost[0] > 0) settled.notes.push_back(fmt::format("cull_strands: {} segments left out: not finite", lost[0]));
    return settled;
  }

 private:
  std::shared_ptr<gpu::Device> device_;
  Kernels kernels_;
  Buffers buffers_;
  SeenStrands strands_;
  std::uint32_t all_ = 0, corners_ = 1;  ///< strands, and vertices that each is drawn with, of the frame recorded last
};

Result<Kernels> make_kernels(gpu::Device& device, std::uint32_t samples) {
  constexpr std::uint32_t bytes = sizeof(Push);
  Kernels kernels;
  CUTICLE_ASSIGN(kernels.depth, samples == 1 ? device.make_kernel(cull_depth_one_comp, {1, 1, bytes})
                                             : device.make_kernel(cull_depth_many_comp, {1, 1, bytes, {samples}}));
  CUTICLE_ASSIGN(kernels.see, device.make_kernel(cull_see_comp, {4, 0, bytes, {}, {strands::drawn_texels(0)}}));
  CUTICLE_ASSIGN(kernels.list, device.make_kernel(cull_list_comp, {3, 0, bytes}));
  return kernels;
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const DrawnHair& hair = resources.get<DrawnHair>();
  const std::size_t strands = hair.strands.vertex_count / std::max(1u, hair.vertices_per_strand), word = 4;
  const glm::uvec2 grid = grid_of(resources);
  CUTICLE_ASSIGN(Kernels kernels, make_kernels(*device, std::uint32_t(resources.get<Targets>().depth->samples())));
  Buffers buffers;
  CUTICLE_ASSIGN(buffers.tile_depth, device->make_buffer(word * grid.x * grid.y));
  CUTICLE_ASSIGN(buffers.seen, device->make_buffer(word * std::max<std::size_t>(1, (strands + 31) / 32)));
  CUTICLE_ASSIGN(buffers.lost, device->make_buffer(word));
  SeenStrands seen;
  CUTICLE_ASSIGN(seen.list, device->make_buffer(word * std::max<std::size_t>(1, strands)));
  CUTICLE_ASSIGN(seen.numbers, device->make_buffer(4 * word));
  return std::unique_ptr<GpuPass>(
      std::make_unique<CullStrands>(std::move(device), std::move(kernels), std::move(buffers), std::move(seen)));
}

}  // namespace

const gpu::Buffer& list_of(const Resources& resources, const gpu::Buffer& unused) {
  return resources.find<cull_strands::SeenStrands>() ? resources.get<cull_strands::SeenStrands>().list : unused;
}

std::uint32_t is_listed(const Resources& resources) { return resources.find<cull_strands::SeenStrands>() ? 1 : 0; }

void draw(gpu::Commands& commands, const Resources& resources, const gpu::GraphicsPipeline& pipeline,
          std::initializer_list<const gpu::Buffer*> buffers, std::initializer_list<const gpu::Texture*> textures,
          std::span<const std::byte> push_constants, std::uint32_t vertices) {
  if (resources.find<cull_strands::SeenStrands>())
    commands.draw_counted(pipeline, buffers, textures, push_constants,
                          resources.get<cull_strands::SeenStrands>().numbers);
  else
    commands.draw(pipeline, buffers, textures, push_constants, vertices);
}

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"cull_strands", create};
  return table;
}

}  // namespace cuticle::render::cull_strands
