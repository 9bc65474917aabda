// Any text: an error or a mesh whose indices are in range.
#include <cstdlib>

#include "strands/formats/formats.h"

using namespace cuticle::strands;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto mesh = parse_obj({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!mesh) return 0;
  if (mesh->normals.size() != mesh->positions.size()) std::abort();
  for (const auto& triangle : mesh->triangles)
    for (std::uint32_t corner : triangle)
      if (corner >= mesh->positions.size()) std::abort();
  return 0;
}
