#include "render/passes/velocity/velocity_gpu.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "gpu/groups.h"
#include "render/pass_gpu.h"
#include "render/passes/aovs/aovs_gpu.h"
#include "render/passes/pixel_depth/pixel_depth_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <velocity_comp.spv.h>
#include <velocity_fill_comp.spv.h>
#include <velocity_largest_comp.spv.h>
#include <velocity_mean_comp.spv.h>
#include <velocity_splat_comp.spv.h>

namespace cuticle::render::velocity {

namespace {

constexpr int k_fills = 4;  // even: the last leaves its result where the first began

/// As velocity.glsl has it.
struct GridFrame {
  glm::mat4 world_to_clip_before;
  glm::vec4 eye, right, up, forward, lower, nodes_per_metre;
  std::uint32_t nodes, vertex_count;
  glm::uvec2 resolution;
  float frame_duration;
  std::uint32_t has_scene;
  glm::vec2 pixel_shift;
};

struct Kernels {
  gpu::Kernel largest, splat, mean, fill, pixels;
};
struct Buffers {
  gpu::Buffer frame, largest, sums, grid, filled, vectors;
};

GridFrame frame_of(const Resources& resources, std::uint32_t nodes) {
  const FrameView& view = resources.get<FrameView>();
  const Camera &camera = view.camera, &before = view.camera_before;
  const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double height = std::tan(camera.vertical_field_of_view / 2);
  const double width = height * camera.resolution.x / camera.resolution.y;
  const strands::Bounds& bounds = resources.get<DrawnHair>().strands.bounds;
  return {.world_to_clip_before = glm::mat4(projection_matrix(before) * view_matrix(before)),
          .eye = glm::vec4(camera.position, 0),
          .right = glm::vec4(right * width, 0),
          .up = glm::vec4(up * height, 0),
          .forward = glm::vec4(forward, 0),
          .lower = glm::vec4(bounds.lower, 0),
          .nodes_per_metre = glm::vec4(float(nodes - 1) / (bounds.upper - bounds.lower), 0),
          .nodes = nodes,
          .vertex_count = resources.get<ControlHairs>().vertex_count,
          .resolution = glm::uvec2(camera.resolution),
          .frame_duration = resources.get<ControlHairs>().motion.since > 0 ? 0 : float(view.frame_duration),
          .has_scene = resources.find<pixel_depth::PixelDepth>() ? 1u : 0u,
          .pixel_shift = glm::vec2(camera.pixel_shift)};
}

class Velocity : public GpuPass {
 public:
  Velocity(std::shared_ptr<gpu::Device> device, Kernels kernels, Buffers buffers, std::uint32_t nodes)
      : device_(std::move(device)), kernels_(std::move(kernels)), buffers_(std::move(buffers)), nodes_(nodes) {}

  std::optional<FileLayer> layer(std::string_view wanted, const Resources&) const override {
    if (wanted != name_of<MotionVectors>()) return std::nullopt;
    return FileLayer{&buffers_.vectors, k_channels};
  }

  void publish(Resources& resources) const override { resources.put(MotionVectors{&buffers_.vectors}); }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const GridFrame frame = frame_of(resources, nodes_);
    CUTICLE_TRY(device_->upload(buffers_.frame, gpu::bytes_of(frame)));
    record_grid(commands, resources);
    const auto* const depth = resources.find<pixel_depth::PixelDepth>();
    const auto channels = std::uint32_t(std::size(aovs::k_channels));
    const gpu::Groups groups = gpu::groups_for(std::size_t(frame.resolution.x) * frame.resolution.y);
    commands.dispatch(kernels_.pixels,
                      {&buffers_.frame, &buffers_.grid, resources.get<aovs::Layers>().values, &buffers_.vectors,
                       depth ? depth->values : &buffers_.grid},
                      {}, gpu::bytes_of(channels), groups.x, groups.y);
    return {};
  }

