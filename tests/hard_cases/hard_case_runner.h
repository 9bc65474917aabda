#pragma once
// Runs the catalogue of hard cases: places where hair code is known to break, each with what must hold there, through
// the public interfaces, in float, double and on the device.
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"

namespace cuticle::gpu {
class Device;
}

namespace cuticle::hard_cases {

/// f32, f64: on the CPU. gpu: in float on the device. Subjects that compute in float only have no f64.
enum class Precision { f32, f64, gpu };
const char* name_of(Precision precision);

enum class State { passed, failed, not_applicable };

/// What one case gave in one precision.
struct Verdict {
  std::string id, family, subject;
  std::string why, source;  ///< of the case: what makes it hard, and where that is described
  Precision precision = Precision::f64;
  State state = State::not_applicable;
  std::string detail;          ///< what failed: the number, and what was allowed
  double used = 0;             ///< the largest share of an allowed error that was used
  std::size_t not_finite = 0;  ///< values that are infinite or NaN
  double seconds = 0;
};

/// Which cases run.
struct Choice {
  std::string family = {};  ///< of these alone; empty: of all
  bool full = false;        ///< those that take seconds too
};

/// Runs the cases in f32 and f64, and on `device` unless it is null. Values must be finite; beyond that each case names
/// a reference value (mpmath, reference_values.py) with a tolerance per precision, bounds, agreement with f64, or the
/// error that must come. Errors: usage for a family that no case has; internal, when the catalogue cannot be read.
Result<std::vector<Verdict>> run_hard_cases(const Choice& choice, const std::shared_ptr<gpu::Device>& device,
                                            Progress& progress);

/// As run_hard_cases, on one document given as JSON text (catalogue.h).
Result<std::vector<Verdict>> run_document(const std::string& json, const std::shared_ptr<gpu::Device>& device,
                                          Progress& progress);

}  // namespace cuticle::hard_cases
