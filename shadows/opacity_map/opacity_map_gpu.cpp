#include <cuticle/shadows/opacity_map/opacity_map_gpu.h>

#include <bit>

#include <opacity_lookup_comp.spv.h>
#include <opacity_splat_comp.spv.h>

namespace cuticle::shadows::opacity_map {

Result<void> OpacityMapGpu::make() {
  const std::uint64_t texels = std::uint64_t(settings_.map.resolution) * settings_.map.resolution;
  CUTICLE_ASSIGN(sums_, device_->make_buffer(4 * texels * settings_.layers()));
  CUTICLE_TRY(deposits_.make(*device_, settings_.map.accumulation));
  CUTICLE_ASSIGN(box_, device_->make_buffer(4 * 6));
  CUTICLE_ASSIGN(fit_, make_fit_kernel(*device_));
  CUTICLE_ASSIGN(splat_, make_map_kernel(*device_, opacity_splat_comp, 5));
  CUTICLE_ASSIGN(scan_, make_scan_kernel(*device_));
  CUTICLE_ASSIGN(lookup_, make_map_kernel(*device_, opacity_lookup_comp, 4));
  return {};
}

Result<std::unique_ptr<GpuShadow>> OpacityMapGpu::create(std::shared_ptr<gpu::Device> device,
                                                         const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(const Settings settings, settings_from(values));
  std::unique_ptr<OpacityMapGpu> shadow(new OpacityMapGpu(std::move(device), settings));
  CUTICLE_TRY(shadow->make());
  return std::unique_ptr<GpuShadow>(std::move(shadow));
}

Result<void> OpacityMapGpu::record(gpu::Commands& commands, const GpuStrands& strands, double alpha,
                                   glm::dvec3 to_light, const gpu::Buffer& transmittance) {
  if (dispatches_per_frame(strands) == 0) {  // nothing casts a shadow
    if (strands.vertex_count > 0) commands.fill(transmittance, std::bit_cast<std::uint32_t>(1.0f));
    return {};
  }
  CUTICLE_ASSIGN(const glm::dvec3 direction, unit_to_light(to_light));
  CUTICLE_TRY(deposits_.update(*device_, alpha, strands.segment_count));
  const MapPush push =
      map_push(light_axes(direction), settings_.map, settings_.intervals(), settings_.layers(), deposits_.scale());
  const std::uint32_t texels = settings_.map.resolution * settings_.map.resolution;
  commands.begin_pass("shadow.clear");
  commands.fill(sums_, 0);
  commands.fill(box_, ~0u);
  commands.end_pass();
  dispatch_map(commands, "shadow.fit", fit_, {strands.vertices, &box_}, push, strands.vertex_count);
  dispatch_map(commands, "shadow.splat", splat_,
               {strands.vertices, strands.segments, &box_, &deposits_.buffer(), &sums_}, push, strands.segment_count);
  dispatch_map(commands, "shadow.scan", scan_, {&sums_}, push, texels);
  dispatch_map(commands, "shadow.lookup", lookup_, {strands.vertices, &box_, &sums_, &transmittance}, push,
               strands.vertex_count);
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
