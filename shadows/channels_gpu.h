#pragma once
// Transmittance per channel on the device, where a method's optical depth is proportional to opacity.
#include "gpu/device.h"
#include "shadows/channels.h"

namespace cuticle::shadows {

/// One dispatch for each opacity but the root, by the formula of evaluate_channels.
class ChannelPowers {
 public:
  static Result<ChannelPowers> create(gpu::Device& device);
  /// other := root^ratio, both of `vertices` floats (channels.glslh).
  void record(gpu::Commands& commands, const gpu::Buffer& root, double ratio, const gpu::Buffer& other,
              std::uint32_t vertices) const;

 private:
  gpu::Kernel kernel_;
};

}  // namespace cuticle::shadows
