#include "render/strand_shading/gathered_transmittance_gpu.h"

#include <algorithm>

namespace cuticle::render {

Result<GatheredTransmittance> GatheredTransmittance::make(gpu::Device& device, const Resources& resources) {
  const std::size_t lights = std::max<std::size_t>(1, resources.get<Lights>().all.size());
  GatheredTransmittance gathered;
  const std::size_t numbers =
      lights * transmittance_of(resources).channels.count * resources.get<DrawnHair>().strands.vertex_count;
  CUTICLE_ASSIGN(gathered.buffer_, device.make_texel_buffer(numbers * sizeof(float), gpu::TextureFormat::r32f));
  return gathered;
}

void GatheredTransmittance::record(gpu::Commands& commands, const Resources& resources) const {
  const std::size_t bytes = resources.get<DrawnHair>().strands.vertex_count * sizeof(float);
  constexpr std::uint32_t k_one = 0x3F800000;  // 1.0f
  if (transmittance_of(resources).reached.empty()) commands.fill(buffer_, k_one);
  for (std::size_t k = 0; k < transmittance_of(resources).reached.size(); ++k)
    commands.copy(*transmittance_of(resources).reached[k], buffer_, bytes, 0, k * bytes);
}

}  // namespace cuticle::render
