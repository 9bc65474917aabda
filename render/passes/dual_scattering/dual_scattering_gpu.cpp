#include "render/passes/dual_scattering/dual_scattering_gpu.h"
#include "bsdf/dual_scattering/corrections.h"
#include "bsdf/dual_scattering/kept_terms.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/surface_shadow/surface_shadow_gpu.h"
#include "strands/thickness.h"

namespace cuticle::render::dual_scattering {

namespace {

// The shader reads what is appended here in this order, and this number of rows.
static_assert(bsdf::k_dual_scattering_rows == 32);
static_assert(bsdf::dual_scattering::k_depths == 8 && bsdf::dual_scattering::k_angles == 9);

void append(const bsdf::HalfScattering& half, std::vector<glm::vec4>& terms) {
  terms.emplace_back(half.share, 0);
  terms.emplace_back(half.shift, 0);
  terms.emplace_back(half.deviation * half.deviation, 0);
}

/// Of each channel, by the albedo at inclination 0 and the thickness of the hair as shadows have it: a crossing of
/// opacity a counts as a fibres. Without the strands at rest nothing is corrected.
void append_corrections(const bsdf::DualScatteringTable& table, const Resources& resources, Corrections wanted,
                        std::vector<glm::vec4>& terms) {
  const RestStrands* const rest = resources.find<RestStrands>();
  const bool fitted = wanted == Corrections::path_tracing && rest && rest->groom;
  const Surfaces* const surfaces = resources.find<Surfaces>();
  const auto within = surfaces && surfaces->head ? bsdf::dual_scattering::Within::hair_on_head
                                                 : bsdf::dual_scattering::Within::hair_alone;
  const double thickness = fitted ? strands::optical_thickness(*rest->groom) : 1;
  const auto& average = table.rows[table.rows.size() / 2].average;
  for (int c = 0; c < 3; ++c) {
    bsdf::dual_scattering::Corrections rows;
    if (fitted)
      rows = bsdf::dual_scattering::corrections_of(bsdf::dual_scattering::fitted_corrections(within),
                                                   average.forward.share[c] + average.backward.share[c],
                                                   thickness * resources.get<FibreOpacity>().alpha[c]);
    for (const auto& row : rows.depths) terms.emplace_back(row.onward, row.back, row.diffuse, 0);
    for (const auto& row : rows.angles) terms.emplace_back(row.onward, row.back, row.diffuse, 0);
  }
}

Result<gpu::Buffer> make_terms(gpu::Device& device, const Resources& resources) {
  const FibreMaterial& material = resources.get<FibreMaterial>();
  const lut::TableSet* set = bake_tables::table_set_of(resources);
  const bsdf::Model& model = set ? *set->model : *material.model;
  CUTICLE_ASSIGN(const bsdf::DualScatteringTable table,
                 bsdf::kept_dual_scattering_terms(model, set ? set->values : *material.values));
  const auto parameters = parameters_of<Parameters>(resources);
  const double spread = parameters.direction_spread;
  std::vector<glm::vec4> terms = {{parameters.forward_density, parameters.backward_density, spread * spread, 0}};
  for (const bsdf::DualScatteringRow& row : table.rows) {
    append(row.average.forward, terms);
    append(row.average.backward, terms);
    append({row.multiple.attenuation, row.multiple.shift, row.multiple.deviation}, terms);
  }
  append_corrections(table, resources, parameters.corrections, terms);
  return gpu::make_buffer_from<glm::vec4>(device, terms);
}

class DualScattering : public GpuPass {
 public:
  DualScattering(std::shared_ptr<gpu::Device> device, gpu::Buffer terms)
      : device_(std::move(device)), terms_(std::move(terms)) {}
  void publish(Resources& resources) const override { resources.put(Terms{&terms_}); }
  Result<bool> take_parameters(const Resources& resources) override {
    CUTICLE_ASSIGN(terms_, make_terms(*device_, resources));
    return true;
  }
  Result<void> record(gpu::Commands&, const Resources&) override { return {}; }

 private:
  std::shared_ptr<gpu::Device> device_;
  gpu::Buffer terms_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  CUTICLE_ASSIGN(gpu::Buffer terms, make_terms(*device, resources));
  return std::unique_ptr<GpuPass>(std::make_unique<DualScattering>(std::move(device), std::move(terms)));
}

}  // namespace

std::vector<std::uint32_t> with_dual_scattering(std::vector<std::uint32_t> before, const Resources& resources) {
  before.push_back(resources.find<Terms>() ? 1 : 0);
  before.push_back(resources.find<surface_shadow::Maps>() ? 1 : 0);
  return before;
}

Inputs inputs_of(const Resources& resources, const gpu::Buffer& unused) {
  const Terms* const terms = resources.find<Terms>();
  return {terms ? terms->values : &unused,
          resources.find<surface_shadow::Maps>() ? &resources.get<surface_shadow::Maps>().visibility : &unused};
}

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"dual_scattering", create};
  return table;
}

}  // namespace cuticle::render::dual_scattering
