#include "render/strands_gpu.h"

namespace cuticle::render {

const HairTransmittance& transmittance_of(const Resources& resources) {
  static const HairTransmittance none;
  const HairTransmittance* const found = resources.find<HairTransmittance>();
  return found ? *found : none;
}

}  // namespace cuticle::render
