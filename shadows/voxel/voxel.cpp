// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/detail/map_method.h"
#include "shadows/voxel/volume.h"

namespace cuticle::shadows::voxel {
namespace {

constexpr std::string_view k_forms[] = {"anisotropic", "isotropic"};
constexpr std::string_view k_demands[] = {"light", "shadow_method", "distant_lights"};
constexpr registry::StudyCase k_cases[] = {{"isotropic", "form=isotropic"}, {"anisotropic", "form=anisotropic"}};

}  // namespace

void describe(registry::Members& members, Settings& settings) {
  members(settings.map.resolution, "resolution", 8, 512, "cells along the longest side of the hair");
  members(settings.isotropic, "form", k_forms,
          "anisotropic: hair weighs with the width that it shows to the light; isotropic: with its mean over "
          "directions");
  members(settings.map.accumulation.poisson, "accumulate", k_accumulations,
          "what a crossing counts as: poisson: alpha; optical_depth: -ln(1 - alpha)");
  members.millimetres(settings.map.filter_radius, "filter_radius_mm", 0, 1000,
                      "radius of the disc that rays to the light start from; up to half a cell a single ray");
}

/// Passes: fit, deposit, march; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<Settings, build_volume, look_up>(
      {.name = "voxel",
       .summary = "hair as a volume of optical depth, marched towards the light",
       .source = "Petrovic, Henne and Anderson 2005, Volumetric Methods for Simulation and Rendering of Hair",
       .demands = k_demands,
       .study_cases = k_cases,
       .dispatches = passes_per_light<3>});
  return method;
}

}  // namespace cuticle::shadows::voxel
