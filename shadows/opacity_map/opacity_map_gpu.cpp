#include <cuticle/shadows/opacity_map/opacity_map_gpu.h>

#include <algorithm>
#include <bit>

#include <glm/vec4.hpp>

#include <cuticle/shadows/opacity_map/splat.glslh>

#include <opacity_fit_comp.spv.h>
#include <opacity_lookup_comp.spv.h>
#include <opacity_scan_comp.spv.h>
#include <opacity_splat_comp.spv.h>

namespace cuticle::shadows::opacity_map {
namespace {

struct Push {
  glm::vec4 right, up, forward;
  float intervals, filter_texels, filter_radius, per_unit;
  std::uint32_t resolution, layers, count, poisson;
};

Push push_of(const LightAxes& axes, const Settings& settings, double scale) {
  return {{axes.right, 0}, {axes.up, 0}, {axes.forward, 0}, slice_intervals(settings), float(settings.filter_texels),
          float(settings.filter_radius), float(-settings.k / scale), settings.resolution, settings.slices - 1, 0,
          settings.poisson ? 1u : 0u};
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
  const auto interface_of = [](std::uint32_t buffers) { return gpu::ShaderInterface{buffers, 0, sizeof(Push)}; };
  CUTICLE_ASSIGN(sums_, device_->make_buffer(4ull * settings_.resolution * settings_.resolution * (settings_.slices - 1)));
  CUTICLE_ASSIGN(table_, device_->make_buffer(4ull * (k_coverage_steps + 1)));
  CUTICLE_ASSIGN(box_, device_->make_buffer(4 * 6));
  CUTICLE_ASSIGN(fit_, device_->make_kernel(opacity_fit_comp, interface_of(2)));
  CUTICLE_ASSIGN(splat_, device_->make_kernel(opacity_splat_comp, interface_of(5)));
  CUTICLE_ASSIGN(scan_, device_->make_kernel(opacity_scan_comp, interface_of(1)));
  CUTICLE_ASSIGN(lookup_, device_->make_kernel(opacity_lookup_comp, interface_of(4)));
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
  if (dispatches_per_frame(strands) == 0) {
    if (strands.vertex_count > 0) commands.fill(transmittance, std::bit_cast<std::uint32_t>(1.0f));  // nothing casts a shadow
    return {};
  }
  CUTICLE_ASSIGN(const glm::dvec3 direction, unit_to_light(to_light));
  if (!(alpha >= 0 && alpha <= 1)) return usage_error("alpha must lie in 0 .. 1");
  CUTICLE_TRY(upload_table(alpha, strands.segment_count));
  const Push push = push_of(light_axes(direction), settings_, scale_);
  commands.begin_pass("shadow.clear");
  commands.fill(sums_, 0);
  commands.fill(box_, ~0u);
  commands.end_pass();
  dispatch(commands, "shadow.fit", fit_, {strands.vertices, &box_}, push, strands.vertex_count);
  dispatch(commands, "shadow.splat", splat_, {strands.vertices, strands.segments, &table_, &box_, &sums_}, push, strands.segment_count);
  dispatch(commands, "shadow.scan", scan_, {&sums_}, push, settings_.resolution * settings_.resolution);
  dispatch(commands, "shadow.lookup", lookup_, {strands.vertices, &box_, &sums_, &transmittance}, push, strands.vertex_count);
  return {};
}

std::uint32_t OpacityMapGpu::dispatches_per_frame(const GpuStrands& strands) const {
  return strands.segment_count == 0 || strands.vertex_count == 0 ? 0 : 4;
}

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"opacity_map", &OpacityMapGpu::create};
  return method;
}

}  // namespace cuticle::shadows::opacity_map
