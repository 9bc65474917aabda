#include "bsdf/huang/many_lights.h"

#include <array>
#include <bit>
#include <vector>

#include "bsdf/huang/facets_met.h"
#include "bsdf/huang/huang.glslh"
#include "bsdf/shared/batch.h"
#include "core/instruction_set.h"

namespace cuticle::bsdf::huang {

extern const AddFacets add_facets_baseline;
#if defined(CUTICLE_HAS_WIDE_SETS)
extern const AddFacets add_facets_avx2, add_facets_avx512;
#endif

namespace {

constexpr int k_block = 64;  ///< directions whose sums stay in the nearest cache

AddFacets best_kernel() {
#if defined(CUTICLE_HAS_WIDE_SETS)
  return widest(add_facets_baseline, add_facets_avx2, add_facets_avx512);
#else
  return add_facets_baseline;
#endif
}

/// Takes the place of a light's direction in a walk. `back`: from the section's axes to the viewer's.
struct Recorder {
  std::vector<FacetMet>* met;
  glm::dvec3 energy{0};
  glm::dvec2 back{1, 0};
};

Recorder with_energy(const Recorder& recorder, const glm::dvec3& energy) {
  return {recorder.met, recorder.energy * energy, recorder.back};
}
Recorder turned_light(const Recorder& recorder, const glm::dvec2& turn) {
  return {recorder.met, recorder.energy, {turn.x, -turn.y}};
}

double seen_from_light(const Huang<double>&, const Place<double>& at, const Among<double>& ray,
                       const Recorder& recorder, double worth) {
  const glm::dvec3 energy = recorder.energy * worth;
  if (largest_of(energy) <= 0) return 0;
  const glm::dvec3 direction = rotated_across(ray.direction, recorder.back);
  const glm::dvec3 facing = rotated_across(ray.facing, recorder.back);
  const glm::dvec3 normal = rotated_across(at.normal, recorder.back);
  recorder.met->push_back({{float(direction.x), float(direction.y), float(direction.z)},
                           {float(facing.x), float(facing.y), float(facing.z)},
                           {float(normal.x), float(normal.y)},
                           float(ray.side),
                           float(ray.depth),
                           {float(energy.x), float(energy.y), float(energy.z)}});
  return 0;
}

/// The shift of a viewer's lattice: errors of different viewers are independent, so that what is fitted to many is not
/// led astray by all of them alike.
uint shift_of(const View<double>& view, double h) {
  uint word = 0;
  for (double number : {view.direction.x, view.direction.y, view.direction.z, h})
    word = scrambled(word ^ uint(std::bit_cast<std::uint64_t>(number) >> 20));
  return word;
}

/// Walks as for one light, but from all offsets alike, since there is no light yet that would favour some.
std::vector<FacetMet> facets_from(const Huang<double>& m, const View<double>& view, int lobe, double h) {
  std::vector<FacetMet> met;
  const int paths = int(m.samples);
  const Recorder recorder{&met, glm::dvec3(1.0 / paths)};
  PathKey key = first_path(shift_of(view, h));
  for (int k = 0; k < paths; ++k) {
    key.path = uint(k);
    walked(m, view, recorder, lobe, even_offset(m, h, lattice_number(h, key, 0)), 0.1, key);
  }
  return met;
}

/// Directions of light and the sums toward them, as the kernel takes them.
struct Block {
  std::array<float, k_block> x{}, y{}, z{}, red{}, green{}, blue{};
  LightPointers pointers() { return {x.data(), y.data(), z.data(), red.data(), green.data(), blue.data()}; }
};

glm::dvec3 mirrored(const Huang<double>& m, const View<double>& view, const View<double>& lit, const Point& at) {
  if (m.near_field > 0.5) return mirrored_near(m, view, lit, at.h).value;
  const MirroredSpan<double> span = mirrored_span(m, view, lit, -wrapped(at.phi));
  return glm::dvec3(mirrored_far_by(m, view, lit.direction, span, CUTICLE_HUANG_NODES));
}

}  // namespace

void scattering_from_viewer(const Huang<double>& m, int lobe, std::span<const Point> points,
                            std::span<glm::dvec3> out) {
  if (points.empty()) return;
  const Point& first = points.front();
  const View<double> view = view_from(m, first.theta_o, first.phi_o);
  const std::vector<FacetMet> met = facets_from(m, view, lobe, first.h);
  const auto numbers = numbers_of<float>(m);
  const AddFacets add_facets = best_kernel();
  for (std::size_t begin = 0; begin < points.size(); begin += k_block) {
    const std::size_t count = std::min(points.size() - begin, std::size_t(k_block));
    Block block;
    for (std::size_t i = 0; i < count; ++i) {
      const Point& at = points[begin + i];
      const View<double> lit = light_from(m, at.theta_i, at.phi_o, wrapped(at.phi));
      block.x[i] = float(lit.direction.x);
      block.y[i] = float(lit.direction.y);
      block.z[i] = float(lit.direction.z);
      out[begin + i] = lobe < 1 ? mirrored(m, view, lit, at) : glm::dvec3(0);
    }
    add_facets(numbers.data(), {met.data(), int(met.size())}, k_block, block.pointers());
    for (std::size_t i = 0; i < count; ++i) out[begin + i] += glm::dvec3(block.red[i], block.green[i], block.blue[i]);
  }
}

}  // namespace cuticle::bsdf::huang
