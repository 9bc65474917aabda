#pragma once
// Deep opacity maps on the GPU: clear (fills), fit, nearest, histogram, layers, splat, scan, lookup; the integers of
// the map equal the CPU's.
#include <cuticle/shadows/deep_opacity/deep_map.h>
#include <cuticle/shadows/map_gpu.h>

namespace cuticle::shadows::deep_opacity {

/// Passes "shadow.clear", "shadow.fit", "shadow.nearest", "shadow.histogram", "shadow.layers", "shadow.splat",
/// "shadow.scan", "shadow.lookup". All records of one submission must share alpha and the number of segments, because
/// the table of deposits is uploaded when they change. A filter in metres is cut off at 64 texels.
class DeepOpacityGpu : public GpuShadow {
 public:
  /// Error: out_of_memory where the map passes the device's limits.
  static Result<std::unique_ptr<GpuShadow>> create(std::shared_ptr<gpu::Device> device,
                                                   const registry::ParameterValues& values);

  Result<void> record(gpu::Commands& commands, const GpuStrands& strands, double alpha, glm::dvec3 to_light,
                      const gpu::Buffer& transmittance) override;
  std::uint32_t dispatches_per_frame(const GpuStrands& strands) const override;
  std::size_t bytes() const override { return sums_.size() + nearest_.size(); }
  /// The map's integers as Map::sums, Map::nearest and Map::ends have them, after a submission.
  const gpu::Buffer& sums() const { return sums_; }
  const gpu::Buffer& nearest() const { return nearest_; }
  const gpu::Buffer& ends() const { return ends_; }

 private:
  DeepOpacityGpu(std::shared_ptr<gpu::Device> device, const Settings& settings)
      : device_(std::move(device)), settings_(settings) {}
  Result<void> make_buffers();
  Result<void> make_kernels();
  void record_clear(gpu::Commands& commands) const;

  std::shared_ptr<gpu::Device> device_;
  Settings settings_;
  DepositBuffer deposits_;
  gpu::Buffer sums_, nearest_, histogram_, ends_, box_;
  gpu::Kernel fit_, find_nearest_, count_depths_, spread_layers_, splat_, scan_, lookup_;
};

}  // namespace cuticle::shadows::deep_opacity
