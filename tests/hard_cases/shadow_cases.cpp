// Shadow methods: {"method", "set", "groom", "alpha", "to_light"} gives the transmittance at every vertex of the groom.

#include "core/json/json.h"
#include "shadows/method.h"
#include "tests/hard_cases/subject.h"
#ifdef CUTICLE_HAS_GPU
#include "shadows/groom_gpu.h"
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {
namespace {

struct ShadowSetting {
  const shadows::Method* method = nullptr;
  registry::ParameterValues values;
  strands::Groom groom;
  double alpha = 0;
  glm::dvec3 to_light{0};
};

Result<ShadowSetting> setting_from(const Json& inputs) {
  ShadowSetting setting;
  CUTICLE_ASSIGN(setting.method, shadows::find_method(inputs.value("method", std::string("opacity_map"))));
  CUTICLE_ASSIGN(setting.values,
                 registry::parse_assignments(setting.method->entry.parameters, inputs.value("set", std::string())));
  setting.groom = groom_from(inputs.at("groom"));
  setting.alpha = inputs.value("alpha", 0.4);
  setting.to_light = inputs.contains("to_light") ? vector(inputs.at("to_light")) : glm::dvec3(0, 1, 0);
  return setting;
}

}  // namespace

Result<Values> run_shadow_f32(const Json& inputs, GpuSession*) {
  CUTICLE_ASSIGN(const ShadowSetting setting, setting_from(inputs));
  const shadows::Casters casters{&setting.groom, setting.alpha, setting.to_light};
  std::vector<std::uint32_t> strands;
  for (std::uint32_t s = 0; s < setting.groom.strand_count(); ++s) strands.resize(setting.groom.offsets[s + 1], s);
  CUTICLE_ASSIGN(const shadows::Transmittance transmittance,
                 setting.method->evaluate(casters, {setting.groom.positions, strands}, setting.values));
  return Values(transmittance.values.begin(), transmittance.values.end());
}

#ifdef CUTICLE_HAS_GPU
Result<Values> run_shadow_gpu(const Json& inputs, GpuSession* session) {
  const std::shared_ptr<gpu::Device>& device = session->device;
  CUTICLE_ASSIGN(const ShadowSetting setting, setting_from(inputs));
  CUTICLE_ASSIGN(const shadows::GpuMethod* method, shadows::find_gpu_method(setting.method->entry.name));
  CUTICLE_ASSIGN(const std::unique_ptr<shadows::GpuShadow> shadow, method->create(device, setting.values));
  CUTICLE_ASSIGN(const auto uploaded, shadows::upload_groom(*device, setting.groom));
  for (bool holds = false; !holds;) {
    gpu::Commands commands = device->record();
    CUTICLE_TRY(shadow->record(commands, uploaded->strands, setting.alpha, {setting.to_light}, uploaded->transmittance));
    CUTICLE_TRY(device->submit(std::move(commands)));
    CUTICLE_ASSIGN(const shadows::MapRoom room, shadow->settle());
    holds = room.holds;
  }
  CUTICLE_ASSIGN(const std::vector<float> values,
                 gpu::read_buffer<float>(*device, uploaded->transmittance, setting.groom.vertex_count()));
  return Values(values.begin(), values.end());
}
#endif

}  // namespace cuticle::hard_cases
