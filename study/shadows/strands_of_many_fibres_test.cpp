// Strands that stand for twelve fibres each, beside rays through twelve times as many strands: the light that is left
// where a camera sees them.
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "study/shadows/probes.h"
#include "tests/support/shadow_runs.h"
#include "tests/support/synthetic_grooms.h"

namespace cuticle::study::strands_of_many_fibres_test {
namespace {

constexpr int k_fibres = 12, k_strands = 800;
constexpr float k_fibre_radius = 4e-5f;
const glm::dvec3 k_to_camera = glm::normalize(glm::dvec3(0.3, 0.6, 1));

/// A tress 10 cm long and 4 cm wide: upright strands at random places, leaning a little at random.
strands::Groom tress(int count, float radius) {
  std::mt19937_64 random(5);
  strands::Groom groom;
  for (int i = 0; i < count; ++i) {
    glm::dvec2 root, lean;
    for (double* number : {&root.x, &root.y, &lean.x, &lean.y}) *number = 2 * tests::uniform(random) - 1;
    for (int v = 0; v < 10; ++v) {
      const double down = v / 9.0;
      const glm::dvec2 at = 0.02 * root + 0.004 * down * lean;
      groom.positions.emplace_back(at.x, -0.1 * down, at.y);
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), radius);
  return groom;
}

/// Mean T where the camera sees the hair.
double light_left(const strands::Groom& hair, const glm::dvec3& to_light, const std::string& method,
                  const std::string& settings, double fibre_width) {
  const Probes probes = visible_probes(hair, k_to_camera, 4000);
  shadows::Receivers receivers = probes.receivers();
  receivers.fibre_width = fibre_width;
  const shadows::Casters casters{.groom = &hair, .alpha = 1, .to_light = glm::normalize(to_light)};
  const auto values = tests::values_of(method, settings).value();
  const auto found = shadows::find_method(method).value()->evaluate(casters, receivers, values).value().values;
  return std::accumulate(found.begin(), found.end(), 0.0) / double(found.size());
}

}  // namespace

/// What is left of the error: geometry that is thicker than its fibres. It shows most where the light comes along the
/// view, the second of these: what the viewer sees of thick strands is lit.
TEST(StrandsOfManyFibres, SeenByACamera_AreLitMoreAsTheirFibresAre) {
  const strands::Groom fibres = tress(k_fibres * k_strands, k_fibre_radius),
                       strands = tress(k_strands, k_fibres * k_fibre_radius);
  for (const glm::dvec3& to_light : {glm::dvec3(1, 1, 0.3), glm::dvec3(0.2, 1, 0.8), glm::dvec3(-0.5, 0.6, -0.7)}) {
    const double wanted = light_left(fibres, to_light, "truth", "rays=16", 1);
    std::printf("light from %.1f %.1f %.1f: %.3f of it left\n", to_light.x, to_light.y, to_light.z, wanted);
    for (const auto& [method, settings] : {std::pair{"deep_opacity", "resolution=512"},
                                           {"deep_shadow", "resolution=512"},
                                           {"shadow_map", "resolution=512"},
                                           {"voxel", "resolution=256"}}) {
      const double as_fibres = light_left(strands, to_light, method, settings, 1.0 / k_fibres),
                   as_strands = light_left(strands, to_light, method, settings, 1);
      std::printf("  %s: %.3f, as thick strands %.3f\n", method, as_fibres, as_strands);
      EXPECT_LT(std::abs(as_fibres - wanted), 0.65 * std::abs(as_strands - wanted)) << method;
    }
  }
}

}  // namespace cuticle::study::strands_of_many_fibres_test
