#include "render/gathered_transmittance_gpu.h"

#include <algorithm>

namespace cuticle::render {

Result<GatheredTransmittance> GatheredTransmittance::make(gpu::Device& device, const FrameResources& resources) {
  const std::size_t lights = std::max<std::size_t>(1, resources.lights.size());
  GatheredTransmittance gathered;
  CUTICLE_ASSIGN(gathered.buffer_, device.make_buffer(lights * resources.channels.count *
                                                      resources.strands.vertex_count * sizeof(float)));
  return gathered;
}

void GatheredTransmittance::record(gpu::Commands& commands, const FrameResources& resources) const {
  const std::size_t bytes = resources.strands.vertex_count * sizeof(float);
  constexpr std::uint32_t k_one = 0x3F800000;  // 1.0f
  if (resources.transmittance.empty()) commands.fill(buffer_, k_one);
  for (std::size_t k = 0; k < resources.transmittance.size(); ++k)
    commands.copy(*resources.transmittance[k], buffer_, bytes, 0, k * bytes);
}

}  // namespace cuticle::render
