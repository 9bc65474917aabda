#pragma once
// GPU half of a render pass.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image/deep.h"
#include "gpu/device.h"
#include "render/frame.h"
#include "render/inputs.h"
#include "render/pass.h"
#include "render/resources_gpu.h"
#include "render/strands_gpu.h"
#include "render/targets_gpu.h"

namespace cuticle::render {

/// What a pass says of the submission that it was recorded into.
struct Settled {
  bool holds = true;                    ///< false: its buffers were too small and have grown; the frame is drawn again
  std::vector<std::string> notes = {};  ///< what was left out of the picture, one sentence each
};

/// What each pixel sees of each strand (objects from 1), and how far behind it what is no hair stands, metres along the
/// view; 0: nothing.
struct SeenStrands {
  std::vector<SeenShare> shares;
  std::vector<float> behind;
};

/// Floats of a picture's pixels, for its file.
struct FileLayer {
  const gpu::Buffer* values = nullptr;
  std::span<const std::string_view> channels;  ///< their names: so many floats a pixel
};

/// The runner opens the pass of the entry's name around `record`.
class GpuPass {
 public:
  virtual ~GpuPass() = default;
  /// Adds what other passes read and this one owns; called before the later ones are made, and after take_parameters.
  virtual void publish(Resources&) const {}
  /// The model of FibreMaterial, which the pass reads, has other parameters: takes them on for the frames to come.
  /// False: the pass must be made anew. Error: of parameters that it refuses; the pass is then not to be used.
  virtual Result<bool> take_parameters(const Resources&) { return false; }
  /// What the pass wants of a frame's view, before anything is recorded.
  virtual void change_view(FrameView&, const PassParameters&) const {}
  /// After the submission: the picture, of a pass that makes it on the CPU.
  virtual Result<std::optional<Image>> finish(const Resources&) { return std::optional<Image>(); }
  /// After the submission and before `finish`, of a pass that draws strands and can tell them apart.
  virtual Result<std::optional<SeenStrands>> seen_strands(const Resources&) { return std::optional<SeenStrands>(); }
  /// What of a wanted resource goes into the picture's file.
  virtual std::optional<FileLayer> layer(std::string_view, const Resources&) const { return std::nullopt; }
  virtual Result<Settled> settle() { return Settled{}; }
  virtual Result<void> record(gpu::Commands& commands, const Resources& resources) = 0;
};
struct GpuPassEntry {
  std::string_view name;
  /// Makes pipelines for the targets, tables, head and parameters named in `resources`; these stay alive and unchanged.
  Result<std::unique_ptr<GpuPass>> (*create)(std::shared_ptr<gpu::Device>, const Resources& resources);
  /// Dispatches of a frame, where they depend on the device; null: as the pass's entry says.
  std::uint32_t (*dispatches)(const gpu::DeviceInfo&, const PassParameters&, const registry::FrameShape&) = nullptr;
};
std::span<const GpuPassEntry* const> gpu_passes();

}  // namespace cuticle::render
