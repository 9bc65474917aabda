#pragma once
// N17 on the GPU: clear (fills), fit, splat, scan, lookup; the integers of its map equal the CPU's.
#include <cuticle/shadows/map_gpu.h>
#include <cuticle/shadows/opacity_map/map.h>

namespace cuticle::shadows::opacity_map {

/// Passes "shadow.clear", "shadow.fit", "shadow.splat", "shadow.scan", "shadow.lookup". All records of one submission
/// must share alpha and the number of segments, because the table of deposits is uploaded when they change. The light's
/// view is fitted to the vertices as they are on the device; a filter in metres is cut off at 64 texels.
class OpacityMapGpu : public GpuShadow {
 public:
  /// Error: out_of_memory where the map passes the device's limits.
  static Result<std::unique_ptr<GpuShadow>> create(std::shared_ptr<gpu::Device> device,
                                                   const registry::ParameterValues& values);

  Result<void> record(gpu::Commands& commands, const GpuStrands& strands, double alpha, glm::dvec3 to_light,
                      const gpu::Buffer& transmittance) override;
  std::uint32_t dispatches_per_frame(const GpuStrands& strands) const override;
  std::size_t bytes() const override { return sums_.size(); }
  /// The map's integers as Map::sums has them, after a submission.
  const gpu::Buffer& sums() const { return sums_; }

 private:
  OpacityMapGpu(std::shared_ptr<gpu::Device> device, const Settings& settings)
      : device_(std::move(device)), settings_(settings) {}
  Result<void> make();

  std::shared_ptr<gpu::Device> device_;
  Settings settings_;
  DepositBuffer deposits_;
  gpu::Buffer sums_, box_;
  gpu::Kernel fit_, splat_, scan_, lookup_;
};

}  // namespace cuticle::shadows::opacity_map
