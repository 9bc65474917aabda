#include <map>

#include "lut/evaluate.h"

namespace cuticle::lut {

AverageFibre average_fibre(const bsdf::Model& model, const registry::ParameterValues& values) {
  const auto known = std::make_shared<std::map<double, bsdf::DualScatteringRow>>();
  return [&model, values, known](double theta_o) -> Result<bsdf::DualScatteringRow> {
    const auto found = known->find(theta_o);
    if (found != known->end()) return found->second;
    bsdf::DualScatteringRow row{theta_o, {}, {}};
    CUTICLE_ASSIGN(row.average, bsdf::average_scattering(model, values, theta_o));
    CUTICLE_ASSIGN(row.multiple, bsdf::multiple_backscattering(row.average));
    known->emplace(theta_o, row);
    return row;
  };
}

}  // namespace cuticle::lut
