#pragma once
// What the maps of the light's view share on the device.
#include <initializer_list>
#include <string_view>

#include <glm/vec4.hpp>

#include <cuticle/gpu/device.h>
#include <cuticle/shadows/light_frame.h>
#include <cuticle/shadows/map_settings.h>
#include <cuticle/shadows/method_gpu.h>

namespace cuticle::shadows {

/// Push constants of map_geometry.glsl, word for word.
struct MapPush {
  glm::vec4 right, up, forward;
  float intervals, filter_texels, filter_radius, per_unit;
  std::uint32_t resolution, layers, count, flags;
};
inline constexpr std::uint32_t k_poisson_flag = 1;
/// `intervals`: depth steps of the view; `layers`: numbers a texel; `scale`: integers per unit of sigma.
MapPush map_push(const LightAxes& axes, const MapSettings& settings, float intervals, std::uint32_t layers,
                 double scale);

/// A kernel of maps with that many storage buffers.
Result<gpu::Kernel> make_map_kernel(gpu::Device& device, std::span<const std::uint32_t> code, std::uint32_t buffers);
/// The kernel that finds the box of the vertices: buffers vertices, box (6 words, filled with ones before).
Result<gpu::Kernel> make_fit_kernel(gpu::Device& device);
/// The kernel that sums each texel's layers along the depth: buffer sums; one invocation per texel.
Result<gpu::Kernel> make_scan_kernel(gpu::Device& device);

/// A pass of one dispatch with `count` invocations in groups of 64.
void dispatch_map(gpu::Commands& commands, std::string_view pass, const gpu::Kernel& kernel,
                  std::initializer_list<const gpu::Buffer*> buffers, MapPush push, std::uint32_t count);

/// Deposits of one opacity, kept on the device until the opacity or the number of segments changes.
class DepositBuffer {
 public:
  /// `extra`: further numbers that the table is followed by.
  Result<void> make(gpu::Device& device, const Accumulation& accumulation, std::vector<std::uint32_t> extra = {});
  Result<void> update(gpu::Device& device, double alpha, std::size_t segments);
  const gpu::Buffer& buffer() const { return buffer_; }
  double scale() const { return scale_; }

 private:
  gpu::Buffer buffer_;
  Accumulation accumulation_;
  std::vector<std::uint32_t> extra_;
  double alpha_ = -1, scale_ = 0;
};

}  // namespace cuticle::shadows
