#pragma once
// The lights' transmittance at the vertices of drawn strands: by the scene's shadow method, once for each opacity that
// the channels do not share, or once for all where powers of it give the rest.
#include <memory>
#include <optional>
#include <vector>

#include "plan/plan.h"
#include "render/pass_gpu.h"
#include "shadows/channels_gpu.h"

namespace cuticle::plan {

class StrandShadows : public render::GpuPass {
 public:
  /// What the plan has of shadows, and its buffers in `resources`, whose lights, strands and opacity are there. Null
  /// where nothing shadows strands. Errors: of the device, and of the method.
  static Result<std::unique_ptr<StrandShadows>> make(const std::shared_ptr<gpu::Device>& device,
                                                     const scene::Scene& scene, const Plan& plan,
                                                     render::FrameResources& resources);
  /// By the `casters` of `resources`. Errors: the method's.
  Result<void> record(gpu::Commands& commands, const render::FrameResources& resources) override;
  /// What the methods say of their maps' room.
  Result<render::Settled> settle() override;

 private:
  Result<void> make_methods(const std::shared_ptr<gpu::Device>& device, const scene::Block& block,
                            const render::FrameResources& resources);

  std::vector<std::unique_ptr<shadows::GpuShadow>> methods_;  ///< one per buffer, or per light by the root, or none
  std::vector<gpu::Buffer> transmittance_;                    ///< FrameResources::transmittance
  std::optional<std::uint32_t> root_;                         ///< shadows::root_opacity
  shadows::ChannelPowers powers_;                             ///< made where there is a root
};

}  // namespace cuticle::plan
