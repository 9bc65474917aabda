#pragma once
// A groom in device buffers, as the passes of shadow methods read it.
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "gpu/device.h"
#include "shadows/method_gpu.h"

namespace cuticle::shadows {

/// Buffers of a groom, and room for one transmittance a vertex. It stays where it is made: `strands` points into it.
struct GroomOnDevice {
  gpu::Buffer vertices, segments, transmittance;
  GpuStrands strands;
};

/// Uploads a groom. Errors: bad_input for one that is not sound (strands::validate), out_of_memory.
inline Result<std::unique_ptr<GroomOnDevice>> upload_groom(gpu::Device& device, const strands::Groom& groom) {
  if (const auto sound = strands::validate(groom); !sound) return bad_input("casters: " + sound.error().message);
  std::vector<glm::vec4> packed;
  std::vector<std::uint32_t> first;
  for (std::size_t v = 0; v < groom.vertex_count(); ++v) packed.emplace_back(groom.positions[v], groom.radii[v]);
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v + 1 < groom.offsets[s + 1]; ++v) first.push_back(v);
  const std::uint32_t segment_count = std::uint32_t(first.size());
  first.resize(std::max<std::size_t>(1, first.size()));  // a buffer holds at least one word
  auto result = std::make_unique<GroomOnDevice>();
  CUTICLE_ASSIGN(result->vertices, device.make_texel_buffer(packed.size() * sizeof(glm::vec4)));
  CUTICLE_TRY(device.upload(result->vertices, std::as_bytes(std::span(packed))));
  CUTICLE_ASSIGN(result->segments, gpu::make_buffer_from<std::uint32_t>(device, first));
  CUTICLE_ASSIGN(result->transmittance, device.make_buffer(4 * packed.size()));
  result->strands = {&result->vertices, &result->segments, std::uint32_t(packed.size()), segment_count,
                     strands::bounds(groom)};
  return result;
}

}  // namespace cuticle::shadows
