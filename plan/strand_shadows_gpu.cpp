#include "plan/strand_shadows_gpu.h"

#include "render/lights_gpu.h"

namespace cuticle::plan {

Result<std::unique_ptr<StrandShadows>> StrandShadows::make(const std::shared_ptr<gpu::Device>& device,
                                                           const scene::Scene& scene, const Plan& plan,
                                                           render::FrameResources& resources) {
  const bool by_hair = scene.shadow && scene.shadow->name != "none" && find_pass(plan, scene.shadow->name);
  if (!by_hair && !find_pass(plan, "surface_shadow")) return std::unique_ptr<StrandShadows>();
  auto made = std::make_unique<StrandShadows>();
  resources.of_surfaces_alone = !by_hair;
  if (by_hair) {
    resources.channels = shadows::different_channels(resources.fibre_alpha);
    CUTICLE_TRY(made->make_methods(device, *scene.shadow, resources));
  }
  for (std::size_t k = 0; k < resources.lights.size() * resources.channels.count; ++k) {
    CUTICLE_ASSIGN(gpu::Buffer reached, device->make_buffer(resources.strands.vertex_count * sizeof(float)));
    made->transmittance_.push_back(std::move(reached));
  }
  for (const gpu::Buffer& buffer : made->transmittance_) resources.transmittance.push_back(&buffer);
  return made;
}

Result<void> StrandShadows::make_methods(const std::shared_ptr<gpu::Device>& device, const scene::Block& block,
                                         const render::FrameResources& resources) {
  CUTICLE_ASSIGN(const shadows::GpuMethod* method, shadows::find_gpu_method(block.name));
  CUTICLE_ASSIGN(const shadows::Method* twin, shadows::find_method(block.name));
  root_ = shadows::root_opacity(*twin, block.values, resources.channels);
  if (root_) {
    CUTICLE_ASSIGN(powers_, shadows::ChannelPowers::create(*device));
  }
  for (std::size_t k = 0; k < resources.lights.size() * (root_ ? 1 : resources.channels.count); ++k) {
    CUTICLE_ASSIGN(auto made, method->create(device, block.values));
    methods_.push_back(std::move(made));
  }
  return {};
}

Result<void> StrandShadows::record(gpu::Commands& commands, const render::FrameResources& resources) {
  constexpr std::uint32_t k_one = 0x3F800000;  // 1.0f
  const shadows::Channels& channels = resources.channels;
  if (methods_.empty())
    for (const gpu::Buffer& buffer : transmittance_) commands.fill(buffer, k_one);
  for (std::size_t k = 0; k < methods_.size(); ++k) {
    const std::size_t light = root_ ? k : k / channels.count, of = root_ ? *root_ : k % channels.count,
                      first = light * channels.count;
    CUTICLE_TRY(methods_[k]->record(commands, resources.casters, channels.alpha[of],
                                    render::source_of(resources.lights[light]), transmittance_[first + of]));
    for (std::size_t other = 0; root_ && other < channels.count; ++other)
      if (other != of)
        powers_.record(commands, transmittance_[first + of], channels.alpha[other] / channels.alpha[of],
                       transmittance_[first + other], resources.strands.vertex_count);
  }
  return {};
}

Result<render::Settled> StrandShadows::settle() {
  render::Settled settled;
  for (const auto& method : methods_) {
    CUTICLE_ASSIGN(const shadows::MapRoom room, method->settle());
    settled.holds = settled.holds && room.holds;
    if (!room.note.empty()) settled.notes.push_back(room.note);
  }
  return settled;
}

}  // namespace cuticle::plan
