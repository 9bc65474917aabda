#include <nanobind/stl/string.h>

#include "study/model_check/registered.h"
#include "study/model_check/report.h"

#include "python/arrays.h"
#include "python/interruptible.h"
#include "python/signals.h"

namespace cuticle::python {
namespace {

namespace checks = study::model_check;

/// One column of a batch as a numpy array.
template <class Item>
nb::object column(std::span<const Item> items, double Item::*member) {
  std::vector<double> values;
  for (const Item& item : items) values.push_back(item.*member);
  return nb::cast(take(std::move(values), {items.size()}));
}

/// What a function returned, as an array of `count` rows with one or three numbers. Raises ValueError for another
/// shape.
Numbers rows(const nb::object& returned, std::size_t count) {
  const nb::object array =
      nb::module_::import_("numpy").attr("ascontiguousarray")(returned, nb::arg("dtype") = "float64");
  const Numbers numbers = nb::cast<Numbers>(array);
  if (numbers.size() != count && numbers.size() != 3 * count)
    raise(usage_error(
        "a function returned " + std::to_string(numbers.size()) + " numbers for " + std::to_string(count) + " points",
        "one number or three a point"));
  return numbers;
}

glm::dvec3 row(const Numbers& numbers, std::size_t count, std::size_t i) {
  const double* data = numbers.data();
  return numbers.size() == count ? glm::dvec3(data[i]) : glm::dvec3(data[3 * i], data[3 * i + 1], data[3 * i + 2]);
}

/// A function of theta_i, theta_o, phi, h (radians; arrays of one length).
checks::Batch scattering_of(const nb::object& function) {
  if (function.is_none()) return nullptr;
  return [function](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
    const Numbers numbers = rows(function(column(points, &bsdf::Point::theta_i), column(points, &bsdf::Point::theta_o),
                                          column(points, &bsdf::Point::phi), column(points, &bsdf::Point::h)),
                                 out.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = row(numbers, out.size(), i);
  };
}

/// A function of theta_o, h.
checks::Batch albedo_of(const nb::object& function) {
  if (function.is_none()) return nullptr;
  return [function](std::span<const bsdf::Point> points, std::span<glm::dvec3> out) {
    const Numbers numbers =
        rows(function(column(points, &bsdf::Point::theta_o), column(points, &bsdf::Point::h)), out.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = row(numbers, out.size(), i);
  };
}

/// A function of theta_o, h, u (rows of eight numbers) that returns theta_i, phi, pdf, weight.
checks::Draw sampler_of(const nb::object& function) {
  if (function.is_none()) return nullptr;
  return [function](std::span<const bsdf::SampleQuery> queries, std::span<bsdf::Sample> out) {
    std::vector<double> u;
    for (const bsdf::SampleQuery& query : queries) u.insert(u.end(), query.u.begin(), query.u.end());
    const nb::object returned =
        function(column(queries, &bsdf::SampleQuery::theta_o), column(queries, &bsdf::SampleQuery::h),
                 nb::cast(take(std::move(u), {queries.size(), 8})));
    const std::size_t count = out.size();
    const Numbers theta_i = rows(returned[0], count), phi = rows(returned[1], count), pdf = rows(returned[2], count),
                  weight = rows(returned[3], count);
    for (std::size_t i = 0; i < count; ++i)
      out[i] = {row(theta_i, count, i).x, row(phi, count, i).x, row(pdf, count, i).x, row(weight, count, i), -1};
  };
}

std::string check_functions(const nb::object& scattering, const nb::object& pdf, const nb::object& sample,
                            const nb::object& albedo, bool near_field, bool white, bool complete, bool quick,
                            const nb::object& call) {
  checks::Scatterer scatterer;
  scatterer.label = "function";
  scatterer.scattering = scattering_of(scattering);
  scatterer.pdf = scattering_of(pdf);
  scatterer.sample = sampler_of(sample);
  scatterer.albedo = albedo_of(albedo);
  const checks::Subject subject = checks::fixed_subject(scatterer, near_field, white, complete);
  CalledProgress progress(call);
  const checks::Report report = check_subject(subject, {}, {.quick = quick}, progress);
  return checks::to_json({&report, 1});
}

std::string check_registered(const std::string& name, const std::string& preset, const std::string& settings,
                             const std::string& precision, bool quick, const nb::object& call) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(name));
  const registry::ParameterValues values = value_or_raise(bsdf::parse_settings(*model, preset, settings));
  if (precision != "f32" && precision != "f64")
    raise(usage_error("precision '" + precision + "' is not one of f32, f64"));
  const checks::Subject subject =
      checks::subject_of(*model, values, precision == "f32" ? bsdf::Precision::f32 : bsdf::Precision::f64);
  CalledProgress progress(call);
  return interruptible([&] {
    const checks::Report report =
        check_subject(subject, checks::exceptions_of(*model, values), {.quick = quick}, progress);
    return checks::to_json({&report, 1});
  });
}

}  // namespace

void add_check(nb::module_& module) {
  module.def("check_functions", &check_functions, nb::arg().none(), nb::arg().none(), nb::arg().none(),
             nb::arg().none(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg().none());
  module.def("check_registered", &check_registered, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg().none());
}

}  // namespace cuticle::python
