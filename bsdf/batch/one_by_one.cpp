#include "bsdf/batch/detail/one_by_one.h"

#include <cmath>

namespace cuticle::bsdf::batch {
namespace {

struct Angles {
  double theta, phi;
};
Angles angles_at(const VectorSpans& vectors, std::size_t i) {
  const double y = double(vectors.y[i]), z = double(vectors.z[i]);
  return {std::atan2(double(vectors.x[i]), std::hypot(y, z)), std::atan2(z, y)};
}

Point point_at(const BatchPoints& points, std::size_t i) {
  const Angles light = angles_at(points.to_light, i), viewer = angles_at(points.to_viewer, i);
  return {.theta_i = light.theta,
          .theta_o = viewer.theta,
          .theta_d = 0.5 * (viewer.theta - light.theta),
          .phi = viewer.phi - light.phi,
          .h = points.h.empty() ? 0 : double(points.h[i]),
          .phi_o = viewer.phi};
}

SampleQuery query_at(const BatchQueries& queries, std::size_t i) {
  const Angles viewer = angles_at(queries.to_viewer, i);
  SampleQuery query{.theta_o = viewer.theta, .phi_o = viewer.phi, .h = queries.h.empty() ? 0 : double(queries.h[i])};
  for (std::size_t k = 0; k < queries.u.size(); ++k)
    if (!queries.u[k].empty()) query.u[k] = double(queries.u[k][i]);
  return query;
}

void store(std::span<float> out, std::size_t i, double value) {
  if (!out.empty()) out[i] = float(value);
}

}  // namespace

void evaluate_one_by_one(const Model& model, const registry::ParameterValues& values, Quantity quantity,
                         const BatchPoints& points, std::size_t first, int count, const OutputSpans& out) {
  std::vector<Point> block;
  for (std::size_t i = first; i < first + std::size_t(count); ++i) block.push_back(point_at(points, i));
  std::vector<glm::dvec3> results(block.size());
  model.evaluate_f32(values, {quantity, -1, block}, results);
  for (std::size_t i = 0; i < results.size(); ++i) {
    store(out.x, first + i, results[i].x);
    store(out.y, first + i, results[i].y);
    store(out.z, first + i, results[i].z);
  }
}

void sample_one_by_one(const Model& model, const registry::ParameterValues& values, const BatchQueries& queries,
                       std::size_t first, int count, const OutputSpans& out) {
  std::vector<SampleQuery> block;
  for (std::size_t i = first; i < first + std::size_t(count); ++i) block.push_back(query_at(queries, i));
  std::vector<Sample> samples(block.size());
  model.sample_f32(values, block, samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double phi_i = block[i].phi_o - samples[i].phi, cosine = std::cos(samples[i].theta_i);
    store(out.x, first + i, std::sin(samples[i].theta_i));
    store(out.y, first + i, cosine * std::cos(phi_i));
    store(out.z, first + i, cosine * std::sin(phi_i));
  }
}

}  // namespace cuticle::bsdf::batch
