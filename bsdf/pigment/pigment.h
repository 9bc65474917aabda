#pragma once
// From pigments and colours to absorption per fibre radius. Two tables of pigments are in use, which differ by up to a factor of 2
// for the same concentration, and two meanings of a hair's colour, which differ far more; so each has its name.
#include <span>
#include <string_view>

#include <glm/vec3.hpp>

#include "bsdf/model.h"

namespace cuticle::bsdf {

/// Absorption (red, green, blue) per fibre radius and per unit of concentration.
struct PigmentTable {
  std::string_view name, source;
  glm::dvec3 eumelanin, pheomelanin;
};
/// "deon_pbrt": d'Eon et al. 2011 as tabulated in pbrt and MaterialX. "blender": the Principled Hair of Blender's Cycles.
std::span<const PigmentTable> pigment_tables();
/// A table by name. Error: usage, listing them, with the nearest name.
Result<PigmentTable> find_pigment_table(std::string_view name);

/// sigma_a = eumelanin ce + pheomelanin cp for concentrations of 0 .. 100. Error: bad_input, naming pigment, value and range.
Result<glm::dvec3> absorption_of_pigments(const PigmentTable& table, double eumelanin, double pheomelanin);

/// Concentrations from an artist's two numbers, as Blender and MaterialX have them: together -log(1 - melanin), melanin in [0, 1]
/// (at most 9.21, reached at 0.9999), of which `redness` in [0, 1] is pheomelanin.
struct Melanin {
  double eumelanin = 0, pheomelanin = 0;
};
/// Error: bad_input, naming value and range.
Result<Melanin> melanin_concentrations(double melanin, double redness);

/// `assembly`: the absorption with which a dense head of hair shows `color` (0.001 .. 1 each), for the azimuthal roughness beta_n
/// in [0, 1]: Chiang et al. 2016, equation 9, a fit by path tracing of such hair. Error: bad_input, naming component, value, range.
Result<glm::dvec3> absorption_of_assembly(const glm::dvec3& color, double beta_n);
/// Its inverse, the colour that a dense head of hair shows. Error: bad_input.
Result<glm::dvec3> color_of_assembly(const glm::dvec3& sigma_a, double beta_n);

/// `fibre`: the absorption with which one fibre of a model scatters the share `color` of the light for a viewer at theta_o [rad],
/// by bisection of the model's albedo, which for a near-field model is averaged over h (32 points). `values`: everything but
/// sigma_a. The albedo is met within 1e-9, or the model's own error. Errors: usage where the model has no sigma_a; bad_input,
/// naming component, value and the albedos that sigma_a from 0 to its largest can reach.
Result<glm::dvec3> absorption_of_fibre(const Model& model, const registry::ParameterValues& values,
                                       const glm::dvec3& color, double theta_o = 0);
/// The albedo that it inverts.
Result<glm::dvec3> color_of_fibre(const Model& model, const registry::ParameterValues& values, double theta_o = 0);

}  // namespace cuticle::bsdf
