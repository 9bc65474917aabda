#include "strands/spline/smooth_gpu.h"

#include <cmath>

#include <fmt/format.h>

#include "gpu/groups.h"

#include <interpolate_comp.spv.h>
#include <interpolate_velocity_comp.spv.h>
#include <smooth_comp.spv.h>
#include <smooth_velocity_comp.spv.h>

namespace cuticle::strands {
namespace {

struct SmoothConstants {
  std::uint32_t hairs, vertices;
};
struct SmoothVelocityConstants {
  SmoothConstants size;
  float since;
};
/// Of a part of the drawn strands.
struct InterpolateConstants {
  std::uint32_t first_strand, strands, vertices, run;
  float radius, tip_radius;
};
struct InterpolateVelocityConstants {
  std::uint32_t first_strand, strands, vertices;
};

Error bad_strand(std::size_t strand, std::string_view what) {
  return bad_input(fmt::format("drawn strand {}: {}", strand, what));
}

Result<void> check_strand(const StrandGeneratorInput& input, std::size_t strand) {
  const std::size_t controls = input.control->strand_count();
  for (const std::uint32_t hair : input.hairs[strand])
    if (hair >= controls) return bad_strand(strand, fmt::format("control hair {} of 0..{}", hair, controls - 1));
  const glm::vec3& weights = input.weights[strand];
  if (!std::isfinite(weights.x + weights.y + weights.z)) return bad_strand(strand, "a weight is not finite");
  return {};
}

Result<void> check(const StrandGeneratorInput& input) {
  CUTICLE_EXPECT(input.control != nullptr, "a generator needs control hairs");
  if (const auto sound = validate(*input.control); !sound)
    return bad_input(fmt::format("control hairs: {}", sound.error().message));
  if (input.vertices_per_strand < 2 || input.vertices_per_strand > k_max_vertices)
    return bad_input(
        fmt::format("vertices per strand {}: allowed are 2..{}", input.vertices_per_strand, k_max_vertices));
  if (input.hairs.size() != input.weights.size())
    return bad_input(fmt::format("{} triples of hairs, but {} of weights", input.hairs.size(), input.weights.size()));
  for (std::size_t s = 0; s < input.control->strand_count(); ++s)
    if (input.control->strand_size(s) == 0) return bad_input(fmt::format("control hair {} has no vertices", s));
  for (std::size_t s = 0; s < input.hairs.size(); ++s) CUTICLE_TRY(check_strand(input, s));
  return {};
}

}  // namespace

struct StrandGenerator::Impl {
  std::shared_ptr<gpu::Device> device;
  std::size_t hairs = 0, strands = 0, vertices_per_strand = 0, run = 0;
  float radius = 0, taper = 0;
  gpu::Kernel smooth, interpolate, smooth_velocity, interpolate_velocity;
  gpu::Buffer offsets, smoothed, hairs_of_strand, weights, vertices, tangents, segments;
  gpu::Buffer smoothed_velocities, velocities;  ///< empty unless asked for
  std::vector<StrandPart> written;              ///< a dispatch each

