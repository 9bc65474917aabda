#include <cuticle/render/passes/lines/shading_inputs_gpu.h>

#include <algorithm>

#include <cuticle/render/passes/lines/lines.h>

namespace cuticle::render::lines {

Result<ShadingInputs> ShadingInputs::make(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  ShadingInputs inputs;
  const std::size_t lights = std::max<std::size_t>(1, resources.lights.size());
  CUTICLE_ASSIGN(inputs.frame_buffer_, device->make_buffer(sizeof(Frame)));
  const std::size_t values = lights * resources.channels.count * resources.strands.vertex_count;
  CUTICLE_ASSIGN(inputs.transmittance_, device->make_buffer(values * sizeof(float)));
  CUTICLE_ASSIGN(inputs.no_table_, device->make_texture({}));
  inputs.device_ = std::move(device);
  CUTICLE_TRY(inputs.take_tables(resources));
  return inputs;
}

Result<void> ShadingInputs::take_tables(const FrameResources& resources) {
  CUTICLE_ASSIGN(frame_, constant_part(resources, parameters_of(resources, entry())));
  if (resources.table_set) values_ = resources.table_set->values;
  return {};
}

Result<Frame*> ShadingInputs::update(const FrameResources& resources) {
  if (resources.table_set && resources.table_set->values != values_) CUTICLE_TRY(take_tables(resources));
  set_view(frame_, resources);
  return &frame_;
}

Result<void> ShadingInputs::record(gpu::Commands& commands, const FrameResources& resources) {
  CUTICLE_TRY(device_->upload(frame_buffer_, gpu::bytes_of(frame_)));
  gather_transmittance(commands, resources);
  return {};
}

/// One buffer for all lights; 1 everywhere where nothing shadows.
void ShadingInputs::gather_transmittance(gpu::Commands& commands, const FrameResources& resources) {
  const std::size_t bytes = resources.strands.vertex_count * sizeof(float);
  constexpr std::uint32_t k_one = 0x3F800000;  // 1.0f
  if (resources.transmittance.empty()) commands.fill(transmittance_, k_one);
  for (std::size_t k = 0; k < resources.transmittance.size(); ++k)
    commands.copy(*resources.transmittance[k], transmittance_, bytes, 0, k * bytes);
}

const gpu::Texture* ShadingInputs::table(const FrameResources& resources, std::size_t index) const {
  return index < resources.tables.size() ? resources.tables[index] : &no_table_;
}

}  // namespace cuticle::render::lines
