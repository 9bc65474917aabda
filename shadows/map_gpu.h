#pragma once
// What the maps of the light's view share on the device.
#include <functional>
#include <span>

#include <glm/vec4.hpp>

#include "gpu/device.h"
#include "shadows/deposit.h"

namespace cuticle::shadows {

/// Push constants of map_geometry.glsl, word for word.
struct MapPush {
  glm::vec4 right, up, forward;
  float intervals, filter_texels, filter_radius, per_unit;
  std::uint32_t resolution, layers, count, flags;
  float pieces_per_step;
  float own[2];
  float fibre_width;
  float depth_offset;
  float caster_width;
  float reach;
  std::uint32_t segment_count;
  std::uint32_t strip_word = strip_word_of(0, 1, 0);
  float eye[3] = {};

  /// Strip i of a map in `count` strips of rows, with `margin` rows beside it.
  static constexpr std::uint32_t strip_word_of(std::uint32_t i, std::uint32_t count, std::uint32_t margin) {
    return i | (count << 8) | (margin << 16);
  }
};
/// Of `flags`: the parts of a segment, less 1, begin at this bit.
inline constexpr std::uint32_t k_parts_shift = 16;
inline constexpr std::uint32_t k_poisson_flag = 1, k_intervals_flag = 1u << 28, k_byte_target_flag = 1u << 29,
                               k_seen_flag = 1u << 30, k_square_flag = 1u << 31;

/// A kernel that several methods use: sums of each texel's layers along the depth, buffer sums, per texel.
std::span<const std::uint32_t> map_scan_code();

/// Further numbers that the table of deposits is followed by, for an opacity and integers per unit of sigma; always as
/// many.
using AfterDeposits = std::function<std::vector<std::uint32_t>(double alpha, double scale)>;

/// Deposits of one opacity, kept on the device until the opacity or the number of segments changes.
class DepositBuffer {
 public:
  Result<void> make(gpu::Device& device, const Accumulation& accumulation, AfterDeposits after);
  Result<void> update(gpu::Device& device, double alpha, std::size_t segments);
  const gpu::Buffer& buffer() const { return buffer_; }
  double scale() const { return scale_; }

 private:
  gpu::Buffer buffer_;
  Accumulation accumulation_;
  AfterDeposits after_;
  double alpha_ = -1, scale_ = 0;
};

}  // namespace cuticle::shadows
