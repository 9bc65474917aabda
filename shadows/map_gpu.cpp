#include <cuticle/shadows/map_gpu.h>

#include <algorithm>

#include <cuticle/shadows/splat.glslh>

#include <map_fit_comp.spv.h>
#include <map_scan_comp.spv.h>

namespace cuticle::shadows {

MapPush map_push(const LightAxes& axes, const MapSettings& settings, float intervals, std::uint32_t layers,
                 double scale) {
  return {{axes.right, 0},
          {axes.up, 0},
          {axes.forward, 0},
          intervals,
          float(settings.filter_texels),
          float(settings.filter_radius),
          float(-settings.accumulation.k / scale),
          settings.resolution,
          layers,
          0,
          settings.accumulation.poisson ? k_poisson_flag : 0};
}

Result<gpu::Kernel> make_map_kernel(gpu::Device& device, std::span<const std::uint32_t> code, std::uint32_t buffers) {
  return device.make_kernel(code, gpu::ShaderInterface{buffers, 0, sizeof(MapPush)});
}

Result<gpu::Kernel> make_fit_kernel(gpu::Device& device) { return make_map_kernel(device, map_fit_comp, 2); }

Result<gpu::Kernel> make_scan_kernel(gpu::Device& device) { return make_map_kernel(device, map_scan_comp, 1); }

void dispatch_map(gpu::Commands& commands, std::string_view pass, const gpu::Kernel& kernel,
                  std::initializer_list<const gpu::Buffer*> buffers, MapPush push, std::uint32_t count) {
  const std::uint32_t groups = (count + 63) / 64, across = std::min(groups, 32768u);
  push.count = count;
  commands.begin_pass(pass);
  commands.dispatch(kernel, buffers, {}, gpu::bytes_of(push), across, (groups + across - 1) / across);
  commands.end_pass();
}

Result<void> DepositBuffer::make(gpu::Device& device, const Accumulation& accumulation,
                                 std::vector<std::uint32_t> extra) {
  accumulation_ = accumulation;
  extra_ = std::move(extra);
  CUTICLE_ASSIGN(buffer_, device.make_buffer(4ull * (k_coverage_steps + 1 + extra_.size())));
  return {};
}

Result<void> DepositBuffer::update(gpu::Device& device, double alpha, std::size_t segments) {
  if (!(alpha >= 0 && alpha <= 1)) return usage_error("alpha must lie in 0 .. 1");
  const double scale = fixed_point_scale(alpha, accumulation_, segments);
  if (alpha == alpha_ && scale == scale_) return {};
  std::vector<std::uint32_t> table = deposit_table(alpha, accumulation_, scale);
  table.insert(table.end(), extra_.begin(), extra_.end());
  CUTICLE_TRY(device.upload(buffer_, std::as_bytes(std::span<const std::uint32_t>(table))));
  alpha_ = alpha;
  scale_ = scale;
  return {};
}

}  // namespace cuticle::shadows
