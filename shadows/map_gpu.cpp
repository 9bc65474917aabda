#include "shadows/map_gpu.h"

#include "shadows/splat.glslh"

#include <map_scan_comp.spv.h>

namespace cuticle::shadows {

std::span<const std::uint32_t> map_scan_code() { return map_scan_comp; }

Result<void> DepositBuffer::make(gpu::Device& device, const Accumulation& accumulation, AfterDeposits after) {
  accumulation_ = accumulation;
  after_ = std::move(after);
  const std::size_t more = after_ ? after_(1, 1).size() : 0;
  CUTICLE_ASSIGN(buffer_, device.make_buffer(4ull * (k_coverage_steps + 1 + more)));
  return {};
}

Result<void> DepositBuffer::update(gpu::Device& device, double alpha, std::size_t segments) {
  if (!(alpha >= 0 && alpha <= 1)) return usage_error("alpha must lie in 0 .. 1");
  const double scale = fixed_point_scale(alpha, accumulation_, segments);
  if (alpha == alpha_ && scale == scale_) return {};
  std::vector<std::uint32_t> table = deposit_table(alpha, accumulation_, scale);
  if (after_) {
    const std::vector<std::uint32_t> more = after_(alpha, scale);
    table.insert(table.end(), more.begin(), more.end());
  }
  CUTICLE_TRY(device.upload(buffer_, std::as_bytes(std::span<const std::uint32_t>(table))));
  alpha_ = alpha;
  scale_ = scale;
  return {};
}

}  // namespace cuticle::shadows
