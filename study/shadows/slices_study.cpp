#include "study/shadows/slices_study.h"

#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "shadows/footprint.h"
#include "core/shared/philox.glslh"

namespace cuticle::study {

SlicesStudy quick_slices_study() {
  SlicesStudy study;
  study.layers = {1, 4, 16, 64};
  study.resolutions = {128, 256};
  study.request.receivers = 300;
  study.request.rays = 256;
  return study;
}

Result<Comparison> run_slices_study(const SlicesStudy& study, Progress& progress) {
  ComparisonRequest request = study.request;
  request.title = "Opacity maps and deep opacity maps against ray-traced truth";
  if (request.footprint_radius <= 0) request.footprint_radius = shadows::default_footprint_radius(*request.groom);
  const std::string methods[] = {"opacity_map", "deep_opacity"};
  CUTICLE_ASSIGN(request.candidates,
                 candidates_of(methods, {study.layers, study.resolutions, {request.footprint_radius}, {}}));
  return compare_with_truth(request, progress);
}

namespace {

struct CoatStrand {
  glm::dvec3 root, lean;
};
/// A root on the upper half sphere (uniform by area) and where the strand bends to.
CoatStrand coat_strand(std::uint32_t index) {
  const PhiloxBlock a = philox(PhiloxBlock{index, 0, 0, 0}, 0xc0a7u, 0),
                    b = philox(PhiloxBlock{index, 1, 0, 0}, 0xc0a7u, 0);
  double height = 0, turn = 0, x = 0, z = 0;
  unit_interval(a.a, height);
  unit_interval(a.b, turn);
  unit_interval(b.a, x);
  unit_interval(b.b, z);
  const double ring = std::sqrt(1 - height * height), angle = 2 * std::numbers::pi * turn;
  return {{ring * std::cos(angle), height, ring * std::sin(angle)}, {0.5 * (x - 0.5) + 0.4, -0.6, 0.5 * (z - 0.5)}};
}

}  // namespace

strands::Groom study_coat(int strands) {
  constexpr int k_vertices = 8;
  constexpr double k_sphere = 0.1, k_length = 0.03;
  strands::Groom groom;
  for (int s = 0; s < strands; ++s) {
    const CoatStrand strand = coat_strand(std::uint32_t(s));
    for (int v = 0; v < k_vertices; ++v) {
      const double t = double(v) / (k_vertices - 1);
      groom.positions.emplace_back(strand.root * (k_sphere + k_length * t) + strand.lean * (k_length * t * t));
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), 1.5e-4f);
  return groom;
}

}  // namespace cuticle::study
