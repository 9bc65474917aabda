// Elementary functions: {"function", "x", "second"}; x may be a list.
#include <algorithm>
#include <array>

#include "core/json/json.h"
#include "tests/hard_cases/subject.h"
#include "tests/hard_cases/elementary.glslh"
#ifdef CUTICLE_HAS_GPU
#include "tests/hard_cases/elementary_gpu.h"
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {
namespace {

constexpr std::array<std::string_view, 8> k_names = {"bessel_i0_scaled", "sin", "cos", "asin", "acos", "atan2", "exp", "one_minus_exp"};

Result<std::uint32_t> function_index(const Json& inputs) {
  const std::string name = inputs.at("function").text();
  const auto found = std::find(k_names.begin(), k_names.end(), name);
  if (found == k_names.end()) return internal_error("unknown function " + name);
  return std::uint32_t(found - k_names.begin());
}

template <class Real>
Result<Values> run(const Json& inputs) {
  CUTICLE_ASSIGN(const std::uint32_t function, function_index(inputs));
  Values values;
  for (double x : numbers(inputs.at("x"))) values.push_back(double(elementary(function, Real(x), Real(inputs.value("second", 0.0)))));
  return values;
}

}  // namespace

Result<Values> run_function_f32(const Json& inputs, GpuSession*) { return run<float>(inputs); }
Result<Values> run_function_f64(const Json& inputs, GpuSession*) { return run<double>(inputs); }

#ifdef CUTICLE_HAS_GPU
Result<Values> run_function_gpu(const Json& inputs, GpuSession* session) {
  CUTICLE_ASSIGN(const std::uint32_t function, function_index(inputs));
  std::vector<glm::vec2> arguments;
  for (double x : numbers(inputs.at("x"))) arguments.emplace_back(x, inputs.value("second", 0.0));
  CUTICLE_ASSIGN(const std::vector<float> values, elementary_gpu(*session->device, function, arguments));
  return Values(values.begin(), values.end());
}
#endif

}  // namespace cuticle::hard_cases
