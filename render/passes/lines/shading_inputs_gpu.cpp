#include "render/passes/lines/shading_inputs_gpu.h"

#include "render/passes/lines/lines.h"

namespace cuticle::render::lines {

namespace {

/// Of the model that strands are shaded by; null: they are not.
const registry::ParameterValues* values_of(const FrameResources& resources) {
  if (resources.evaluates_directly) return resources.model_values;
  return resources.table_set ? &resources.table_set->values : nullptr;
}

}  // namespace

Result<ShadingInputs> ShadingInputs::make(std::shared_ptr<gpu::Device> device, const FrameResources& resources) {
  ShadingInputs inputs;
  CUTICLE_ASSIGN(inputs.frame_buffer_, device->make_buffer(sizeof(Frame)));
  CUTICLE_ASSIGN(inputs.transmittance_, GatheredTransmittance::make(*device, resources));
  CUTICLE_ASSIGN(inputs.no_table_, device->make_texture({}));
  if (resources.evaluates_directly) {
    CUTICLE_ASSIGN(inputs.direct_, DirectScattering::make(*device, resources));
  }
  inputs.device_ = std::move(device);
  CUTICLE_TRY(inputs.take_tables(resources));
  return inputs;
}

Result<void> ShadingInputs::take_tables(const FrameResources& resources) {
  CUTICLE_ASSIGN(frame_, constant_part(resources));
  if (const registry::ParameterValues* values = values_of(resources)) values_ = *values;
  return {};
}

Result<Frame*> ShadingInputs::update(const FrameResources& resources) {
  const registry::ParameterValues* values = values_of(resources);
  if (values && *values != values_) CUTICLE_TRY(take_tables(resources));
  set_view(frame_, resources);
  return &frame_;
}

Result<void> ShadingInputs::record(gpu::Commands& commands, const FrameResources& resources) {
  CUTICLE_TRY(device_->upload(frame_buffer_, gpu::bytes_of(frame_)));
  transmittance_.record(commands, resources);
  if (direct_) CUTICLE_TRY(direct_->record(*device_, commands, resources, frame_buffer_));
  return {};
}

const gpu::Texture* ShadingInputs::table(const FrameResources& resources, std::size_t index) const {
  return index < resources.tables.size() ? resources.tables[index] : &no_table_;
}

}  // namespace cuticle::render::lines
