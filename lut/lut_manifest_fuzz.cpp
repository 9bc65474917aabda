#include <cstddef>
#include <cstdint>

#include "lut/manifest.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto manifest = cuticle::lut::parse_manifest({reinterpret_cast<const char*>(data), size}, "fuzz.json");
  if (!manifest) return 0;
  for (const auto& table : manifest->tables)
    for (const auto& probe : table.probes)
      if (probe.values.size() != table.channels.size()) __builtin_trap();
  return 0;
}
