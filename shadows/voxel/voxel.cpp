// The registered method: parameters, demands, and the CPU evaluation.
#include "shadows/detail/map_method.h"
#include "shadows/voxel/volume.h"

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
constexpr std::string_view k_demands[] = {"light", "shadow_method", "distant_lights"};
constexpr registry::StudyCase k_cases[] = {{"isotropic", "form=isotropic"}, {"anisotropic", "form=anisotropic"}};

}  // namespace

/// Passes: fit, deposit, march; the clearing is a fill.
const Method& entry() {
  static const Method method = map_method<settings_from, build_volume, look_up>(
      {.name = "voxel",
       .summary = "hair as a volume of optical depth, marched towards the light",
       .source = "Petrovic, Henne and Anderson 2005, Volumetric Methods for Simulation and Rendering of Hair",
       .parameters = k_parameters,
       .demands = k_demands,
       .study_cases = k_cases,
       .dispatches = passes_per_light<3>});
  return method;
}

}  // namespace cuticle::shadows::voxel
