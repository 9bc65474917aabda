// The registered method: parameters, demands, and the CPU evaluation.
#include <cuticle/shadows/detail/map_method.h>
#include <cuticle/shadows/voxel/volume.h>

namespace cuticle::shadows::voxel {
namespace {

using registry::ParameterType;
constexpr std::string_view k_forms[] = {"anisotropic", "isotropic"};
constexpr registry::Parameter k_parameters[] = {
    {"resolution", ParameterType::integer, "1", 8, 512, "64", {}, "cells along the longest side of the hair"},
    {"form", ParameterType::choice, "1", 0, 0, "anisotropic", k_forms,
     "anisotropic: hair weighs with the width that it shows to the light; isotropic: with its mean over directions"},
    {"accumulate", ParameterType::choice, "1", 0, 0, "poisson", k_accumulations,
     "what a crossing counts as: poisson: alpha; optical_depth: -ln(1 - alpha)"},
    {"filter_radius_mm",
     ParameterType::real,
     "mm",
     0,
     1000,
     "0",
     {},
     "radius of the disc that rays to the light start from; up to half a cell a single ray"},
};
constexpr std::string_view k_demands[] = {"light", "shadow_method"};
constexpr registry::StudyCase k_cases[] = {{"isotropic", "form=isotropic"}, {"anisotropic", "form=anisotropic"}};

Result<Transmittance> evaluate(const Casters& casters, const Receivers& receivers,
                               const registry::ParameterValues& values) {
  CUTICLE_TRY(check(casters, receivers));
  CUTICLE_ASSIGN(const glm::dvec3 to_light, unit_to_light(casters.to_light));
  const Settings settings = settings_from(values);
  Transmittance result;
  result.cost.device = cpu_device_name();
  const auto start = std::chrono::steady_clock::now();
  const Volume volume = build_volume(*casters.groom, casters.alpha, to_light, settings);
  result.cost.build_ms = milliseconds_since(start);
  const auto built = std::chrono::steady_clock::now();
  result.values = look_up(volume, settings, to_light, receivers.points);
  result.cost.lookup_ms = milliseconds_since(built);
  result.cost.bytes = 4 * volume.sums.size();
  return result;
}

}  // namespace

const Method& entry() {
  static const Method method{
      {registry::EntryKind::method,
       "voxel",
       "hair as a volume of optical depth, marched towards the light",
       "Petrovic, Henne and Anderson 2005, Volumetric Methods for Simulation and Rendering of Hair",
       k_parameters,
       k_demands,
       registry::Stage::shadow,
       {},
       k_cases},
      evaluate};
  return method;
}

}  // namespace cuticle::shadows::voxel
