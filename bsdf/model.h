#pragma once
// The concept of a fibre scattering model, and the registry. Angles in radians (docs/conventions.md): theta_i, theta_o
// inclinations from the normal plane, phi = phi_o - phi_i, h in [-1, 1]. No cosine of the incident angle is included.
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "bsdf/fibre.h"
#include "core/registry/entry.h"
#include "core/result.h"

namespace cuticle::bsdf {

enum class Precision { f32, f64, gpu };
/// S: scattering function [1/sr]; M: longitudinal [1/rad]; N: azimuthal, far field [1/rad]; A: attenuation of
/// the path at offset h; albedo: energy scattered for a given theta_o, integrated over the sphere of incident
/// directions; pdf: density of `sample` per steradian of incident directions (of one lobe: of that lobe's samples
/// alone); error: the model's own bound on the absolute error of S where it is a quadrature, 0 where it is a closed
/// form.
enum class Quantity { S, M, N, A, albedo, pdf, error };
constexpr std::size_t quantity_count = 7;

struct Conventions {
  std::string_view field;       ///< "near" or "far"
  std::string_view cosine;      ///< "not included" or "included"
  std::string_view tilt_sign;   ///< words: which way positive tilt moves the R lobe
  std::string_view roughness;   ///< "standard deviation in theta_i", "variance", ...
  std::string_view absorption;  ///< "per fibre radius"
};

/// One point of evaluation, in double; each precision narrows it itself. Quantities use what they need:
/// S, pdf and error (theta_i, theta_o, phi), M(theta_i, theta_o), N(theta_d, phi), A(theta_d, h), albedo(theta_o).
/// In the near field S, N, pdf, error and albedo are functions of h too. phi_o is the viewer's azimuth from the major
/// axis of the cross-section, which only elliptical fibres use.
struct Point {
  double theta_i = 0, theta_o = 0, theta_d = 0, phi = 0, h = 0, phi_o = 0;
};
constexpr std::size_t coordinate_count = 6;

/// What an incident direction is drawn for: the viewer's direction, the offset (near field), and numbers in [0, 1).
struct SampleQuery {
  double theta_o = 0, phi_o = 0, h = 0;
  std::array<double, 8> u{};
};
/// The direction drawn, its lobe (-1 where the model draws from all at once), its density per steradian, and S / pdf:
/// the mean of `weight` is the albedo.
struct Sample {
  double theta_i = 0, phi = 0, pdf = 0;
  glm::dvec3 weight{0};
  int lobe = -1;
};

/// Azimuths from `begin` to `end` (radians, 0 <= begin < end <= pi) at one theta_d, and the mean of N over them.
struct AzimuthInterval {
  double theta_d = 0, begin = 0, end = 0;
};
struct AzimuthMean {
  glm::dvec3 value{0};
  bool singular = false;  ///< N is infinite somewhere between the two
};

/// A check of `cuticle check model` that this model does not meet by its nature, why, and with which value of one
/// parameter ("variant=as_published", "aspect!=1"; empty: always).
struct Exception {
  std::string_view check, why, when = {};
};

/// Work for one call: one quantity, one lobe (index into lobes; -1 = the sum over lobes) at many points.
struct Request {
  Quantity quantity = Quantity::S;
  int lobe = -1;
  std::span<const Point> points;
};

/// A registered model. M and A do not depend on colour where the model says so; every result is rgb.
struct Model {
  registry::Entry entry;
  std::span<const std::string_view> lobes;  ///< "R", "TT", "TRT"
  Conventions conventions;
  /// Evaluates into `out` (one rgb per point) in the precision named. Values are finite at every point of the domain.
  void (*evaluate_f32)(const registry::ParameterValues&, const Request&, std::span<glm::dvec3> out) = nullptr;
  void (*evaluate_f64)(const registry::ParameterValues&, const Request&, std::span<glm::dvec3> out) = nullptr;
  /// Draws incident directions; the same number of queries and results.
  void (*sample_f32)(const registry::ParameterValues&, std::span<const SampleQuery>, std::span<Sample> out) = nullptr;
  void (*sample_f64)(const registry::ParameterValues&, std::span<const SampleQuery>, std::span<Sample> out) = nullptr;
  /// The numbers of its struct, as a kernel reads them.
  std::vector<float> (*pack)(const registry::ParameterValues&) = nullptr;
  /// Named starting points, "blond" -> "eta=1.55,sigma_a=...".
  std::span<const registry::StudyCase> presets = {};
  /// Whether these values make it a near-field model, a function of h; null: never.
  bool (*near_field)(const registry::ParameterValues&) = nullptr;
  /// A physical fibre in this model's parameters, with the mapping in words; null: it has none.
  FibreMapping (*from_fibre)(const Fibre&) = nullptr;
  /// Names of the parameters that S of one fibre tells, up to a factor: those that a fit to measurements leaves free. A
  /// colour that multiplies all of S is none: the factor holds it.
  std::span<const std::string_view> measurable = {};
  std::span<const Exception> exceptions = {};
  /// Loop rounds that one point's kernel may take; null: far below 65,536, where Mesa's software Vulkan ends the loops
  /// of an invocation without a word.
  std::uint64_t (*loop_rounds)(const registry::ParameterValues&, Quantity) = nullptr;
  /// Means of N of a lobe over intervals without a quadrature through its peaks; false where these values have none
  /// such; null: never. Neighbours in the list that share an end are found faster.
  bool (*azimuthal_means)(const registry::ParameterValues&, int lobe, std::span<const AzimuthInterval>,
                          std::span<AzimuthMean> out) = nullptr;
  /// S of a lobe (-1: of all) at points that share theta_o, phi_o and h, where one viewer's work serves all of its
  /// lights, with `effort` times the paths of the values; null: a point is no cheaper beside others.
  void (*scattering_from_viewer)(const registry::ParameterValues&, int effort, int lobe, std::span<const Point>,
                                 std::span<glm::dvec3> out) = nullptr;
  /// Index of refraction of the smooth circular fibre whose caustic N of TRT has, infinite and at its place; 0: these
  /// values have none such; null: never.
  double (*caustic_index)(const registry::ParameterValues&) = nullptr;
};

/// All registered models, and one by name (Error: usage, with the nearest name).
std::span<const Model* const> models();
Result<const Model*> find_model(std::string_view name);
/// Index of a lobe by name; "sum" is -1. Error: usage, listing the lobes.
Result<int> find_lobe(const Model& model, std::string_view lobe);
/// "S", "M", "N", "A", "albedo", "pdf", "error". Error: usage, listing them.
Result<Quantity> find_quantity(std::string_view name);
/// Parameters from a preset's name (may be empty) and settings that go over it, "eta=1.5,alpha_deg=-3". Error: usage,
/// listing the presets, or naming parameter, value and range.
Result<registry::ParameterValues> parse_settings(const Model& model, std::string_view preset,
                                                 std::string_view settings);

/// Which members of Point, in their order, the quantity is a function of for these values.
std::array<bool, coordinate_count> coordinates_of(const Model& model, const registry::ParameterValues& values,
                                                  Quantity quantity);

/// Whether every coordinate that the quantity uses is finite and in its range, and the lobe exists. `room`: size of the
/// output, which must be that of the points. Error: bad_input, naming point, coordinate, value and range.
Result<void> check_request(const Model& model, const Request& request, std::size_t room);

/// Whether every number of the queries is finite and in its range; `room` as for check_request. Error: bad_input,
/// naming query, coordinate, value and range.
Result<void> check_queries(std::span<const SampleQuery> queries, std::size_t room);

/// Evaluates on the CPU (f32 or f64) with all threads; the same bits for any number of them. Errors: as check_request.
Result<void> evaluate(const Model& model, const registry::ParameterValues& values, Precision precision,
                      const Request& request, std::span<glm::dvec3> out);

/// S of a lobe (-1: of all) with all threads, by Model::scattering_from_viewer: points in a row that share the viewer
/// (theta_o, phi_o, h) are made together. false where the model has none. `effort`: 1 or more, as there. Against
/// `evaluate`: huang_lights_test. Errors: as check_request.
Result<bool> scattering_from_viewers(const Model& model, const registry::ParameterValues& values, int effort, int lobe,
                                     std::span<const Point> points, std::span<glm::dvec3> out);

/// The model's own means of N (Model::azimuthal_means) in double with all threads; false where it has none for these
/// values. Errors: usage for a lobe that the model lacks; bad_input, naming interval, value and range.
Result<bool> azimuthal_means(const Model& model, const registry::ParameterValues& values, int lobe,
                             std::span<const AzimuthInterval> intervals, std::span<AzimuthMean> out);

/// Draws directions on the CPU (f32 or f64) with all threads; the same bits for any number of them. Errors: usage,
/// where the model has no sampler; as check_queries.
Result<void> sample(const Model& model, const registry::ParameterValues& values, Precision precision,
                    std::span<const SampleQuery> queries, std::span<Sample> out);

}  // namespace cuticle::bsdf
