#pragma once
// GPU half of a render pass, and the resources that the passes of one frame share.
#include <memory>

#include <cuticle/core/view.h>
#include <cuticle/gpu/device.h>
#include <cuticle/lut/table_set.h>
#include <cuticle/render/pass.h>
#include <cuticle/shadows/method_gpu.h>
#include <cuticle/strands/mesh.h>

namespace cuticle::render {

/// What the passes of a frame read and write. Pointers are null where the plan left the producer out.
struct FrameResources {
  Camera camera;
  std::vector<Light> lights;
  shadows::GpuStrands strands;                         ///< drawn strands: vec4 (position, radius) per vertex
  const gpu::Buffer* tangents = nullptr;               ///< vec4 (unit tangent, fraction of the strand's length) per vertex
  std::vector<const gpu::Buffer*> transmittance;       ///< per light: one float per vertex
  std::vector<const gpu::Texture*> tables;             ///< in the layout's order
  const lut::TableSet* table_set = nullptr;
  const strands::Mesh* head = nullptr;                 ///< rest pose
  glm::dmat4 head_transform{1};
  const gpu::Texture *color = nullptr, *depth = nullptr;   ///< targets, at supersampled size, samples as the device offers
  const gpu::Texture *resolved = nullptr;              ///< single-sample, supersampled size
  const gpu::Texture *output = nullptr;                ///< rgba32f or rgba16f, output size
  int supersampling = 2;
};

class GpuPass {
 public:
  virtual ~GpuPass() = default;
  virtual Result<void> record(gpu::Commands& commands, const FrameResources& resources) = 0;
};
struct GpuPassEntry {
  std::string_view name;
  Result<std::unique_ptr<GpuPass>> (*create)(std::shared_ptr<gpu::Device>, const FrameResources& resources);
};
std::span<const GpuPassEntry* const> gpu_passes();

}  // namespace cuticle::render
