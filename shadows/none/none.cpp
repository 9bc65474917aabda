// No shadow: the transmittance is 1 everywhere. The first line of every comparison.
#include "shadows/method.h"

namespace cuticle::shadows::none {
namespace {

constexpr std::string_view k_demands[] = {"light", "shadow_method"};

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers, const registry::ParameterValues&) {
  CUTICLE_TRY(check(casters, receivers));
  Transmittance result;
  result.values.assign(receivers.points.size(), 1.0f);
  result.cost.device = cpu_device_name();
  return result;
}

}  // namespace

const Method& entry() {
  static const Method method{{registry::EntryKind::method, "none", "no shadow: transmittance 1 everywhere",
                              "the baseline of every comparison", {}, k_demands, registry::Stage::shadow},
                             evaluate};
  return method;
}

}  // namespace cuticle::shadows::none
