#pragma once
// Slices of opacity maps and layers of deep opacity maps, at several resolutions, against truth: error against time.
#include <cstdint>
#include <vector>

#include "study/shadows/comparison.h"

namespace cuticle::study {

struct SlicesStudy {
  std::vector<std::int64_t> layers{1, 2, 4, 8, 16, 32, 64, 128};  ///< slices or layers; each method takes those it can
  std::vector<std::int64_t> resolutions{128, 256, 512};
  ComparisonRequest request;  ///< candidates are filled in
};
/// Fewer slices and resolutions, 300 receivers, 256 rays: for demos and tests.
SlicesStudy quick_slices_study();

/// Every layers x resolution of both kinds of map, the filter as wide as the truth's footprint (at least half a texel).
Result<Comparison> run_slices_study(const SlicesStudy& study, Progress& progress);

/// The groom of the study where none is given: a coat of strands on a half sphere, combed over, 0.2 m across,
/// deterministic.
strands::Groom study_coat(int strands = 20000);

}  // namespace cuticle::study
