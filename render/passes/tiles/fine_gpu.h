#pragma once
// How the fine rasteriser reads and draws segments: for the pass that draws and the one that looks for what shows.
#include <vector>

#include "render/pass_gpu.h"
#include "render/passes/tile_lists/tile_lists_gpu.h"

namespace cuticle::render::tiles {

/// By spans of samples or by areas, from records or from vertices, a tile by how many lanes.
struct FineForm {
  bool spans = false, reads_records = false;
  std::uint32_t rows = 1, lanes = 8;
  std::uint32_t parts = 1;    ///< tile_lists::listed_parts
  bool lets_through = false;  ///< by spans, of strands that a level of detail may let light through
};
/// The form of a picture whose strands are sorted, or blended by slices.
FineForm fine_form(const gpu::DeviceInfo& device, const Resources& resources);

/// Of the fine rasteriser's kernels, by how many buffers they bind; `says_seen`: they write SeenHair.
gpu::ShaderInterface fine_interface(const FineForm& form, std::uint32_t buffers, bool says_seen);

/// Segments projected once a frame, which the lanes of a tile read on software Vulkan.
class Records {
 public:
  /// Errors: of the device.
  static Result<Records> make(gpu::Device& device, const Resources& resources);
  /// Without colours (null) for what only looks where segments are.
  void record(gpu::Commands& commands, const Resources& resources, const tile_lists::TilePush& push,
              const gpu::Buffer* colors) const;
  const gpu::Buffer& all() const { return all_; }

 private:
  /// What projects some of the segments, as many as one binding holds records.
  struct Part {
    gpu::Kernel colored, bare;
    gpu::Buffer records;  ///< a part of all
  };
  gpu::Buffer all_;
  std::vector<Part> parts_;
};
/// Dispatches of Records::record; 0 where nothing reads records.
std::uint32_t prepare_dispatches(const gpu::DeviceInfo& device, const PassParameters& parameters,
                                 const registry::FrameShape& shape);

}  // namespace cuticle::render::tiles
