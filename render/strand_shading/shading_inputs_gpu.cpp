#include "render/strand_shading/shading_inputs_gpu.h"

#include "render/passes/bake_tables/bake_tables_gpu.h"

namespace cuticle::render::strand_shading {

Result<ShadingInputs> ShadingInputs::make(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  ShadingInputs inputs;
  CUTICLE_ASSIGN(inputs.frame_buffer_, device->make_buffer(sizeof(Frame)));
  CUTICLE_ASSIGN(inputs.transmittance_, GatheredTransmittance::make(*device, resources));
  CUTICLE_ASSIGN(inputs.no_table_, device->make_texture({}));
  if (resources.get<FibreMaterial>().evaluates_directly) {
    CUTICLE_ASSIGN(inputs.direct_, DirectScattering::make(*device, resources));
  }
  inputs.device_ = std::move(device);
  CUTICLE_ASSIGN(inputs.frame_, constant_part(resources));
  return inputs;
}

Result<bool> ShadingInputs::take_parameters(const Resources& resources) {
  if (direct_) CUTICLE_TRY(direct_->take_parameters(*device_, resources));
  CUTICLE_ASSIGN(frame_, constant_part(resources));
  return true;
}

Frame& ShadingInputs::update(const Resources& resources) {
  set_view(frame_, resources);
  return frame_;
}

Result<void> ShadingInputs::record(gpu::Commands& commands, const Resources& resources, const gpu::Buffer* listed) {
  CUTICLE_TRY(device_->upload(frame_buffer_, gpu::bytes_of(frame_)));
  transmittance_.record(commands, resources);
  if (direct_) direct_->record(commands, resources, frame_buffer_, listed);
  return {};
}

const gpu::Texture* ShadingInputs::table(const Resources& resources, std::size_t index) const {
  const auto* const tables = resources.find<bake_tables::Tables>();
  return tables && index < tables->textures.size() ? tables->textures[index] : &no_table_;
}

}  // namespace cuticle::render::strand_shading
