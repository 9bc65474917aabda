#pragma once
// What lookup tables lose and cost beside the model that they stand for: layout x size x format x fit.
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "lut/table_set.h"
#include "study/engine/study.h"
#include "study/luts/table_sampler.h"

namespace cuticle::study {

struct LutsRequest {
  std::vector<std::string> models = {"marschner"};
  std::string settings;              ///< of every model, as --set takes them
  std::vector<std::string> layouts;  ///< empty: all whose tables make S
  std::vector<int> sizes = {16, 32, 64, 128, 256};
  std::vector<std::string> formats = {"exr", "png16", "png8"};
  std::vector<std::string> fits = {"none", "texels"};
  int largest_fitted = 128;   ///< texels each way up to which fits are made
  std::size_t points = 4096;  ///< random directions
};

/// A group for each model: S of the model itself in float, point by point and in arrays, and of every set of tables, at
/// random directions; truth: the model in double. Errors are relative to the root of the mean square of S. Plots:
/// each channel's error (lut::certify) against the bytes of the set. A layout that does not fit a model is noted.
/// Errors: usage for an unknown name; what baking, fitting and certifying say.
Result<Study> luts_study(const LutsRequest& request, Progress& progress);

/// Directions that fill the sphere evenly, as vectors, angles and what a shader has of them.
struct LutDirections {
  std::array<std::vector<float>, 3> light, viewer;
  std::vector<bsdf::Point> points;
  std::vector<ShaderInputs> inputs;
  std::vector<glm::dvec3> truth;  ///< S of the model in double
};
std::shared_ptr<const LutDirections> lut_directions(const bsdf::Model& model, const registry::ParameterValues& values,
                                                    std::size_t count);
/// Points of a group: the model itself, float and in arrays; one set of tables.
Result<std::vector<Point>> direct_points(const bsdf::Model& model, const registry::ParameterValues& values,
                                         std::shared_ptr<const LutDirections> on);
Result<Point> table_point(const lut::TableSet& set, std::string method, std::size_t bytes,
                          std::shared_ptr<const LutDirections> on);

}  // namespace cuticle::study
