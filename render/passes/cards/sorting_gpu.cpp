#include "render/passes/cards/sorting_gpu.h"

#include <glm/geometric.hpp>

#include "gpu/groups.h"

#include <cards_depth_comp.spv.h>
#include <cards_sort_comp.spv.h>

namespace cuticle::render::cards {

namespace {

/// As card_parts.glsl has it.
struct SortedPart {
  std::uint32_t first_row, row_count, first_index, index_count, group;
};

struct View {
  glm::vec4 eye, forward;
  std::uint32_t part_count;
};

std::vector<SortedPart> parts_of(const strands::CardMesh& mesh) {
  std::vector<SortedPart> parts;
  for (const strands::CardPart& part : mesh.parts)
    parts.push_back({part.first_row, part.row_count, 3 * part.first_triangle, 3 * part.triangle_count, part.group});
  return parts;
}

}  // namespace

Result<Sorting> Sorting::make(gpu::Device& device, const strands::CardMesh& mesh, Order order) {
  Sorting sorting;
  sorting.order_ = order;
  sorting.index_count_ = std::uint32_t(3 * mesh.mesh.triangles.size());
  sorting.part_count_ = std::uint32_t(mesh.parts.size());
  const std::span<const std::uint32_t> indices(mesh.mesh.triangles.data()->data(), sorting.index_count_);
  CUTICLE_ASSIGN(sorting.static_, gpu::make_buffer_from<std::uint32_t>(device, indices));
  if (order == Order::inside_to_outside) return sorting;
  CUTICLE_ASSIGN(sorting.sorted_, device.make_buffer(indices.size_bytes()));
  CUTICLE_ASSIGN(sorting.parts_, gpu::make_buffer_from<SortedPart>(device, parts_of(mesh)));
  CUTICLE_ASSIGN(sorting.depths_, device.make_buffer(mesh.parts.size() * sizeof(float)));
  CUTICLE_ASSIGN(sorting.depth_,
                 device.make_kernel(cards_depth_comp, {.storage_buffers = 3, .push_constant_bytes = sizeof(View)}));
  CUTICLE_ASSIGN(sorting.sort_,
                 device.make_kernel(cards_sort_comp, {.storage_buffers = 4,
                                                      .push_constant_bytes = sizeof(std::uint32_t),
                                                      .specialization = {order == Order::groups ? 1u : 0u}}));
  return sorting;
}

void Sorting::record(gpu::Commands& commands, const Camera& camera, const gpu::Buffer& placed) const {
  if (order_ == Order::inside_to_outside) return;
  const View view{glm::vec4(camera.position, 1), glm::vec4(glm::normalize(camera.target - camera.position), 0),
                  part_count_};
  const gpu::Groups groups = gpu::groups_for(part_count_);
  commands.dispatch(depth_, {&parts_, &placed, &depths_}, {}, gpu::bytes_of(view), groups.x, groups.y);
  commands.dispatch(sort_, {&parts_, &depths_, &static_, &sorted_}, {}, gpu::bytes_of(part_count_), groups.x, groups.y);
}

}  // namespace cuticle::render::cards
