#pragma once
// What the checks of a fibre model are made on: any scattering function, given as plain callbacks over batches, so that
// a registered model in either precision, a model broken on purpose or a function of Python can be checked alike.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bsdf/model.h"

namespace cuticle::study::model_check {

/// One rgb for each point; a quantity without colour is in the first channel.
using Batch = std::function<void(std::span<const bsdf::Point>, std::span<glm::dvec3>)>;
/// One sample for each query.
using Draw = std::function<void(std::span<const bsdf::SampleQuery>, std::span<bsdf::Sample>)>;

/// The smooth dielectric cylinder that a model's paths stand for where its lobes are narrow and not tilted.
struct Cylinder {
  double eta = 1.55;      ///< refractive index
  glm::dvec3 sigma_a{0};  ///< absorption per radius
  int orders = 0;         ///< paths that the model follows: R, TT, TRT are 3; 0: all of them
};

/// A model with its parameters fixed. What is null, it does not offer; the checks that need it are skipped.
struct Scatterer {
  std::string label;                                  ///< for messages: "no absorption, narrow"
  Batch scattering;                                   ///< S [1/sr], the cosine of theta_i not included
  Batch pdf;                                          ///< density of `sample` per steradian of incident directions
  Batch albedo;                                       ///< of theta_o (and h in the near field)
  Batch error;                                        ///< bound on the error of S where that is itself a quadrature
  Draw sample;                                        ///< incident directions
  std::vector<std::pair<std::string, Batch>> others;  ///< further quantities, hunted for values that are not finite
  std::optional<Cylinder> cylinder;                   ///< its mean attenuation is that of the model
  double aspect = 1;                                  ///< minor over major axis of an elliptical cross-section
};

/// What a check asks for; `given` leaves the subject's own setting.
enum class Absorption { given, none, coloured };
enum class Roughness { given, narrowest, narrow, usual, wide };
enum class Tilt { given, none, strong };
/// `draft`: for checks of samples and density alone, with as little work on S as the model can be set to.
enum class Effort { given, draft };
struct Situation {
  Absorption absorption = Absorption::given;
  Roughness roughness = Roughness::given;
  Tilt tilt = Tilt::given;
  Effort effort = Effort::given;
};

/// A model to be checked.
struct Subject {
  std::string name;
  bool near_field = false;  ///< S is a function of the offset h
  bool complete = false;    ///< claims to carry all orders: a fibre without absorption scatters everything
  std::size_t lobes = 3;
  double rounding = 1e-12;  ///< relative error that its arithmetic alone may leave
  /// The model in a situation; none where it cannot be put into it.
  std::function<std::optional<Scatterer>(const Situation&)> make;
  bool searched = false;  ///< the search for bad values has been made on another variant, over all parameters
  /// The model with parameters drawn over their ranges by number, corners included; null: it has no parameters.
  std::function<Scatterer(std::uint64_t)> vary;
};

}  // namespace cuticle::study::model_check
