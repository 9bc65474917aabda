#include "render/passes/tiles/fine_gpu.h"

#include <algorithm>

#include "gpu/groups.h"
#include "render/passes/tile_sort/tile_sort.h"
#include "render/passes/tiles/tiles.h"
#include "strands/spline/drawn_gpu.h"

#include <tiles_prepare_comp.spv.h>

namespace cuticle::render::tiles {

namespace {

constexpr std::size_t k_record_bytes = 48;  // k_record_texels of projected_segment.glsl

/// Where a subgroup is a tile's eight and runs in software: there every lane reads a segment faster than one tells it.
bool reads_records(const gpu::DeviceInfo& device, const PassParameters& parameters, std::size_t records) {
  return parameters_of<tile_sort::Parameters>(parameters).slices == 0 &&
         tile_lists::lanes_of(device, parameters) == tile_lists::k_tile && device.is_software &&
         device.subgroup_size == tile_lists::k_tile && device.subgroup_broadcast &&
         records * k_record_bytes <= device.max_texel_buffer_bytes;
}

/// Room for the records of segments that begin at any of the vertices, each so many after the one before (record_place
/// of projected_segment.glsl).
std::size_t records_of(std::size_t vertices, std::uint32_t parts) { return (vertices + parts - 1) / parts; }

/// Records that one binding holds.
std::size_t records_of_a_part(const gpu::DeviceInfo& device) {
  constexpr std::size_t k_step = 16;  ///< records that end where a part may begin
  return device.max_storage_buffer_bytes / (k_step * k_record_bytes) * k_step;
}

Result<gpu::Kernel> make_prepare(gpu::Device& device, std::size_t first, std::size_t count, bool has_colors,
                                 std::uint32_t segment_parts) {
  return device.make_kernel(
      tiles_prepare_comp,
      {4,
       0,
       sizeof(tile_lists::TilePush),
       {std::uint32_t(first), std::uint32_t(count), has_colors ? 1u : 0u, segment_parts},
       {strands::drawn_texels(0), {1, gpu::TextureFormat::rgba16f}, {2, gpu::TextureFormat::r32u}}});
}

}  // namespace

FineForm fine_form(const gpu::DeviceInfo& device, const Resources& resources) {
  const auto parameters = parameters_of<Parameters>(resources);
  const bool sliced = parameters_of<tile_sort::Parameters>(resources).slices > 0;
  const std::uint32_t rows = parameters.coverage_rows;
  const bool spans = !sliced && rows > 0 && parameters.opacity >= 1;
  const DrawnHair& hair = resources.get<DrawnHair>();
  const std::uint32_t parts = tile_lists::listed_parts(resources);
  const std::size_t records = records_of(hair.strands.vertex_count, parts);
  return {spans,
          reads_records(device, resources.parameters, records),
          std::max(rows, 1u),
          tile_lists::lanes_of(device, resources.parameters),
          parts,
          spans && parameters_of<tile_lists::Parameters>(resources).full_px > 0};
}

gpu::ShaderInterface fine_interface(const FineForm& form, std::uint32_t buffers, bool says_seen) {
  const gpu::TextureFormat first = form.reads_records ? gpu::TextureFormat::rgba32u : gpu::TextureFormat::rgba32f;
  return {buffers,
          0,
          sizeof(tile_lists::TilePush),
          {says_seen ? 1u : 0u, form.rows, form.lanes, form.parts, form.lets_through ? 1u : 0u},
          {{0, first}, {1, gpu::TextureFormat::rgba16f}, {3, gpu::TextureFormat::r32u}}};
}

Result<Records> Records::make(gpu::Device& device, const Resources& resources) {
  const std::uint32_t parts = tile_lists::listed_parts(resources);
  const std::size_t all = records_of(resources.get<DrawnHair>().strands.vertex_count, parts);
  const std::size_t most = records_of_a_part(device.info());
  Records made;
  CUTICLE_ASSIGN(made.all_, device.make_texel_buffer(all * k_record_bytes));
  for (std::size_t first = 0; first < all; first += most) {
    const std::size_t count = std::min(most, all - first);
    Part part;
    CUTICLE_ASSIGN(part.colored, make_prepare(device, first, count, true, parts));
    CUTICLE_ASSIGN(part.bare, make_prepare(device, first, count, false, parts));
    part.records = gpu::part_of(made.all_, first * k_record_bytes, count * k_record_bytes);
    made.parts_.push_back(std::move(part));
  }
  return made;
}

void Records::record(gpu::Commands& commands, const Resources& resources, const tile_lists::TilePush& push,
                     const gpu::Buffer* colors) const {
  const shadows::GpuStrands& strands = resources.get<DrawnHair>().strands;
  const gpu::Groups segments = gpu::groups_for(push.segment_count);
  for (const Part& part : parts_)
    commands.dispatch(colors ? part.colored : part.bare,
                      {strands.vertices, colors ? colors : strands.vertices, strands.segments, &part.records}, {},
                      gpu::bytes_of(push), segments.x, segments.y);
}

std::uint32_t prepare_dispatches(const gpu::DeviceInfo& device, const PassParameters& parameters,
                                 const registry::FrameShape& shape) {
  const std::uint32_t ends = shape.vertices - shape.strands;  // of parts; so many lie on a segment
  const bool whole = parameters_of<tile_lists::Parameters>(parameters).whole_segments && shape.segments > 0;
  const std::size_t records = records_of(shape.vertices, whole ? ends / shape.segments : 1);
  if (!reads_records(device, parameters, records)) return 0;
  const std::size_t most = records_of_a_part(device);
  return std::uint32_t((records + most - 1) / most);
}

}  // namespace cuticle::render::tiles
