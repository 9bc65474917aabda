#include "render/strand_shading/direct_gpu.h"

#include <algorithm>
#include <span>

#include <fmt/core.h>

#include "bsdf/turns.h"
#include "gpu/groups.h"
#include "render/passes/seen_vertices/seen_vertices_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <strand_angles_comp.spv.h>

namespace cuticle::render::strand_shading {

namespace {

/// As strand_angles.comp reads it.
struct AnglesPush {
  std::uint32_t light, is_listed;
};

constexpr std::size_t k_point_bytes = bsdf::coordinate_count * sizeof(float), k_value_bytes = 3 * sizeof(float);

/// Vertices carry no frame across the strand: a flat fibre's S is the mean over turns of its cross-section.
constexpr int k_turns = 16;
registry::ParameterValues evaluated_values(const Resources& resources) {
  return bsdf::over_turns(*resources.get<FibreMaterial>().values, k_turns);
}

Result<void> check(const gpu::Device& device, const Resources& resources) {
  const DrawnHair& hair = resources.get<DrawnHair>();
  const bsdf::Model& model = *resources.get<FibreMaterial>().model;
  if (model.near_field && model.near_field(*resources.get<FibreMaterial>().values))
    return bad_input(fmt::format("material.evaluate = 'direct': '{}' with these parameters is a function of h, the "
                                 "place across the fibre, and strands are shaded along their middle",
                                 model.entry.name),
                     "set field to far");
  const std::uint64_t bytes =
      hair.strands.vertex_count * k_value_bytes * std::max<std::size_t>(1, resources.get<Lights>().all.size());
  const std::uint64_t most = device.info().max_storage_buffer_bytes;
  if (std::max<std::uint64_t>(bytes, hair.strands.vertex_count * k_point_bytes) <= most)
    return bsdf::check_loops(device, model, evaluated_values(resources), bsdf::Quantity::S);
  return bad_input(fmt::format("material.evaluate = 'direct': {} vertices times {} lights pass the device's largest "
                               "buffer of {} bytes",
                               hair.strands.vertex_count, resources.get<Lights>().all.size(), most),
                   "draw fewer strands or vertices, or set material.evaluate to tables");
}

}  // namespace

Result<DirectScattering> DirectScattering::make(gpu::Device& device, const Resources& resources) {
  CUTICLE_TRY(check(device, resources));
  CUTICLE_ASSIGN(bsdf::GpuEvaluator evaluator, bsdf::GpuEvaluator::make(device, *resources.get<FibreMaterial>().model));
  CUTICLE_ASSIGN(
      gpu::Kernel angles,
      device.make_kernel(strand_angles_comp,
                         {5, 0, sizeof(AnglesPush), {}, {strands::drawn_texels(0), strands::drawn_texels(1)}}));
  DirectScattering direct(std::move(evaluator), std::move(angles));
  const std::size_t vertices = resources.get<DrawnHair>().strands.vertex_count,
                    lights = std::max<std::size_t>(1, resources.get<Lights>().all.size());
  CUTICLE_ASSIGN(direct.points_, device.make_buffer(vertices * k_point_bytes));
  CUTICLE_ASSIGN(direct.of_light_, device.make_buffer(vertices * k_value_bytes));
  CUTICLE_ASSIGN(direct.scattered_, device.make_buffer(lights * vertices * k_value_bytes));
  CUTICLE_ASSIGN(direct.parameters_, direct.evaluator_.upload(evaluated_values(resources)));
  return direct;
}

Result<void> DirectScattering::take_parameters(gpu::Device& device, const Resources& resources) {
  CUTICLE_TRY(check(device, resources));
  CUTICLE_ASSIGN(parameters_, evaluator_.upload(evaluated_values(resources)));
  return {};
}

void DirectScattering::record(gpu::Commands& commands, const Resources& resources, const gpu::Buffer& frame,
                              const gpu::Buffer* listed) const {
  const std::size_t bytes = resources.get<DrawnHair>().strands.vertex_count * k_value_bytes;
  for (std::uint32_t light = 0; light < resources.get<Lights>().all.size(); ++light) {
    record_light(commands, resources, frame, listed, light);
    commands.copy(of_light_, scattered_, bytes, 0, light * bytes);
  }
}

void DirectScattering::record_light(gpu::Commands& commands, const Resources& resources, const gpu::Buffer& frame,
                                    const gpu::Buffer* listed, std::uint32_t light) const {
  const DrawnHair& hair = resources.get<DrawnHair>();
  const std::uint32_t vertices = hair.strands.vertex_count;
  const AnglesPush push{light, listed ? 1u : 0u};
  const gpu::Buffer* const buffers[] = {hair.strands.vertices, hair.tangents, &points_, &frame,
                                        listed ? listed : &frame};
  if (listed) {
    commands.dispatch_counted(angles_, buffers, {}, gpu::bytes_of(push), *listed, seen_vertices::k_listed_groups);
    evaluator_.record_counted(commands, parameters_, points_, of_light_, vertices, *listed,
                              seen_vertices::k_listed_groups);
    return;
  }
  const gpu::Groups groups = gpu::groups_for(vertices);
  commands.dispatch(angles_, buffers, {}, gpu::bytes_of(push), groups.x, groups.y);
  evaluator_.record(commands, parameters_, points_, of_light_, vertices, bsdf::Quantity::S, -1);
}

}  // namespace cuticle::render::strand_shading
