#include <cstddef>
#include <cstdint>

#include "lut/formats/dds/dds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto image = cuticle::lut::dds::parse({reinterpret_cast<const std::byte*>(data), size}, "fuzz.dds");
  if (image && image->pixels.size() != std::size_t(image->width) * image->height * 4) __builtin_trap();
  return 0;
}