  Result<void> make_kernels();
  Result<void> upload(const StrandGeneratorInput& input);
  Result<void> make_outputs();
  Result<void> make_velocities();
};

Result<void> StrandGenerator::Impl::make_kernels() {
  CUTICLE_ASSIGN(smooth, device->make_kernel(smooth_comp, {3, 0, sizeof(SmoothConstants), {}, {drawn_texels(1)}}));
  CUTICLE_ASSIGN(interpolate,
                 device->make_kernel(interpolate_comp,
                                     {.storage_buffers = 5, .push_constant_bytes = sizeof(InterpolateConstants)}));
  return {};
}

Result<void> StrandGenerator::Impl::upload(const StrandGeneratorInput& input) {
  CUTICLE_ASSIGN(offsets, gpu::make_buffer_from<std::uint32_t>(*device, input.control->offsets));
  CUTICLE_ASSIGN(hairs_of_strand, gpu::make_buffer_from(*device, input.hairs));
  CUTICLE_ASSIGN(weights, gpu::make_buffer_from(*device, input.weights));
  return {};
}

Result<void> StrandGenerator::Impl::make_outputs() {
  const std::size_t count = strands * vertices_per_strand;
  CUTICLE_ASSIGN(smoothed, device->make_buffer(hairs * vertices_per_strand * sizeof(glm::vec4)));
  CUTICLE_ASSIGN(vertices, device->make_texel_buffer(count * sizeof(glm::vec4)));
  CUTICLE_ASSIGN(tangents, device->make_texel_buffer(count * sizeof(glm::vec4)));
  written = strand_parts(device->info(), std::uint32_t(strands), std::uint32_t(vertices_per_strand));
  CUTICLE_ASSIGN(segments, gpu::make_buffer_from<std::uint32_t>(*device, first_vertices(strands, vertices_per_strand)));
  return {};
}

Result<void> StrandGenerator::Impl::make_velocities() {
  CUTICLE_ASSIGN(smoothed_velocities, device->make_buffer(smoothed.size()));
  CUTICLE_ASSIGN(velocities, device->make_texel_buffer(vertices.size()));
  CUTICLE_ASSIGN(smooth_velocity,
                 device->make_kernel(smooth_velocity_comp,
                                     {4, 0, sizeof(SmoothVelocityConstants), {}, {drawn_texels(1), drawn_texels(2)}}));
  CUTICLE_ASSIGN(interpolate_velocity,
                 device->make_kernel(interpolate_velocity_comp, {4, 0, sizeof(InterpolateVelocityConstants)}));
  return {};
}

StrandGenerator::StrandGenerator(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
StrandGenerator::~StrandGenerator() = default;
const gpu::Buffer& StrandGenerator::vertices() const { return impl_->vertices; }
const gpu::Buffer& StrandGenerator::tangents() const { return impl_->tangents; }
const gpu::Buffer& StrandGenerator::velocities() const { return impl_->velocities; }
const gpu::Buffer& StrandGenerator::segments() const { return impl_->segments; }
std::uint32_t StrandGenerator::strand_count() const { return std::uint32_t(impl_->strands); }
std::uint32_t StrandGenerator::vertices_per_strand() const { return std::uint32_t(impl_->vertices_per_strand); }

Result<std::unique_ptr<StrandGenerator>> StrandGenerator::create(std::shared_ptr<gpu::Device> device,
                                                                 const StrandGeneratorInput& input) {
  CUTICLE_TRY(check(input));
  auto impl = std::make_unique<Impl>();
  impl->device = std::move(device);
  impl->hairs = input.control->strand_count();
  impl->strands = input.hairs.size();
  impl->vertices_per_strand = std::size_t(input.vertices_per_strand);
  // Software runs a load lane by lane, so that the fewest are the quickest; a GPU wants neighbours in neighbouring
  // threads.
  impl->run = impl->device->info().is_software ? impl->vertices_per_strand : 4;
  impl->radius = input.radius;
  impl->taper = input.taper;
  CUTICLE_TRY(impl->make_outputs());
  CUTICLE_TRY(impl->upload(input));
  CUTICLE_TRY(impl->make_kernels());
  if (input.moves) CUTICLE_TRY(impl->make_velocities());
  return std::unique_ptr<StrandGenerator>(new StrandGenerator(std::move(impl)));
}

Result<void> StrandGenerator::record(gpu::Commands& commands, const gpu::Buffer& control_positions, const glm::mat3&) {
  CUTICLE_TRY(record_smooth(commands, control_positions));
  return record_interpolate(commands);
}

Result<void> StrandGenerator::record_smooth(gpu::Commands& commands, const gpu::Buffer& control_positions) {
  const SmoothConstants constants{std::uint32_t(impl_->hairs), std::uint32_t(impl_->vertices_per_strand)};
  const std::size_t threads = impl_->hairs * impl_->vertices_per_strand;
  const gpu::Groups groups = gpu::groups_for(threads);
  commands.begin_pass("smooth_strands");
  commands.dispatch(impl_->smooth, {&impl_->offsets, &control_positions, &impl_->smoothed}, {},
                    gpu::bytes_of(constants), groups.x, groups.y);
  commands.end_pass();
  return {};
}

Result<void> StrandGenerator::record_interpolate(gpu::Commands& commands) {
  const std::size_t runs = (impl_->vertices_per_strand + impl_->run - 1) / impl_->run;
  commands.begin_pass("interpolate_strands");
  for (const StrandPart& part : impl_->written) {
    const InterpolateConstants constants{part.first,
                                         part.count,
                                         part.vertices_per_strand,
                                         std::uint32_t(impl_->run),
                                         impl_->radius,
                                         impl_->radius * (1 - impl_->taper)};
    const gpu::Groups groups = gpu::groups_for(part.count * runs);
    const gpu::Buffer vertices = part.of(impl_->vertices), tangents = part.of(impl_->tangents);
    commands.dispatch(impl_->interpolate,
                      {&impl_->smoothed, &impl_->hairs_of_strand, &impl_->weights, &vertices, &tangents}, {},
                      gpu::bytes_of(constants), groups.x, groups.y);
  }
  commands.end_pass();
  return {};
}

Result<void> StrandGenerator::record_velocities(gpu::Commands& commands, const gpu::Buffer& control_positions,
                                                const ControlMotion& motion) {
  CUTICLE_EXPECT(impl_->velocities && motion.values, "a generator made for velocities is told them");
  const auto per_strand = std::uint32_t(impl_->vertices_per_strand);
  const SmoothVelocityConstants smooth{{std::uint32_t(impl_->hairs), per_strand}, motion.since};
  const gpu::Groups controls = gpu::groups_for(impl_->hairs * impl_->vertices_per_strand);
  commands.begin_pass("interpolate_velocities");
  commands.dispatch(impl_->smooth_velocity,
                    {&impl_->offsets, &control_positions, motion.values, &impl_->smoothed_velocities}, {},
                    gpu::bytes_of(smooth), controls.x, controls.y);
  for (const StrandPart& part : impl_->written) {
    const InterpolateVelocityConstants interpolate{part.first, part.count, per_strand};
    const gpu::Groups drawn = gpu::groups_for(std::size_t(part.count) * per_strand);
    const gpu::Buffer velocities = part.of(impl_->velocities);
    commands.dispatch(impl_->interpolate_velocity,
                      {&impl_->smoothed_velocities, &impl_->hairs_of_strand, &impl_->weights, &velocities}, {},
                      gpu::bytes_of(interpolate), drawn.x, drawn.y);
  }
  commands.end_pass();
  return {};
}

}  // namespace cuticle::strands
