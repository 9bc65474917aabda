// The elementary functions in float against double, at arguments that are floats.
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

/// Arguments around 0, over signs, up to `most`; `scale`: an argument whose value is 1 where the tolerance is absolute.
struct SearchedFunction {
  const char* name;
  double least, most;
  double tolerance;
  const double* scale = nullptr;
  bool second = false;
};
constexpr double k_sine_is_one = 1.57079637050628662109375, k_cosine_is_one = 0;

/// Tolerances: as the declarations in core/shared state them.
constexpr SearchedFunction k_functions[] = {{"bessel_i0_scaled", 0, 1e6, 4e-7},
                                            {"sin", -8192, 8192, 1.2e-7, &k_sine_is_one},
                                            {"cos", -8192, 8192, 1.2e-7, &k_cosine_is_one},
                                            {"asin", -1.2, 1.2, 3.2e-7},
                                            {"acos", -1.2, 1.2, 3.2e-7},
                                            {"atan2", -1e6, 1e6, 2e-7, nullptr, true},
                                            {"exp", -87.3, 88.3, 1.6e-7},
                                            {"one_minus_exp", 0, 1e4, 1.6e-7}};

double as_float(double value) { return double(float(value)); }

Json function_case(const SearchedFunction& function, const Place& place) {
  Coordinates at(place);
  const bool even = at.flag();
  const double span = function.most - function.least;
  const double first = even ? at.between(function.least, function.most)
                            : std::max(function.least, at.around_zero(std::min(function.most, span)));
  Json x = Json::list({as_float(first)});
  if (function.scale) x.push_back(*function.scale);
  Json inputs{{"function", function.name}, {"x", std::move(x)}};
  if (function.second) inputs["second"] = as_float(at.around_zero(function.most));
  return Json{{"subject", "function"},
              {"inputs", std::move(inputs)},
              {"expect", Json{{"agree", Json{{"f32", function.tolerance}}}}}};
}

}  // namespace

std::vector<Space> function_spaces() {
  std::vector<Space> all;
  for (const SearchedFunction& function : k_functions)
    all.push_back({.name = std::string("function_") + function.name,
                   .size = function.second ? 3u : 2u,
                   .case_at = [&function](const Place& place) { return function_case(function, place); },
                   .climbs = 100});
  return all;
}

}  // namespace cuticle::hard_cases::search
