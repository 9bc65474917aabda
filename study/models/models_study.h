#pragma once
// All registered models under one truth: their lobes against light walked through a rough fibre, and the final picture
// against path tracing with the microfacet model.
#include <string>
#include <vector>

#include "bsdf/fibre.h"
#include "core/progress.h"
#include "study/engine/study.h"

namespace cuticle::study {

struct ModelsRequest {
  bsdf::Fibre fibre;         ///< made round and without medulla
  std::int64_t walks = 400000;  ///< of the truth, for each of three inclinations of the viewer
  int thetas = 18, phis = 24;  ///< bins of directions toward the light
  int inner = 3;               ///< directions along each side of a bin that a model is evaluated at
};

/// The group `lobes`: mean S of every model over bins of directions toward the light, far field, viewers at 0, 30 and 60
/// degrees, against the Monte Carlo walk (study/oracle); error over the rms of the truth. Each model with the
/// parameters that it maps the fibre onto, by its formulas in float, and by the tables of the layout `nalu`, 128 x 128,
/// where it has the lobes of one. Notes say what a model cannot express. Errors: what evaluation and baking say.
Result<Group> models_against_walks(const ModelsRequest& request, std::vector<std::string>& notes, Progress& progress);

}  // namespace cuticle::study
