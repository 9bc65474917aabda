#include "render/hair_shadows_gpu.h"

#include <utility>

#include "render/lights_gpu.h"
#include "render/passes/strands_in_sight/strands_in_sight_gpu.h"

namespace cuticle::render {

Result<std::unique_ptr<GpuPass>> HairShadows::create(const std::shared_ptr<gpu::Device>& device,
                                                     std::string_view method, const registry::ParameterValues& values,
                                                     const Resources& resources) {
  auto made = std::make_unique<HairShadows>();
  made->channels_ = shadows::different_channels(resources.get<FibreOpacity>().alpha);
  const std::size_t lights = resources.get<Lights>().all.size();
  CUTICLE_TRY(made->make_methods(device, method, values, lights));
  for (std::size_t k = 0; k < lights * made->channels_.count; ++k) {
    CUTICLE_ASSIGN(gpu::Buffer reached,
                   device->make_buffer(resources.get<DrawnHair>().strands.vertex_count * sizeof(float)));
    made->transmittance_.push_back(std::move(reached));
  }
  return std::unique_ptr<GpuPass>(std::move(made));
}

Result<void> HairShadows::make_methods(const std::shared_ptr<gpu::Device>& device, std::string_view name,
                                       const registry::ParameterValues& values, std::size_t lights) {
  CUTICLE_ASSIGN(const shadows::GpuMethod* method, shadows::find_gpu_method(name));
  CUTICLE_ASSIGN(const shadows::Method* twin, shadows::find_method(name));
  root_ = shadows::root_opacity(*twin, values, channels_);
  if (root_) {
    CUTICLE_ASSIGN(powers_, shadows::ChannelPowers::create(*device));
  }
  for (std::size_t k = 0; k < lights * (root_ ? 1 : channels_.count); ++k) {
    CUTICLE_ASSIGN(auto made, method->create(device, values));
    methods_.push_back(std::move(made));
  }
  return {};
}

void HairShadows::publish(Resources& resources) const {
  HairTransmittance found{.channels = channels_};
  for (const gpu::Buffer& buffer : transmittance_) found.reached.push_back(&buffer);
  resources.put(std::move(found));
}

HairShadows::Task HairShadows::task_of(std::size_t method) const {
  if (root_) return {method, *root_};
  return {method / channels_.count, method % channels_.count};
}

Result<void> HairShadows::record_counts(gpu::Commands& commands, const Resources& resources,
                                        const shadows::GpuStrands& strands) {
  for (std::size_t k = 0; k < methods_.size(); ++k) {
    const Task task = task_of(k);
    const shadows::LightSource source = source_of(resources.get<Lights>().all[task.light]);
    CUTICLE_ASSIGN(const bool counts,
                   methods_[k]->record_counts(commands, strands, channels_.alpha[task.channel], source));
    only_counts_ = only_counts_ || counts;
  }
  return {};
}

Result<void> HairShadows::record(gpu::Commands& commands, const Resources& resources) {
  const DrawnHair& hair = resources.get<DrawnHair>();
  shadows::GpuStrands strands = hair.casters;
  if (const auto* const seen = resources.find<strands_in_sight::StrandsInSight>()) strands.receivers = &seen->list;
  if (!std::exchange(has_counted_, true)) CUTICLE_TRY(record_counts(commands, resources, strands));
  if (only_counts_) return {};
  for (std::size_t k = 0; k < methods_.size(); ++k) {
    const auto [light, of] = task_of(k);
    const std::size_t first = light * channels_.count;
    CUTICLE_TRY(methods_[k]->record(commands, strands, channels_.alpha[of],
                                    source_of(resources.get<Lights>().all[light]), transmittance_[first + of]));
    for (std::size_t other = 0; root_ && other < channels_.count; ++other)
      if (other != of)
        powers_.record(commands, transmittance_[first + of], channels_.alpha[other] / channels_.alpha[of],
                       transmittance_[first + other], hair.strands.vertex_count);
  }
  return {};
}

Result<Settled> HairShadows::settle() {
  Settled settled{.holds = !std::exchange(only_counts_, false)};
  for (const auto& method : methods_) {
    CUTICLE_ASSIGN(const shadows::MapRoom room, method->settle());
    settled.holds = settled.holds && room.holds;
    if (!room.note.empty()) settled.notes.push_back(room.note);
  }
  return settled;
}

}  // namespace cuticle::render
