#include "bsdf/dual_scattering/kept_terms.h"

#include <deque>
#include <mutex>

#include "bsdf/chiang/chiang.h"

namespace cuticle::bsdf {

namespace {

struct Known {
  const Model* model;
  registry::ParameterValues values;
  DualScatteringTable table;
};

/// `chiang` alone has a far field of a part of the width; walks of a far field choose their offsets.
registry::ParameterValues of_quick_field(const Model& model, registry::ParameterValues values) {
  if (model.entry.name == "chiang") {
    const auto fibre = registry::from_values<chiang::Parameters>(values);
    if (fibre.h_from != -1 || fibre.h_to != 1) return values;
  }
  if (values.all().contains("field"))
    values.set("field", std::string(model.scattering_from_viewer != nullptr ? "far" : "near"));
  return values;
}

}  // namespace

Result<DualScatteringTable> kept_dual_scattering_terms(const Model& model, const registry::ParameterValues& given) {
  constexpr std::size_t k_most = 8;
  static std::mutex guard;
  static std::deque<Known> known;
  const registry::ParameterValues values = of_quick_field(model, given);
  const std::lock_guard lock(guard);
  for (const Known& one : known)
    if (one.model == &model && one.values == values) return one.table;
  CUTICLE_ASSIGN(DualScatteringTable table, dual_scattering_terms(model, values, k_dual_scattering_rows));
  known.push_back({&model, values, table});
  if (known.size() > k_most) known.pop_front();
  return table;
}

}  // namespace cuticle::bsdf
