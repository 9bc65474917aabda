// Any text: an error or a clip whose joints have finite transforms.
#include <cmath>
#include <cstdlib>

#include "strands/motion/bvh.h"

using namespace cuticle::strands;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto motion = parse_bvh({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!motion) return 0;
  const glm::dmat4 world = joint_transform(*motion, int(motion->joints.size()) - 1, 0.4 * motion->duration());
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(world[column][row])) std::abort();
  return 0;
}
