#include <cuticle/shadows/channels.h>

#include <algorithm>

namespace cuticle::shadows {
namespace {

void add_cost(const Cost& cost, Cost& sum) {
  sum.build_ms += cost.build_ms;
  sum.lookup_ms += cost.lookup_ms;
  sum.bytes = std::max(sum.bytes, cost.bytes);
  sum.device = cost.device;
}

}  // namespace

Result<ColouredTransmittance> evaluate_channels(const Method& method, const Casters& casters, const glm::dvec3& alpha,
                                                const Receivers& receivers, const registry::ParameterValues& values) {
  ColouredTransmittance result;
  result.values.resize(receivers.points.size());
  for (int channel = 0; channel < 3; ++channel) {
    int same = 0;  // the first channel of this opacity
    while (alpha[same] != alpha[channel] && same < channel) ++same;
    if (same < channel) {
      for (glm::vec3& value : result.values) value[channel] = value[same];
      continue;
    }
    Casters of_channel = casters;
    of_channel.alpha = alpha[channel];
    CUTICLE_ASSIGN(const Transmittance one, method.evaluate(of_channel, receivers, values));
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i][channel] = one.values[i];
    add_cost(one.cost, result.cost);
  }
  return result;
}

}  // namespace cuticle::shadows
