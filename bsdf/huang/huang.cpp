#include <array>
#include <cmath>

#include <fmt/core.h>

#include "bsdf/huang/huang.glslh"
#include "bsdf/huang/many_lights.h"
#include "bsdf/shared/batch.h"
#include "bsdf/shared/fibre_table.h"
#include "bsdf/turns.h"
#include "core/registry/members.h"

namespace cuticle::bsdf::huang {
namespace {

constexpr std::array<std::string_view, 4> lobe_names = {"R", "TT", "TRT", "residual"};
constexpr std::array<std::string_view, 3> measurable = {"sigma_a", "roughness", "tilt"};
constexpr std::array<std::string_view, 2> fields = {"far", "near"};
constexpr std::array<std::string_view, 2> facets = {"multiple", "single"};
constexpr std::array<std::string_view, 1> system_rows = {"G7"};

enum class Field { far, near };
enum class Facets { multiple, single };
struct Parameters {
  double eta = 1.55;
  glm::dvec3 sigma_a{0.2};
  double roughness = 0.2, tilt = 0.05235987755982988, aspect = 1;
  Field field = Field::far;
  std::int64_t samples = 512;
  Facets facets = Facets::multiple;
  std::int64_t turns = 0;
};
void describe(registry::Members& members, Parameters& p) {
  members(p.eta, eta_parameter);
  members(p.sigma_a, "sigma_a", "1/radius", 0, 100,
          "absorption per semi-major axis of the cross-section, for red, green and blue");
  members(p.roughness, "roughness", "1", 1e-3, 1, "alpha of the GGX facets on the scales");
  members(p.tilt, "tilt", "rad", -0.17453292519943295, 0.17453292519943295,
          "of the scales against the axis; positive: they lean to the tip, and R goes to theta_i + theta_o = -2 tilt");
  members(p.aspect, "aspect", "1", 0.2, 1, "minor over major axis of the cross-section");
  members(p.field, "field", fields,
          "far: all offsets together; near: the offset h, a share of the half-width seen from the viewer");
  members(p.samples, "samples", 64, 65536, "paths of the quadrature");
  members(
      p.facets, "facets", facets,
      "multiple: light goes on from facet to facet and through any number of crossings; single: what a second facet "
      "would stop is lost, and paths after TRT (the lobe residual is 0)");
  members(p.turns, turns_parameter);
}

constexpr std::array<registry::StudyCase, 4> tiers = {{
    {"64 paths", "samples=64"},
    {"512 paths", "samples=512"},
    {"4096 paths", "samples=4096"},
    {"32768 paths", "samples=32768"},
}};

bool is_near(const registry::ParameterValues& values) {
  return registry::from_values<Parameters>(values).field == Field::near;
}

Huang<double> prepare(const Parameters& p) {
  return {p.eta,
          1 / p.eta,
          p.roughness,
          std::sin(p.tilt),
          std::cos(p.tilt),
          p.aspect,
          p.sigma_a,
          p.field == Field::near ? 1.0 : 0.0,
          double(p.samples),
          p.facets == Facets::multiple ? 1.0 : 0.0,
          p.aspect == 1 ? 0.0 : double(p.turns)};
}

/// A deviation of theta_i is that of twice the facets' slope, which for the Gaussian slopes of the same alpha is
/// sqrt(2) alpha.
FibreMapping map_fibre(const Fibre& fibre) {
  const double roughness = std::clamp(fibre.longitudinal_deviation / std::sqrt(2.0), 1e-3, 1.0);
  return {fmt::format("eta={:.15g},sigma_a={:.15g}/{:.15g}/{:.15g},roughness={:.15g},tilt={:.15g},aspect={:.15g}",
                      fibre.eta, fibre.sigma_a.x, fibre.sigma_a.y, fibre.sigma_a.z, roughness, fibre.scale_tilt,
                      std::max(fibre.aspect, 0.2)),
          fmt::format(
              "roughness {:.4g} is the longitudinal deviation over sqrt 2, that of R from Gaussian slopes of this "
              "alpha; the same "
              "facets blur azimuths, so the azimuthal deviation is not used; tilt and aspect as they are; no medulla",
              roughness)};
}

/// Paths, times the rounds that one takes where light turns often, and turns of R at each node of its rules. Measured
/// on software Vulkan: S is right with 1,024 paths and wrong with 2,048.
std::uint64_t loop_rounds(const registry::ParameterValues& values, Quantity quantity) {
  const Parameters p = registry::from_values<Parameters>(values);
  if (quantity == Quantity::pdf) return 0;
  const bool is_sum_of_paths = quantity == Quantity::S || quantity == Quantity::error;
  const std::uint64_t turns = is_sum_of_paths ? 72 * std::uint64_t(prepare(p).turns) : 0;
  if (p.facets != Facets::multiple) return turns;
  return turns + 48 * std::uint64_t(is_sum_of_paths ? p.samples : CUTICLE_HUANG_PATHS_OF_MEANS);
}

/// However much effort is asked for: the facets of a viewer's paths are kept until all of its lights are made.
constexpr double k_most_paths = 131072;

void from_viewer(const registry::ParameterValues& values, int effort, int lobe, std::span<const Point> points,
                 std::span<glm::dvec3> out) {
  Huang<double> fibre = prepare(registry::from_values<Parameters>(values));
  fibre.samples = std::min(fibre.samples * effort, k_most_paths);
  scattering_from_viewer(fibre, lobe, points, out);
}

Model table() {
  return {
      .entry = {.kind = registry::EntryKind::model,
                .name = "huang",
                .summary = "rough elliptical fibre of tilted scales, facet by facet: R, TT, TRT and all longer paths",
                .source = "Huang, Hullin and Hanika 2022",
                .parameters = registry::table_of<Parameters>(),
                .systems = system_rows,
                .study_cases = tiers},
      .lobes = lobe_names,
      .conventions = {.field = "near or far",
                      .cosine = "not included",
                      .tilt_sign = "positive tilt moves the R lobe toward theta_i + theta_o < 0, the root",
                      .roughness = "alpha of GGX's slopes",
                      .absorption = "per semi-major axis"},
      .presets = pigment_presets,
      .near_field = is_near,
      .from_fibre = map_fibre,
      .measurable = measurable,
      .loop_rounds = loop_rounds,
      .scattering_from_viewer = from_viewer};
}

}  // namespace

CUTICLE_MODEL(prepare, table)

}  // namespace cuticle::bsdf::huang
