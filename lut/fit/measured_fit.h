#pragma once
// Models fitted to a measured fibre: on one half of its directions, to be judged on the other.
#include <string>
#include <vector>

#include "bsdf/measured/measured.h"
#include "lut/fit/model_fit.h"

namespace cuticle::lut {

/// Whether a direction is one that models are fitted to; the others judge them.
inline bool fits(std::size_t direction) { return direction % 2 == 0; }

/// Where a lobe is looked for: TT where phi is farther than 120 degrees from back toward the light; of the rest R where
/// theta_i + theta_o < 0, the side that scales which lean to the tip throw it to, and TRT where it is above.
enum class LobeZone { r, tt, trt };
LobeZone zone_of(const bsdf::MeasuredDirection& direction);

struct MeasuredFitRequest {
  const bsdf::Model* model = nullptr;
  std::vector<std::string> free = {};  ///< empty: those that the model calls measurable
  std::string preset = {},
              settings = {};  ///< fixed values, and where the search begins; empty: it begins at several fibres
  Loss loss = Loss::squares;
  std::size_t most_directions = 250;  ///< of the half that is fitted; more are thinned evenly
};

/// A model as it was fitted, and what it predicts for all directions of the file, in the file's units.
struct MeasuredModel {
  ModelFit fit;
  std::vector<glm::dvec3> predicted;
};

/// Fits up to a factor (goniometers' units are their own), from the fibres blond, brown and black, wide and narrow, and
/// keeps the best: least squares of S has local minima. Parameters that the data cannot tell are left at their start.
/// Test: measured_fit_test. Errors: those of fit_model; bad_input for fewer than eight directions.
Result<MeasuredModel> fit_measured(const MeasuredFitRequest& request, const bsdf::MeasuredFibre& fibre);

/// Root of the mean square of predicted less measured over that of the measured, of the directions that judge, of one
/// zone or of all; NaN where there are none.
double judged_error(const MeasuredModel& model, const bsdf::MeasuredFibre& fibre);
double judged_error(const MeasuredModel& model, const bsdf::MeasuredFibre& fibre, LobeZone zone);

}  // namespace cuticle::lut
