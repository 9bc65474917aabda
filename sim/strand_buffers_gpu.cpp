#include "sim/strand_buffers_gpu.h"

namespace cuticle::sim {

Result<StrandBuffers> make_strand_buffers(gpu::Device& device, const RestPose& pose) {
  StrandBuffers buffers;
  const std::vector<glm::vec4> zeros(pose.places.size(), glm::vec4(0));
  const std::vector<std::uint32_t> no_resets(std::max<std::size_t>(1, pose.strand_count()), 0);
  const std::span<const glm::vec4> places(pose.places), still(zeros);
  CUTICLE_ASSIGN(buffers.offsets, gpu::make_buffer_from(device, std::span<const std::uint32_t>(pose.offsets)));
  CUTICLE_ASSIGN(buffers.places, gpu::make_buffer_from(device, places));
  CUTICLE_ASSIGN(buffers.traits, gpu::make_buffer_from(device, std::span<const glm::vec4>(pose.traits)));
  CUTICLE_ASSIGN(buffers.positions, gpu::make_buffer_from(device, places));
  CUTICLE_ASSIGN(buffers.starts, gpu::make_buffer_from(device, places));
  CUTICLE_ASSIGN(buffers.velocities, gpu::make_buffer_from(device, still));
  CUTICLE_ASSIGN(buffers.resets, gpu::make_buffer_from(device, std::span<const std::uint32_t>(no_resets)));
  CUTICLE_ASSIGN(buffers.world, gpu::make_buffer_from(device, places));
  CUTICLE_ASSIGN(buffers.spheres, gpu::make_buffer_from(device, still.first(1)));
  const std::vector<std::uint32_t> nothing(2 * std::max<std::size_t>(1, pose.strand_count()), 0);
  CUTICLE_ASSIGN(buffers.reach, gpu::make_buffer_from(device, std::span<const std::uint32_t>(nothing)));
  return buffers;
}

Result<std::uint32_t> upload_reach(gpu::Device& device, StrandBuffers& buffers, std::size_t strands,
                                   std::span<const std::uint8_t> reached) {
  CUTICLE_EXPECT(reached.empty() || reached.size() == strands, "FrameInput::reached has an entry for each strand");
  std::vector<std::uint32_t> words(2 * strands, 0);
  std::uint32_t count = 0;
  for (std::size_t strand = 0; strand < strands; ++strand) {
    if (!reached.empty() && !reached[strand]) continue;
    words[strand] = 1;
    words[strands + count++] = std::uint32_t(strand);
  }
  CUTICLE_TRY(device.upload(buffers.reach, std::as_bytes(std::span<const std::uint32_t>(words))));
  return count;
}

Result<void> upload_spheres(gpu::Device& device, StrandBuffers& buffers, std::span<const glm::vec4> spheres) {
  if (buffers.spheres.size() >= spheres.size_bytes()) return device.upload(buffers.spheres, std::as_bytes(spheres));
  CUTICLE_ASSIGN(buffers.spheres, gpu::make_buffer_from(device, spheres));
  return {};
}

}  // namespace cuticle::sim
