#include "sim/clumping/clumping_gpu.h"

#include <bit>

#include <clump_aim_comp.spv.h>
#include <clump_aim_on_skin.spv.h>

#include "gpu/groups.h"
#include "sim/solver_gpu.h"

namespace cuticle::sim::clumping {
namespace {

/// The kernel's push constants.
struct Constants {
  glm::vec4 x, y, z;
  std::uint32_t vertex_count;
};
static_assert(sizeof(Constants) == 52);

}  // namespace

Result<std::unique_ptr<ClumpingGpu>> ClumpingGpu::create(gpu::Device& device,
                                                         const std::vector<ClumpedVertex>& vertices) {
  auto made = std::make_unique<ClumpingGpu>();
  std::vector<glm::vec4> numbers;
  std::vector<glm::uvec4> rows;
  for (const ClumpedVertex& v : vertices) {
    numbers.emplace_back(v.base, v.share);
    numbers.emplace_back(v.apart, v.between);
    rows.emplace_back(v.above, v.below, v.target, std::bit_cast<std::uint32_t>(float(v.most_squared)));
    rows.emplace_back(v.strand, v.guide, 0, 0);
  }
  made->count_ = std::uint32_t(vertices.size());
  CUTICLE_ASSIGN(made->numbers_, gpu::make_buffer_from(device, std::span<const glm::vec4>(numbers)));
  CUTICLE_ASSIGN(made->rows_, gpu::make_buffer_from(device, std::span<const glm::uvec4>(rows)));
  CUTICLE_ASSIGN(made->kernel_,
                 device.make_kernel(clump_aim_comp, {.storage_buffers = 4, .push_constant_bytes = sizeof(Constants)}));
  return made;
}

void ClumpingGpu::record(gpu::Commands& commands, const gpu::Buffer& state, const gpu::Buffer& rest,
                         const glm::dmat3& to_rest) {
  const Constants constants{glm::vec4(glm::dvec4(to_rest[0], 0)), glm::vec4(glm::dvec4(to_rest[1], 0)),
                            glm::vec4(glm::dvec4(to_rest[2], 0)), count_};
  const gpu::Groups groups = gpu::groups_for(count_);
  commands.begin_pass("clumping");
  commands.dispatch(kernel_, {&numbers_, &rows_, &state, &rest}, {}, gpu::bytes_of(constants), groups.x, groups.y);
  commands.end_pass();
}

Result<void> ClumpingGpu::make_for_skin(gpu::Device& device) {
  CUTICLE_ASSIGN(on_skin_, device.make_kernel(clump_aim_on_skin,
                                              {.storage_buffers = 6, .push_constant_bytes = sizeof(Constants)}));
  return {};
}

void ClumpingGpu::record_on_skin(gpu::Commands& commands, const gpu::Buffer& state, const gpu::Buffer& rest,
                                 const SkinBuffers& skin) {
  const Constants constants{glm::vec4(0), glm::vec4(0), glm::vec4(0), skin.onto_skin ? 0 : count_};
  const gpu::Groups groups = gpu::groups_for(count_);
  commands.begin_pass("clumping");
  commands.dispatch(on_skin_, {&numbers_, &rows_, &state, &rest, skin.strands, skin.begin}, {},
                    gpu::bytes_of(constants), groups.x, groups.y);
  commands.end_pass();
}

const GpuEffect& gpu_entry() {
  static const GpuEffect effect{"clumping", nullptr};
  return effect;
}

}  // namespace cuticle::sim::clumping
