#include <cuticle/shadows/deep_opacity/deep_opacity_gpu.h>

#include <bit>

#include <deep_histogram_comp.spv.h>
#include <deep_layers_comp.spv.h>
#include <deep_lookup_comp.spv.h>
#include <deep_nearest_comp.spv.h>
#include <deep_splat_comp.spv.h>

namespace cuticle::shadows::deep_opacity {
namespace {

constexpr std::uint32_t k_equal_opacity_flag = 2;  // k_equal_opacity of deep_layers.comp

MapPush push_of(const glm::dvec3& to_light, const Settings& settings, double scale) {
  MapPush push = map_push(light_axes(to_light), settings.map, float(k_depth_steps), settings.layers, scale);
  if (settings.spacing == Spacing::equal_opacity) push.flags |= k_equal_opacity_flag;
  return push;
}

}  // namespace

Result<void> DeepOpacityGpu::make_buffers() {
  const std::uint64_t texels = std::uint64_t(settings_.map.resolution) * settings_.map.resolution;
  CUTICLE_ASSIGN(sums_, device_->make_buffer(4 * texels * settings_.layers));
  CUTICLE_ASSIGN(nearest_, device_->make_buffer(4 * texels));
  CUTICLE_ASSIGN(histogram_, device_->make_buffer(4 * k_depth_steps));
  CUTICLE_ASSIGN(ends_, device_->make_buffer(4 * k_most_layers));
  CUTICLE_ASSIGN(box_, device_->make_buffer(4 * 6));
  return deposits_.make(*device_, settings_.map.accumulation, layer_shares(settings_));
}

Result<void> DeepOpacityGpu::make_kernels() {
  CUTICLE_ASSIGN(fit_, make_fit_kernel(*device_));
  CUTICLE_ASSIGN(find_nearest_, make_map_kernel(*device_, deep_nearest_comp, 4));
  CUTICLE_ASSIGN(count_depths_, make_map_kernel(*device_, deep_histogram_comp, 5));
  CUTICLE_ASSIGN(spread_layers_, make_map_kernel(*device_, deep_layers_comp, 3));
  CUTICLE_ASSIGN(splat_, make_map_kernel(*device_, deep_splat_comp, 7));
  CUTICLE_ASSIGN(scan_, make_scan_kernel(*device_));
  CUTICLE_ASSIGN(lookup_, make_map_kernel(*device_, deep_lookup_comp, 6));
  return {};
}

Result<std::unique_ptr<GpuShadow>> DeepOpacityGpu::create(std::shared_ptr<gpu::Device> device,
                                                          const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  std::unique_ptr<DeepOpacityGpu> shadow(new DeepOpacityGpu(std::move(device), settings));
  CUTICLE_TRY(shadow->make_buffers());
  CUTICLE_TRY(shadow->make_kernels());
  return std::unique_ptr<GpuShadow>(std::move(shadow));
}

void DeepOpacityGpu::record_clear(gpu::Commands& commands) const {
  commands.begin_pass("shadow.clear");
  commands.fill(sums_, 0);
  commands.fill(histogram_, 0);
  commands.fill(nearest_, k_no_depth);
  commands.fill(box_, ~0u);
  commands.end_pass();
}

Result<void> DeepOpacityGpu::record(gpu::Commands& commands, const GpuStrands& strands, double alpha,
                                    glm::dvec3 to_light, const gpu::Buffer& transmittance) {
  if (dispatches_per_frame(strands) == 0) {  // nothing casts a shadow
    if (strands.vertex_count > 0) commands.fill(transmittance, std::bit_cast<std::uint32_t>(1.0f));
    return {};
  }
  CUTICLE_ASSIGN(const glm::dvec3 direction, unit_to_light(to_light));
  CUTICLE_TRY(deposits_.update(*device_, alpha, strands.segment_count));
  const MapPush push = push_of(direction, settings_, deposits_.scale());
  const gpu::Buffer *vertices = strands.vertices, *segments = strands.segments, *table = &deposits_.buffer();
  const std::uint32_t texels = settings_.map.resolution * settings_.map.resolution;
  record_clear(commands);
  dispatch_map(commands, "shadow.fit", fit_, {vertices, &box_}, push, strands.vertex_count);
  dispatch_map(commands, "shadow.nearest", find_nearest_, {vertices, segments, &box_, &nearest_}, push,
               strands.segment_count);
  dispatch_map(commands, "shadow.histogram", count_depths_, {vertices, segments, &box_, &nearest_, &histogram_}, push,
               strands.segment_count);
  dispatch_map(commands, "shadow.layers", spread_layers_, {table, &histogram_, &ends_}, push, 64);
  dispatch_map(commands, "shadow.splat", splat_, {vertices, segments, &box_, table, &nearest_, &ends_, &sums_}, push,
               strands.segment_count);
  dispatch_map(commands, "shadow.scan", scan_, {&sums_}, push, texels);
  dispatch_map(commands, "shadow.lookup", lookup_, {vertices, &box_, &nearest_, &ends_, &sums_, &transmittance}, push,
               strands.vertex_count);
  return {};
}

std::uint32_t DeepOpacityGpu::dispatches_per_frame(const GpuStrands& strands) const {
  return strands.segment_count == 0 || strands.vertex_count == 0 ? 0 : 7;
}

const GpuMethod& gpu_entry() {
  static const GpuMethod method{"deep_opacity", &DeepOpacityGpu::create};
  return method;
}

}  // namespace cuticle::shadows::deep_opacity
