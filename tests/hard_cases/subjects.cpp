#include "tests/hard_cases/subject.h"

#ifdef CUTICLE_HAS_GPU
#define ON_GPU(run) run
#else
#define ON_GPU(run) nullptr
#endif
#ifdef CUTICLE_HAS_EMBREE
#define WITH_EMBREE(run) run
#else
#define WITH_EMBREE(run) nullptr
#endif

namespace cuticle::hard_cases {

std::span<const Subject> subjects() {
  static constexpr Subject table[] = {
      {"function", {run_function_f32, run_function_f64, ON_GPU(run_function_gpu)}},
      {"model", {run_model_f32, run_model_f64, ON_GPU(run_model_gpu)}},
      {"lut", {run_lut_stored, run_lut_f64, ON_GPU(run_lut_gpu)}},
      {"shadow", {run_shadow_f32, nullptr, ON_GPU(run_shadow_gpu)}},
      {"motion", {run_motion_f32, nullptr, ON_GPU(run_motion_gpu)}},
      {"strands", {run_strands_f32, nullptr, ON_GPU(run_strands_gpu)}},
      {"drawing", {WITH_EMBREE(run_drawing_f32), nullptr, ON_GPU(run_drawing_gpu)}},
      {"fit", {nullptr, run_fit_f64, nullptr}},
  };
  return table;
}

}  // namespace cuticle::hard_cases
