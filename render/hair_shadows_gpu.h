#pragma once
// The lights' transmittance at the vertices of drawn strands: by a shadow method, once for each opacity that the
// channels do not share, or once for all where powers of it give the rest.
#include <memory>
#include <optional>
#include <vector>

#include "render/pass_gpu.h"
#include "shadows/channels_gpu.h"

namespace cuticle::render {

class HairShadows : public GpuPass {
 public:
  /// By the method of that name, of the casters, lights and opacity in `resources`. Errors: of the device, and of the
  /// method.
  static Result<std::unique_ptr<GpuPass>> create(const std::shared_ptr<gpu::Device>& device, std::string_view method,
                                                 const registry::ParameterValues& values, const Resources& resources);
  /// HairTransmittance.
  void publish(Resources& resources) const override;
  /// Errors: the method's.
  Result<void> record(gpu::Commands& commands, const Resources& resources) override;
  /// What the methods say of their maps' room.
  Result<Settled> settle() override;

 private:
  Result<void> make_methods(const std::shared_ptr<gpu::Device>& device, std::string_view name,
                            const registry::ParameterValues& values, std::size_t lights);
  /// One of `methods_`: whose light it shadows, and by which of the channels' opacities.
  struct Task {
    std::size_t light, channel;
  };
  Task task_of(std::size_t method) const;
  Result<void> record_counts(gpu::Commands& commands, const Resources& resources, const shadows::GpuStrands& strands);

  std::vector<std::unique_ptr<shadows::GpuShadow>> methods_;  ///< one per buffer, or per light by the root
  shadows::Channels channels_;
  std::vector<gpu::Buffer> transmittance_;  ///< HairTransmittance::reached
  std::optional<std::uint32_t> root_;       ///< shadows::root_opacity
  shadows::ChannelPowers powers_;           ///< made where there is a root
  bool has_counted_ = false, only_counts_ = false;  ///< ever; what the last record did
};

}  // namespace cuticle::render
