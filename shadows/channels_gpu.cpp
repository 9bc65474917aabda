#include "shadows/channels_gpu.h"

#include "gpu/groups.h"

#include <channel_power_comp.spv.h>

namespace cuticle::shadows {

namespace {

/// As channel_power.comp reads it.
struct Push {
  std::uint32_t vertex_count;
  float ratio;
};

}  // namespace

Result<ChannelPowers> ChannelPowers::create(gpu::Device& device) {
  ChannelPowers powers;
  CUTICLE_ASSIGN(powers.kernel_, device.make_kernel(channel_power_comp, {2, 0, sizeof(Push)}));
  return powers;
}

void ChannelPowers::record(gpu::Commands& commands, const gpu::Buffer& root, double ratio, const gpu::Buffer& other,
                           std::uint32_t vertices) const {
  const Push push{vertices, float(ratio)};
  const gpu::Groups groups = gpu::groups_for(vertices);
  commands.begin_pass("shadow.channels");
  commands.dispatch(kernel_, {&root, &other}, {}, gpu::bytes_of(push), groups.x, groups.y);
  commands.end_pass();
}

}  // namespace cuticle::shadows
