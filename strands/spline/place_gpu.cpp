#include "strands/spline/place_gpu.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "gpu/groups.h"
#include "strands/tangent.glslh"

#include <place_comp.spv.h>
#include <place_velocity_comp.spv.h>

namespace cuticle::strands {

namespace {

/// Row of place.glsl, word for word.
struct Row {
  glm::vec3 offset;
  float tip_separation;
  glm::vec3 direction;  ///< of the guide's first segment in the rest pose
  std::uint32_t first;  ///< vertex of the guide
  std::uint32_t size;
  float thickness;
  std::uint32_t unused[2];
};
static_assert(sizeof(Row) == 48);

struct Constants {
  glm::vec4 turn[3];
  std::uint32_t first_strand, strands, size;
  float since;
  std::uint32_t parts;
};

Constants with_turn(const glm::mat3& turn, Constants constants) {
  for (int column = 0; column < 3; ++column) constants.turn[column] = glm::vec4(turn[column], 0);
  return constants;
}

Result<void> check(const Groom& control, std::span<const PlacedStrand> strands) {
  if (const auto sound = validate(control); !sound)
    return bad_input(fmt::format("control hairs: {}", sound.error().message));
  for (std::size_t s = 0; s < strands.size(); ++s) {
    const std::uint32_t guide = strands[s].guide;
    if (guide >= control.strand_count())
      return bad_input(fmt::format("drawn strand {}: guide {} of {}", s, guide, control.strand_count()));
    const std::size_t size = control.strand_size(guide);
    if (size < 2 || size > k_longest_placed)
      return bad_input(fmt::format("strand {} has {} vertices; allowed: 2 .. {}", guide, size, k_longest_placed),
                       "groom.interpolate draws such strands with strand_vertices each");
  }
  return {};
}

std::vector<Row> rows_of(const Groom& control, std::span<const PlacedStrand> strands) {
  std::vector<Row> rows;
  for (const PlacedStrand& placed : strands) {
    const auto guide = control.strand(placed.guide);
    rows.push_back({placed.offset,
                    placed.tip_separation,
                    direction_or<float>(guide[1] - guide[0], glm::vec3(0, 1, 0)),
                    control.offsets[placed.guide],
                    std::uint32_t(guide.size()),
                    placed.thickness,
                    {}});
  }
  return rows;
}

}  // namespace

std::vector<std::uint32_t> first_vertices(std::size_t strands, std::size_t vertices) {
  std::vector<std::uint32_t> firsts;
  firsts.reserve(strands * (vertices - 1));
  for (std::size_t s = 0; s < strands; ++s)
    for (std::size_t i = 0; i + 1 < vertices; ++i) firsts.push_back(std::uint32_t(s * vertices + i));
  return firsts;
}

gpu::Buffer StrandPart::of(const gpu::Buffer& all) const {
  const std::size_t strand_bytes = std::size_t(vertices_per_strand) * bytes;
  return gpu::part_of(all, first * strand_bytes, count * strand_bytes);
}

std::vector<StrandPart> strand_parts(const gpu::DeviceInfo& device, std::uint32_t strands,
                                     std::uint32_t vertices_per_strand, std::uint32_t bytes) {
  const std::uint32_t most = strands_of_a_part(device.max_storage_buffer_bytes, vertices_per_strand, bytes);
  std::vector<StrandPart> parts;
  for (std::uint32_t first = 0; first < strands; first += most)
    parts.push_back({first, std::min(most, strands - first), vertices_per_strand, bytes});
  return parts;
}

Result<void> StrandPlacer::upload(gpu::Device& device, const Groom& control, std::span<const PlacedStrand> strands) {
  const std::size_t bytes = std::size_t(strands_) * size_ * sizeof(glm::vec4);
  CUTICLE_ASSIGN(vertices_, device.make_texel_buffer(bytes));
  CUTICLE_ASSIGN(tangents_, device.make_texel_buffer(bytes));
  CUTICLE_ASSIGN(rows_, gpu::make_buffer_from<Row>(device, rows_of(control, strands)));
  CUTICLE_ASSIGN(radii_, gpu::make_buffer_from<float>(device, control.radii));
  CUTICLE_ASSIGN(segments_, gpu::make_buffer_from<std::uint32_t>(device, first_vertices(strands_, size_)));
  return {};
}

Result<void> StrandPlacer::make_kernels(gpu::Device& device, bool moves) {
  CUTICLE_ASSIGN(place_, device.make_kernel(place_comp, {5, 0, sizeof(Constants), {}, {drawn_texels(1)}}));
  if (!moves) return {};
  CUTICLE_ASSIGN(
      place_velocity_,
      device.make_kernel(place_velocity_comp, {4, 0, sizeof(Constants), {}, {drawn_texels(1), drawn_texels(2)}}));
  CUTICLE_ASSIGN(velocities_, device.make_texel_buffer(vertices_.size()));
  return {};
}

Result<std::unique_ptr<StrandPlacer>> StrandPlacer::create(std::shared_ptr<gpu::Device> device, const Groom& control,
                                                           std::span<const PlacedStrand> strands, bool moves,
                                                           std::uint32_t parts) {
  CUTICLE_TRY(check(control, strands));
  std::unique_ptr<StrandPlacer> placer(new StrandPlacer());
  placer->strands_ = std::uint32_t(strands.size());
  placer->size_ = std::uint32_t(cut_size(longest_strand(control), parts));
  placer->parts_ = parts;
  placer->written_ = strand_parts(device->info(), placer->strands_, placer->size_);
  CUTICLE_TRY(placer->upload(*device, control, strands));
  CUTICLE_TRY(placer->make_kernels(*device, moves));
  return placer;
}

Result<void> StrandPlacer::record(gpu::Commands& commands, const gpu::Buffer& control_positions,
                                  const glm::mat3& turn) {
  commands.begin_pass("place_strands");
  for (const StrandPart& part : written_) {
    const Constants constants = with_turn(turn, {{}, part.first, part.count, size_, 0, parts_});
    const gpu::Groups groups = gpu::groups_for(part.count);
    const gpu::Buffer vertices = part.of(vertices_), tangents = part.of(tangents_);
    commands.dispatch(place_, {&rows_, &control_positions, &radii_, &vertices, &tangents}, {}, gpu::bytes_of(constants),
                      groups.x, groups.y);
  }
  commands.end_pass();
  return {};
}

Result<void> StrandPlacer::record_velocities(gpu::Commands& commands, const gpu::Buffer& control_positions,
                                             const ControlMotion& motion, const glm::mat3& turn) {
  CUTICLE_EXPECT(velocities_ && motion.values, "strands placed for velocities are told them");
  commands.begin_pass("place_velocities");
  for (const StrandPart& part : written_) {
    const Constants constants = with_turn(turn, {{}, part.first, part.count, size_, motion.since, parts_});
    const gpu::Groups groups = gpu::groups_for(part.count);
    const gpu::Buffer velocities = part.of(velocities_);
    commands.dispatch(place_velocity_, {&rows_, &control_positions, motion.values, &velocities}, {},
                      gpu::bytes_of(constants), groups.x, groups.y);
  }
  commands.end_pass();
  return {};
}

}  // namespace cuticle::strands
