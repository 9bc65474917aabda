#pragma once
// Runs of shadow methods by name and settings, for their tests.
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shadows/method.h"

namespace cuticle::tests {

/// The method's values for "name=value,..."; an error where they are refused.
inline Result<registry::ParameterValues> values_of(std::string_view method, const std::string& set) {
  return registry::parse_assignments((*shadows::find_method(method))->entry.parameters, set);
}

/// A groom's vertices as receivers, with the numbers that shadows::Receivers asks for.
struct VertexReceivers {
  std::vector<std::uint32_t> strands, vertices;
  shadows::Receivers of(const strands::Groom& groom) const { return {groom.positions, strands, {}, vertices}; }
};
inline VertexReceivers vertex_receivers(const strands::Groom& groom) {
  VertexReceivers receivers;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) {
      receivers.strands.push_back(s);
      receivers.vertices.push_back(v);
    }
  return receivers;
}

/// Transmittance at points; errors as the method's.
inline Result<shadows::Transmittance> run_shadow(std::string_view method, const strands::Groom& groom,
                                                 std::span<const glm::vec3> points, const std::string& set = "",
                                                 double alpha = 0.4, glm::dvec3 light = {0, 1, 0}) {
  CUTICLE_ASSIGN(const auto values, values_of(method, set));
  return (*shadows::find_method(method))->evaluate({&groom, alpha, light}, {points, {}}, values);
}

/// Transmittance at one point; -1 and a failed test where it is refused.
inline float shadow_at(std::string_view method, const strands::Groom& groom, glm::vec3 point,
                       const std::string& set = "", double alpha = 0.4, glm::dvec3 light = {0, 1, 0}) {
  const auto result = run_shadow(method, groom, std::span(&point, 1), set, alpha, light);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? result->values[0] : -1;
}

inline double mean(std::span<const float> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

}  // namespace cuticle::tests
