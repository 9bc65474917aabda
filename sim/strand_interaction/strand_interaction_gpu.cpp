#include "sim/strand_interaction/strand_interaction_gpu.h"

#include <bit>

#include <strand_deposit_comp.spv.h>
#include <strand_deposit_on_skin.spv.h>
#include <strand_push_comp.spv.h>
#include <strand_push_on_skin.spv.h>

#include "gpu/groups.h"

namespace cuticle::sim::strand_interaction {
namespace {

/// The kernels' push constants.
struct Constants {
  GridFrame<float> grid;
  std::array<std::uint32_t, 3> nodes;
  std::uint32_t vertex_count, component_stride, before_offset;
};
static_assert(sizeof(Constants) == 104);

template <class T>
Result<gpu::Buffer> buffer_of(gpu::Device& device, const std::vector<T>& values) {
  return gpu::make_buffer_from(device, std::span<const T>(values));
}

}  // namespace

Result<std::unique_ptr<StrandInteractionGpu>> StrandInteractionGpu::create(gpu::Device& device,
                                                                           const strands::Groom& rest,
                                                                           const Settings& settings,
                                                                           const VelocityLayout& layout) {
  auto made = std::make_unique<StrandInteractionGpu>();
  CUTICLE_ASSIGN(made->grid_, make_strand_grid(rest, settings.cell));
  made->settings_ = settings;
  made->component_stride_ = layout.component_stride;
  made->before_offset_ = layout.before_offset;
  CUTICLE_ASSIGN(made->masses_, buffer_of(device, made->grid_.masses));
  CUTICLE_ASSIGN(made->rest_densities_, buffer_of(device, rest_densities(made->grid_, rest, settings.onset)));
  CUTICLE_ASSIGN(made->places_, buffer_of(device, layout.places));
  CUTICLE_ASSIGN(made->sums_, device.make_buffer(made->grid_.node_count() * sizeof(NodeSums) + sizeof(std::uint32_t)));
  const std::uint32_t bytes = sizeof(Constants);
  CUTICLE_ASSIGN(made->deposit_,
                 device.make_kernel(strand_deposit_comp, {.storage_buffers = 4, .push_constant_bytes = bytes}));
  CUTICLE_ASSIGN(made->push_,
                 device.make_kernel(strand_push_comp, {.storage_buffers = 7, .push_constant_bytes = bytes}));
  return made;
}

void StrandInteractionGpu::record_both(gpu::Commands& commands, const GridFrame<float>& frame,
                                       const gpu::Kernel& deposit, const Bound& deposited, const gpu::Kernel& push,
                                       const Bound& pushed) {
  const Constants constants{frame, grid_.nodes, std::uint32_t(grid_.masses.size()), component_stride_, before_offset_};
  const gpu::Groups groups = gpu::groups_for(grid_.masses.size());
  commands.begin_pass("strand_interaction");
  commands.fill(sums_, 0);
  commands.dispatch(deposit, deposited, {}, gpu::bytes_of(constants), groups.x, groups.y);
  commands.dispatch(push, pushed, {}, gpu::bytes_of(constants), groups.x, groups.y);
  commands.end_pass();
}

void StrandInteractionGpu::record(gpu::Commands& commands, const SolverBuffers& buffers, const glm::dmat3& rotation,
                                  const glm::dvec3& translation, double duration) {
  record_both(commands, frame_constants(grid_, settings_, rotation, translation, duration), deposit_,
              {buffers.world, buffers.velocities, &masses_, &sums_}, push_,
              {buffers.world, buffers.velocities, &masses_, &sums_, &rest_densities_, &places_, buffers.state});
}

Result<void> StrandInteractionGpu::make_for_skin(gpu::Device& device, const strands::Groom& rest) {
  std::vector<std::uint32_t> strand_of_vertex;
  for (std::uint32_t s = 0; s < rest.strand_count(); ++s) strand_of_vertex.resize(rest.offsets[s + 1], s);
  CUTICLE_ASSIGN(strand_of_vertex_, buffer_of(device, strand_of_vertex));
  const std::uint32_t bytes = sizeof(Constants);
  CUTICLE_ASSIGN(deposit_on_skin_,
                 device.make_kernel(strand_deposit_on_skin, {.storage_buffers = 7, .push_constant_bytes = bytes}));
  CUTICLE_ASSIGN(push_on_skin_,
                 device.make_kernel(strand_push_on_skin, {.storage_buffers = 10, .push_constant_bytes = bytes}));
  return {};
}

void StrandInteractionGpu::record_on_skin(gpu::Commands& commands, const SolverBuffers& buffers,
                                          const SkinBuffers& skin, double duration) {
  record_both(commands, frame_constants(grid_, settings_, glm::dmat3(1), glm::dvec3(0), duration), deposit_on_skin_,
              {buffers.world, buffers.velocities, &masses_, &sums_, skin.strands, skin.end, &strand_of_vertex_},
              push_on_skin_,
              {buffers.world, buffers.velocities, &masses_, &sums_, &rest_densities_, &places_, buffers.state,
               skin.strands, skin.end, &strand_of_vertex_});
}

Result<std::vector<NodeSums>> StrandInteractionGpu::sums(gpu::Device& device) const {
  return gpu::read_buffer<NodeSums>(device, sums_, grid_.node_count());
}

Result<std::uint32_t> StrandInteractionGpu::left_out(gpu::Device& device) const {
  std::uint32_t count = 0;
  CUTICLE_TRY(
      device.download(sums_, std::as_writable_bytes(std::span(&count, 1)), grid_.node_count() * sizeof(NodeSums)));
  return count;
}

const GpuEffect& gpu_entry() {
  static const GpuEffect effect{"strand_interaction", nullptr};
  return effect;
}

}  // namespace cuticle::sim::strand_interaction
