#pragma once
// The storage buffers of the strand kernels, in the order of sim/strand_kernel.glsl.
#include <span>

#include "gpu/device.h"
#include "sim/rest_pose.h"

namespace cuticle::sim {

constexpr std::uint32_t k_strand_buffers = 10;

struct StrandBuffers {
  gpu::Buffer offsets, places, traits;        ///< RestPose
  gpu::Buffer positions, starts, velocities;  ///< vec4 per vertex; positions relative to the head's translation
  gpu::Buffer resets;                         ///< uint per strand
  gpu::Buffer world;                          ///< vec4 per vertex
  gpu::Buffer spheres;                        ///< vec4 per collider
  gpu::Buffer reach;  ///< uint: for each strand whether a sphere may touch it, then those strands in order
};

/// Buffers that hold the rest pose at rest. The pose has at least one vertex.
/// Error: out_of_memory; more than 8 million vertices do not fit the 128 MiB that every device offers one buffer.
Result<StrandBuffers> make_strand_buffers(gpu::Device& device, const RestPose& pose);

/// Uploads which strands a frame's spheres may touch (FrameInput::reached; empty: all), and returns how many they are.
Result<std::uint32_t> upload_reach(gpu::Device& device, StrandBuffers& buffers, std::size_t strands,
                                   std::span<const std::uint8_t> reached);

/// Makes room for these spheres and uploads them.
Result<void> upload_spheres(gpu::Device& device, StrandBuffers& buffers, std::span<const glm::vec4> spheres);

}  // namespace cuticle::sim
