#include <cuticle/shadows/opacity_map/opacity_map_gpu.h>

#include <algorithm>

#include <glm/vec4.hpp>

#include <cuticle/shadows/opacity_map/splat.glslh>

#include <opacity_lookup_comp.spv.h>
#include <opacity_scan_comp.spv.h>
#include <opacity_splat_comp.spv.h>

namespace cuticle::shadows::opacity_map {
namespace {

struct Push {
  glm::vec4 axis_x, axis_y, axis_z;
  float texels_per_metre, filter_texels, per_unit;
  std::uint32_t resolution, layers, count, poisson;
};

Push push_of(const Geometry& g, const Settings& settings, float filter, double scale) {
  return {{g.axis_x, g.offset_x}, {g.axis_y, g.offset_y}, {g.axis_z, g.offset_z}, g.texels_per_metre, filter,
          float(-settings.k / scale), g.resolution, g.layers, 0, settings.poisson ? 1u : 0u};
}

void dispatch(gpu::Commands& commands, std::string_view pass, const gpu::Kernel& kernel,
              std::initializer_list<const gpu::Buffer*> buffers, Push push, std::uint32_t count) {
  const std::uint32_t groups = (count + 63) / 64, across = std::min(groups, 32768u);
  push.count = count;
  commands.begin_pass(pass);
  commands.dispatch(kernel, buffers, {}, gpu::bytes_of(push), across, (groups + across - 1) / across);
  commands.end_pass();
}

}  // namespace

Result<void> OpacityMapGpu::make() {
  const gpu::ShaderInterface four{4, 0, sizeof(Push)}, one{1, 0, sizeof(Push)}, three{3, 0, sizeof(Push)};
  CUTICLE_ASSIGN(sums_, device_->make_buffer(4ull * settings_.resolution * settings_.resolution * (settings_.slices - 1)));
  CUTICLE_ASSIGN(table_, device_->make_buffer(4ull * (k_coverage_steps + 1)));
  CUTICLE_ASSIGN(splat_, device_->make_kernel(opacity_splat_comp, four));
  CUTICLE_ASSIGN(scan_, device_->make_kernel(opacity_scan_comp, one));
  CUTICLE_ASSIGN(lookup_, device_->make_kernel(opacity_lookup_comp, three));
  return {};
}

Result<std::unique_ptr<GpuShadow>> OpacityMapGpu::create(std::shared_ptr<gpu::Device> device, const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  std::unique_ptr<OpacityMapGpu> shadow(new OpacityMapGpu(std::move(device), settings));
  CUTICLE_TRY(shadow->make());
  return std::unique_ptr<GpuShadow>(std::move(shadow));
}

Result<void> OpacityMapGpu::upload_table(double alpha, std::size_t segments) {
  const double scale = fixed_point_scale(alpha, settings_, segments);
  if (alpha == table_alpha_ && scale == scale_) return {};
  const std::vector<std::uint32_t> table = deposit_table(alpha, settings_, scale);
  CUTICLE_TRY(device_->upload(table_, std::as_bytes(std::span(table))));
  table_alpha_ = alpha;
  scale_ = scale;
  return {};
}

Result<void> OpacityMapGpu::record(gpu::Commands& commands, const GpuStrands& strands, double alpha, glm::dvec3 to_light,
                                   const gpu::Buffer& transmittance) {
  if (dispatches_per_frame(strands) == 0) return {};
  CUTICLE_ASSIGN(const glm::dvec3 direction, unit_to_light(to_light));
  if (!(alpha >= 0 && alpha <= 1)) return usage_error("alpha must lie in 0 .. 1");
  const Geometry geometry = map_geometry(fit_light_frame(strands.bounds, direction), settings_);
  CUTICLE_ASSIGN(const float filter, filter_texels(geometry, settings_));
  CUTICLE_TRY(upload_table(alpha, strands.segment_count));
  const Push push = push_of(geometry, settings_, filter, scale_);
  commands.begin_pass("shadow.clear");
  commands.fill(sums_, 0);
  commands.end_pass();
  dispatch(commands, "shadow.splat", splat_, {strands.vertices, strands.segments, &table_, &sums_}, push, strands.segment_count);
  dispatch(commands, "shadow.scan", scan_, {&sums_}, push, geometry.resolution * geometry.resolution);
  dispatch(commands, "shadow.lookup", lookup_, {strands.vertices, &sums_, &transmittance}, push, strands.vertex_count);
  return {};
}

std::uint32_t OpacityMapGpu::dispatches_per_frame(const GpuStrands& strands) const {
  return strands.segment_count == 0 || strands.vertex_count == 0 ? 0 : 3;
}

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"opacity_map", &OpacityMapGpu::create};
  return method;
}

}  // namespace cuticle::shadows::opacity_map