 private:
  void record_grid(gpu::Commands& commands, const Resources& resources) const {
    const gpu::Buffer *now = resources.get<ControlHairs>().positions,
                      *motion = resources.get<ControlHairs>().motion.values;
    const gpu::Groups vertices = gpu::groups_for(resources.get<ControlHairs>().vertex_count),
                      nodes = gpu::groups_for(std::size_t(nodes_) * nodes_ * nodes_);
    commands.fill(buffers_.largest, 0);
    commands.fill(buffers_.sums, 0);
    commands.dispatch(kernels_.largest, {&buffers_.frame, now, motion, &buffers_.largest}, {}, {}, vertices.x,
                      vertices.y);
    commands.dispatch(kernels_.splat, {&buffers_.frame, now, motion, &buffers_.largest, &buffers_.sums}, {}, {},
                      vertices.x, vertices.y);
    commands.dispatch(kernels_.mean, {&buffers_.frame, &buffers_.sums, &buffers_.largest, &buffers_.grid}, {}, {},
                      nodes.x, nodes.y);
    const gpu::Buffer *from = &buffers_.grid, *to = &buffers_.filled;
    for (int k = 0; k < k_fills; ++k, std::swap(from, to))
      commands.dispatch(kernels_.fill, {&buffers_.frame, from, to}, {}, {}, nodes.x, nodes.y);
  }

  std::shared_ptr<gpu::Device> device_;
  Kernels kernels_;
  Buffers buffers_;
  std::uint32_t nodes_;
};

Result<Kernels> make_kernels(gpu::Device& device) {
  Kernels kernels;
  const std::vector<gpu::TexelBinding> vertices = {strands::drawn_texels(1), strands::drawn_texels(2)};
  CUTICLE_ASSIGN(kernels.largest, device.make_kernel(velocity_largest_comp, {4, 0, 0, {}, vertices}));
  CUTICLE_ASSIGN(kernels.splat, device.make_kernel(velocity_splat_comp, {5, 0, 0, {}, vertices}));
  CUTICLE_ASSIGN(kernels.mean, device.make_kernel(velocity_mean_comp, {4, 0, 0}));
  CUTICLE_ASSIGN(kernels.fill, device.make_kernel(velocity_fill_comp, {3, 0, 0}));
  CUTICLE_ASSIGN(kernels.pixels, device.make_kernel(velocity_comp, {5, 0, sizeof(std::uint32_t)}));
  return kernels;
}

Result<Buffers> make_buffers(gpu::Device& device, glm::ivec2 resolution, std::size_t nodes) {
  const std::size_t all = nodes * nodes * nodes, pixels = std::size_t(resolution.x) * std::size_t(resolution.y);
  Buffers buffers;
  CUTICLE_ASSIGN(buffers.frame, device.make_buffer(sizeof(GridFrame)));
  CUTICLE_ASSIGN(buffers.largest, device.make_buffer(sizeof(float)));
  CUTICLE_ASSIGN(buffers.sums, device.make_buffer(all * sizeof(glm::ivec4)));
  CUTICLE_ASSIGN(buffers.grid, device.make_buffer(all * sizeof(glm::vec4)));
  CUTICLE_ASSIGN(buffers.filled, device.make_buffer(all * sizeof(glm::vec4)));
  CUTICLE_ASSIGN(buffers.vectors, device.make_buffer(pixels * sizeof(glm::vec2)));
  return buffers;
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const std::uint32_t nodes = parameters_of<Parameters>(resources).nodes;
  CUTICLE_ASSIGN(Kernels kernels, make_kernels(*device));
  CUTICLE_ASSIGN(Buffers buffers, make_buffers(*device, resources.get<FrameView>().camera.resolution, nodes));
  return std::unique_ptr<GpuPass>(
      std::make_unique<Velocity>(std::move(device), std::move(kernels), std::move(buffers), nodes));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"velocity", create};
  return table;
}

}  // namespace cuticle::render::velocity
