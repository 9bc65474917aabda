// Directions drawn from models.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "bsdf/model.h"

#include "python/arrays.h"
#include "python/interruptible.h"

namespace cuticle::python {
namespace {

std::vector<bsdf::SampleQuery> queries_of(const Numbers& theta_o, const Numbers& h, const Numbers& phi_o,
                                          const Numbers& u) {
  const auto theta = rows_of<double>(theta_o, "theta_o"), offset = rows_of<double>(h, "h"),
             azimuth = rows_of<double>(phi_o, "phi_o");
  const auto numbers = rows_of<std::array<double, 8>>(u, "u");
  if (offset.size() != theta.size() || azimuth.size() != theta.size() || numbers.size() != theta.size())
    raise(usage_error("u: not eight numbers for each direction"));
  std::vector<bsdf::SampleQuery> queries(theta.size());
  for (std::size_t i = 0; i < queries.size(); ++i) queries[i] = {theta[i], azimuth[i], offset[i], numbers[i]};
  return queries;
}

/// theta_i, phi (radians), pdf, weight and lobe of each.
nb::tuple sample(const std::string& model_name, const std::string& preset, const std::string& settings, bool is_single,
                 const Numbers& theta_o, const Numbers& h, const Numbers& phi_o, const Numbers& u) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = value_or_raise(bsdf::parse_settings(*model, preset, settings));
  const std::vector<bsdf::SampleQuery> queries = queries_of(theta_o, h, phi_o, u);
  const std::size_t count = queries.size();
  std::vector<bsdf::Sample> samples(count);
  const auto precision = is_single ? bsdf::Precision::f32 : bsdf::Precision::f64;
  require(interruptible([&] { return bsdf::sample(*model, values, precision, queries, samples); }));
  std::vector<double> theta_i(count), phi(count), pdf(count), weight;
  std::vector<std::int32_t> lobe(count);
  weight.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    theta_i[i] = samples[i].theta_i, phi[i] = samples[i].phi, pdf[i] = samples[i].pdf, lobe[i] = samples[i].lobe;
    weight.insert(weight.end(), {samples[i].weight.x, samples[i].weight.y, samples[i].weight.z});
  }
  return nb::make_tuple(take(std::move(theta_i), {count}), take(std::move(phi), {count}), take(std::move(pdf), {count}),
                        take(std::move(weight), {count, 3}), take(std::move(lobe), {count}));
}

}  // namespace

void add_sampling(nb::module_& module) { module.def("sample", &sample); }

}  // namespace cuticle::python
