#include <algorithm>
#include <deque>
#include <mutex>

#include "bsdf/chiang/chiang.h"
#include "bsdf/dual_scattering/corrections.h"
#include "bsdf/dual_scattering/dual_scattering.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/dual_scattering/dual_scattering_gpu.h"
#include "render/passes/surface_shadow/surface_shadow_gpu.h"
#include "strands/thickness.h"

namespace cuticle::render::dual_scattering {

namespace {

constexpr int k_rows = 32;  // as in dual_scattering.glsl, with the order of what is appended here

void append(const bsdf::HalfScattering& half, std::vector<glm::vec4>& terms) {
  terms.emplace_back(half.share, 0);
  terms.emplace_back(half.shift, 0);
  terms.emplace_back(half.deviation * half.deviation, 0);
}

struct Known {
  const bsdf::Model* model;
  registry::ParameterValues values;
  bsdf::DualScatteringTable table;
};

/// The tables of the last materials are kept: one takes seconds, and a picture made anew mostly has the same.
Result<bsdf::DualScatteringTable> table_of(const bsdf::Model& model, const registry::ParameterValues& values) {
  constexpr std::size_t k_most = 8;
  static std::mutex guard;
  static std::deque<Known> known;
  const std::lock_guard lock(guard);
  for (const Known& one : known)
    if (one.model == &model && one.values == values) return one.table;
  CUTICLE_ASSIGN(bsdf::DualScatteringTable table, bsdf::dual_scattering_terms(model, values, k_rows));
  known.push_back({&model, values, table});
  if (known.size() > k_most) known.pop_front();
  return table;
}

/// Averages over the fibre's width come several times faster from the near field, of models that have it for all h:
/// `chiang` alone has a far field of a part of the width.
registry::ParameterValues of_near_field(const bsdf::Model& model, registry::ParameterValues values) {
  if (model.entry.name == "chiang") {
    const auto fibre = registry::from_values<bsdf::chiang::Parameters>(values);
    if (fibre.h_from != -1 || fibre.h_to != 1) return values;
  }
  if (values.all().contains("field")) values.set("field", std::string("near"));
  return values;
}

/// Of each channel, by the albedo at inclination 0 and the thickness of the hair as shadows have it: a crossing of
/// opacity a counts as a fibres. Without the strands at rest nothing is corrected.
void append_corrections(const bsdf::DualScatteringTable& table, const Resources& resources, Corrections wanted,
                        std::vector<glm::vec4>& terms) {
  const RestStrands* const rest = resources.find<RestStrands>();
  const bool fitted = wanted == Corrections::path_tracing && rest && rest->groom;
  const double thickness = fitted ? strands::optical_thickness(*rest->groom) : 1;
  const auto& average = table.rows[table.rows.size() / 2].average;
  for (int c = 0; c < 3; ++c) {
    bsdf::dual_scattering::Corrections rows;
    if (fitted)
      rows = bsdf::dual_scattering::corrections_of(bsdf::dual_scattering::fitted_corrections(),
                                                   average.forward.share[c] + average.backward.share[c],
                                                   thickness * resources.get<FibreMaterial>().fibre_alpha[c]);
    for (const auto& row : rows) terms.emplace_back(row.onward, row.back, row.diffuse, 0);
  }
}

Result<gpu::Buffer> make_terms(gpu::Device& device, const Resources& resources) {
  const FibreMaterial& material = resources.get<FibreMaterial>();
  const lut::TableSet* set = bake_tables::table_set_of(resources);
  const bsdf::Model& model = set ? *set->model : *material.model;
  CUTICLE_ASSIGN(const bsdf::DualScatteringTable table,
                 table_of(model, of_near_field(model, set ? set->values : *material.values)));
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
  explicit DualScattering(gpu::Buffer terms) : terms_(std::move(terms)) {}
  void publish(Resources& resources) const override { resources.put(Terms{&terms_}); }
  Result<void> record(gpu::Commands&, const Resources&) override { return {}; }

 private:
  gpu::Buffer terms_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  CUTICLE_ASSIGN(gpu::Buffer terms, make_terms(*device, resources));
  return std::unique_ptr<GpuPass>(std::make_unique<DualScattering>(std::move(terms)));
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
