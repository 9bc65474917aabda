#pragma once
// GPU half of a shadow method: a builder that fills its map from the strand buffer and writes one transmittance per
// vertex.
#include <memory>
#include <optional>
#include <string>

#include "gpu/device.h"
#include "shadows/method.h"

namespace cuticle::shadows {

/// Strands on the device: vec4 (position, radius) per vertex, and one uint per segment: the index of its first vertex.
struct GpuStrands {
  const gpu::Buffer* vertices = nullptr;  ///< vec4 x vertex_count
  const gpu::Buffer* segments = nullptr;  ///< uint x segment_count; each part joins vertex k and k + 1
  std::uint32_t vertex_count = 0, segment_count = 0;
  strands::Bounds bounds;  ///< of all vertices, metres; the light's frame is fitted to it
  /// So many segments of the list after each other lie on one line and cast as one, between vertex k and k +
  /// segment_parts; 1 .. 64. segment_count counts those that cast.
  std::uint32_t segment_parts = 1;
  float caster_width = 1;                   ///< factor on the radii of segments that cast shadows (H11)
  float fibre_width = 1;                    ///< Receivers::fibre_width
  std::optional<glm::vec3> seen_from = {};  ///< Receivers::seen_from
  /// A list of strands (strands/lod/strand_list_gpu.h) whose vertices receive shadow; null: all do. The transmittance
  /// of the others is left as it is.
  const gpu::Buffer* receivers = nullptr;
};

/// Whether a map had room for all that casts.
struct MapRoom {
  bool holds = true;      ///< false: more room was made; record and submit again
  std::string note = {};  ///< what the shadow lacks, one sentence; empty: nothing
};

/// A method's passes, recorded into a frame. `transmittance` receives one float per vertex. A point light's view is
/// fitted to the strands' bounds and what lies in them. Error: usage, for a light that light_axes or the method
/// refuses.
class GpuShadow {
 public:
  virtual ~GpuShadow() = default;
  virtual Result<void> record(gpu::Commands& commands, const GpuStrands& strands, double alpha,
                              const LightSource& light, const gpu::Buffer& transmittance) = 0;
  /// Records only that by which settle() learns how much room the map takes, which a first picture wants to know before
  /// it is filled. False: nothing was recorded, as the room is known or nothing casts. Errors: those of `record`.
  virtual Result<bool> record_counts(gpu::Commands&, const GpuStrands&, double, const LightSource&) { return false; }
  /// After a submission of `record`: what found no room is never left out without a word. Errors: of the device.
  virtual Result<MapRoom> settle() { return MapRoom{}; }
  /// Dispatches that `record` will make: what a plan prints.
  virtual std::uint32_t dispatches_per_frame(const GpuStrands& strands) const = 0;
  virtual std::size_t bytes() const = 0;
  /// The buffers of the map, whose words can be read after a submission and compared with GpuMethod::cpu_map.
  virtual std::vector<const gpu::Buffer*> map_buffers() const { return {}; }
  /// The textures of a map that is drawn, in the order of its numbers.
  virtual std::vector<const gpu::Texture*> map_targets() const { return {}; }
};
/// The integers of a map, buffer by buffer.
using MapWords = std::vector<std::vector<std::uint32_t>>;
struct GpuMethod {
  std::string_view name;
  Result<std::unique_ptr<GpuShadow>> (*create)(std::shared_ptr<gpu::Device>, const registry::ParameterValues&);
  /// What the CPU's map holds where the first of map_buffers() must hold the same words
  /// (MapGpu_SameGroom_SameIntegers); null where no integers are promised. Casters and values must be sound.
  Result<MapWords> (*cpu_map)(const Casters&, const registry::ParameterValues&) = nullptr;
};
std::span<const GpuMethod* const> gpu_methods();
Result<const GpuMethod*> find_gpu_method(std::string_view name);

}  // namespace cuticle::shadows
