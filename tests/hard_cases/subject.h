#pragma once
// What a case can be about. Each subject turns a case's inputs into numbers; every expectation applies to each number.
#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/json/json.h"
#include "core/result.h"
#include "strands/groom.h"
#include "tests/hard_cases/hard_case_runner.h"

namespace cuticle::hard_cases {

using Values = std::vector<double>;
/// The device and the model kernels made on it so far (gpu_session.h); null on the CPU.
struct GpuSession;
using Run = Result<Values> (*)(const Json& inputs, GpuSession* session);

/// A subject by name, with how it runs in each Precision; null where it does not.
struct Subject {
  std::string_view name;
  std::array<Run, 3> run;
};
std::span<const Subject> subjects();

Result<Values> run_function_f32(const Json& inputs, GpuSession* session);
Result<Values> run_function_f64(const Json& inputs, GpuSession* session);
Result<Values> run_function_gpu(const Json& inputs, GpuSession* session);
Result<Values> run_model_f32(const Json& inputs, GpuSession* session);
Result<Values> run_model_f64(const Json& inputs, GpuSession* session);
Result<Values> run_model_gpu(const Json& inputs, GpuSession* session);
Result<Values> run_lut_stored(const Json& inputs, GpuSession* session);
Result<Values> run_lut_f64(const Json& inputs, GpuSession* session);
Result<Values> run_lut_gpu(const Json& inputs, GpuSession* session);
Result<Values> run_shadow_f32(const Json& inputs, GpuSession* session);
Result<Values> run_shadow_gpu(const Json& inputs, GpuSession* session);
Result<Values> run_motion_f32(const Json& inputs, GpuSession* session);
Result<Values> run_motion_gpu(const Json& inputs, GpuSession* session);
Result<Values> run_strands_f32(const Json& inputs, GpuSession* session);
Result<Values> run_strands_gpu(const Json& inputs, GpuSession* session);
Result<Values> run_drawing_f32(const Json& inputs, GpuSession* session);
Result<Values> run_drawing_gpu(const Json& inputs, GpuSession* session);
Result<Values> run_fit_f64(const Json& inputs, GpuSession* session);

/// A number, a list of numbers, or {"from", "to", "count"}; "nan", "inf" and "-inf" are numbers here.
std::vector<double> numbers(const Json& value);
glm::dvec3 vector(const Json& value);
/// {"points": [[[x, y, z], ...], ...]} or {"lines": [{"from", "to", "vertices", "count", "spacing"}]}, with "radius"; metres.
strands::Groom groom_from(const Json& value);
/// x, y, z of every point.
Values coordinates(std::span<const glm::vec3> points);

}  // namespace cuticle::hard_cases
