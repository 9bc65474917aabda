// Any bytes as glTF: an error, or a character whose indices are in range and whose poses can be computed.
#include <cstdlib>

#include "strands/character/character.h"

using namespace cuticle::strands;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto character = parse_gltf(std::as_bytes(std::span(data, size)), "fuzz");
  if (!character) return 0;
  const Mesh& mesh = character->mesh;
  if (character->influences.size() != mesh.positions.size()) std::abort();
  for (const auto& triangle : mesh.triangles)
    for (std::uint32_t corner : triangle)
      if (corner >= mesh.positions.size()) std::abort();
  const int clip = character->clips.empty() ? -1 : 0;
  Mesh moved;
  skin(mesh, character->influences, joint_motions(joint_matrices(*character, clip, 0.3)), Skinning::dual_quaternion,
       moved);
  return 0;
}
