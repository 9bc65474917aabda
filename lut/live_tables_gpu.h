#pragma once
// Tables whose model's parameters change while frames are drawn from them.
#include <optional>

#include "lut/bake_kernel_gpu.h"

namespace cuticle::lut {

/// What a rebake cost: the host's part, which a frame waits for; the device's, by timestamps (0 where it has none);
/// and the time from the request until the tables were swapped, which depends on how often `update` is called.
struct RebakeCost {
  double host_ms = 0, device_ms = 0, latency_ms = 0;
  std::uint32_t dispatches = 0;
};

/// Two sets of rgba16f textures: frames read the front one while the device bakes the back one, means over a texel's
/// azimuths included, with kernels compiled once; nothing is evaluated on the CPU. The tables equal those of `bake` to
/// half precision (2^-10 of the value plus 1e-6) where the model has its own means of N; elsewhere (marschner with
/// caustic=smoothed or variant=as_published; other models) a texel on a sharp peak is a quadrature
/// in float (LiveTables in lut_live_test). Values above 65504 are stored as 65504. Belongs to the device.
class LiveTables {
 public:
  /// Bakes the first tables and waits for them. Errors: usage for a layout with a channel that only the CPU makes; as
  /// bake; what the device says.
  static Result<LiveTables> make(gpu::Device& device, const bsdf::Model& model, const registry::ParameterValues& values,
                                 const Layout& layout, int size);
  /// Asks for tables of these values and returns at once. While a bake runs, the latest values asked for wait for it.
  /// Error: usage for values that the layout does not suit.
  Result<void> change(const registry::ParameterValues& values);
  /// Between frames: swaps where a bake has ended, and starts what waits. Does not wait. True where the front is new.
  Result<bool> update();
  /// Waits until the front has the latest values.
  Result<void> finish();
  bool is_baking() const { return running_.has_value(); }

  /// In the layout's order; they stay valid until the second swap after this call.
  std::span<const gpu::Texture> front() const { return textures_[front_]; }
  /// Layout, size and parameters of the front; its tables have scales of 1 and no pixels.
  const TableSet& set() const { return set_; }
  const RebakeCost& last_cost() const { return cost_; }

 private:
  LiveTables(gpu::Device& device, BakeKernel kernel) : device_(&device), kernel_(std::move(kernel)) {}
  Result<void> make_textures();
  Result<void> start(const registry::ParameterValues& values);
  Result<void> swap();

  gpu::Device* device_;
  BakeKernel kernel_;
  TableSet set_;
  gpu::Buffer texels_;
  std::array<std::vector<gpu::Texture>, 2> textures_;
  std::size_t front_ = 1;
  std::optional<gpu::Running> running_;
  registry::ParameterValues baking_;
  std::optional<registry::ParameterValues> waiting_;
  std::chrono::steady_clock::time_point started_;
  RebakeCost cost_;
};

}  // namespace cuticle::lut
