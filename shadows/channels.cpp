#include "shadows/channels.h"

#include <algorithm>

#include "shadows/channels.glslh"

namespace cuticle::shadows {
namespace {

void add_cost(const Cost& cost, Cost& sum) {
  sum.build_ms += cost.build_ms;
  sum.lookup_ms += cost.lookup_ms;
  sum.bytes = std::max(sum.bytes, cost.bytes);
  sum.device = cost.device;
}

/// What of opacity k is known, or of all by the root's.
void set_channels(const Transmittance& one, std::uint32_t k, std::optional<std::uint32_t> root,
                  const Channels& channels, ColouredTransmittance& result) {
  for (int channel = 0; channel < 3; ++channel) {
    const std::uint32_t own = channels.of[std::size_t(channel)];
    if (!root && own != k) continue;
    const auto ratio = root ? float(channels.alpha[own] / channels.alpha[*root]) : 1.0f;
    for (std::size_t i = 0; i < result.values.size(); ++i)
      result.values[i][channel] = own == root.value_or(k) ? one.values[i] : powered(one.values[i], ratio);
  }
  add_cost(one.cost, result.cost);
}

}  // namespace

Channels different_channels(const glm::dvec3& alpha) {
  Channels channels{{}, {}, 0};
  for (int channel = 0; channel < 3; ++channel) {
    const auto end = channels.alpha.begin() + channels.count;
    const auto same = std::find(channels.alpha.begin(), end, alpha[channel]);
    channels.of[std::size_t(channel)] = std::uint32_t(same - channels.alpha.begin());
    if (same == end) channels.alpha[channels.count++] = alpha[channel];
  }
  return channels;
}

std::optional<std::uint32_t> root_opacity(const Method& method, const registry::ParameterValues& values,
                                          const Channels& channels) {
  constexpr double k_least = 0.01;
  if (channels.count == 1 || !method.is_proportional || !method.is_proportional(values)) return {};
  std::optional<std::uint32_t> root;
  for (std::uint32_t k = 0; k < channels.count; ++k)
    if (channels.alpha[k] > 0 && (!root || channels.alpha[k] < channels.alpha[*root])) root = k;
  return root && channels.alpha[*root] >= k_least ? root : std::nullopt;
}

Result<ColouredTransmittance> evaluate_channels(const Method& method, const Casters& casters, const glm::dvec3& alpha,
                                                const Receivers& receivers, const registry::ParameterValues& values) {
  const Channels channels = different_channels(alpha);
  const std::optional<std::uint32_t> root = root_opacity(method, values, channels);
  ColouredTransmittance result;
  result.values.resize(receivers.points.size());
  for (std::uint32_t k = 0; k < channels.count; ++k) {
    Casters of_channel = casters;
    of_channel.alpha = channels.alpha[k];
    CUTICLE_TRY(check(of_channel, receivers));
    of_channel.alpha = channels.alpha[root.value_or(k)];
    if (root && k > 0) continue;
    CUTICLE_ASSIGN(const Transmittance one, method.evaluate(of_channel, receivers, values));
    set_channels(one, k, root, channels, result);
  }
  return result;
}

}  // namespace cuticle::shadows
