#pragma once
// All models of one physical fibre in the same picture, against path tracing with one of them.
#include <memory>
#include <string>

#include "core/progress.h"
#include "gpu/device.h"
#include "study/picture/picture_study.h"

namespace cuticle::study {

struct ModelsRequest {
  LadderRequest ladder = {};  ///< scene, fibre, truth's model, paths; `model` and `without` are not used
  int table_size = 128;       ///< texels a side of the tables
};

/// A group of points model x (direct, tables): the scene's hair at rest, path traced by each. Models that take no
/// physical fibre or have no sampler are named in a note, as are tables that a model has none of. Errors: what drawing
/// says of the truth.
Result<Study> models_study(std::shared_ptr<gpu::Device> device, const ModelsRequest& request, Progress& progress);

}  // namespace cuticle::study
