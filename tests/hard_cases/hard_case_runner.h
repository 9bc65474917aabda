#pragma once
// The catalogue of hard cases (hard_cases.json, compiled in) and its runner: places where hair code is known to break, each with
// what must hold there, through the public interfaces, in float, double and on the device.
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
  std::string id, subject, why;  ///< of the case; `why` says what makes it hard
  Precision precision = Precision::f64;
  State state = State::not_applicable;
  std::string detail;            ///< what failed: the number, and what was allowed
};

/// Runs every case in f32 and f64, and on `device` unless it is null. Values must be finite; beyond that each case names a reference
/// value (mpmath, reference_values.py) with a tolerance per precision, bounds, agreement with f64, or the error that must come.
/// `subject`: only the cases about it; empty: all. Errors: usage for a subject that no case has; internal, when the catalogue itself
/// cannot be read.
Result<std::vector<Verdict>> run_hard_cases(const std::string& subject, const std::shared_ptr<gpu::Device>& device, Progress& progress);

/// As run_hard_cases, on a catalogue given as JSON text.
Result<std::vector<Verdict>> run_catalogue(const std::string& json, const std::shared_ptr<gpu::Device>& device, Progress& progress);

}  // namespace cuticle::hard_cases
