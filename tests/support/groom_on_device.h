#pragma once
// A groom in device buffers, for the tests of shadow methods on the device.
#include <memory>
#include <vector>

#include <glm/vec4.hpp>

#include <cuticle/gpu/device.h>
#include <cuticle/shadows/method_gpu.h>

namespace cuticle::tests {

/// A device with one groom on it.
struct GroomOnDevice {
  std::shared_ptr<gpu::Device> device;
  gpu::Buffer vertices, segments, transmittance;
  shadows::GpuStrands strands;
  strands::Groom groom;

  explicit GroomOnDevice(strands::Groom hair, std::shared_ptr<gpu::Device> on = gpu::Device::open().value())
      : device(std::move(on)), groom(std::move(hair)) {
    std::vector<glm::vec4> packed;
    std::vector<std::uint32_t> first;
    for (std::size_t v = 0; v < groom.vertex_count(); ++v) packed.emplace_back(groom.positions[v], groom.radii[v]);
    for (std::size_t s = 0; s < groom.strand_count(); ++s)
      for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v) first.push_back(v);
    vertices = gpu::make_buffer_from<glm::vec4>(*device, packed).value();
    segments = gpu::make_buffer_from<std::uint32_t>(*device, first).value();
    transmittance = device->make_buffer(4 * packed.size()).value();
    strands = {&vertices, &segments, std::uint32_t(packed.size()), std::uint32_t(first.size()), strands::bounds(groom)};
  }
};

}  // namespace cuticle::tests
