#include "study/models/models_study.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/core.h>

#include "bsdf/model.h"
#include "lut/table_set.h"
#include "study/luts/table_sampler.h"
#include "study/oracle/rough_fibre.h"

namespace cuticle::study {
namespace {

using std::numbers::pi;
using Colors = std::vector<glm::dvec3>;

constexpr double k_viewers[] = {0, pi / 6, pi / 3};
constexpr int k_crossings = 12;

oracle::RoughFibre walked(const bsdf::Fibre& fibre) {
  oracle::RoughFibre rough;
  rough.eta = fibre.eta;
  rough.sigma_a = fibre.sigma_a;
  rough.surface.roughness = fibre.longitudinal_deviation / std::sqrt(2.0);  // as huang maps it
  rough.tilt = fibre.scale_tilt;
  return rough;
}

/// The bins' mean S, all viewers one after the other, and the rms of its standard error.
struct Truth {
  Colors values;
  double noise = 0;
};

Truth walk_all(const ModelsRequest& request, Progress& progress) {
  Truth truth;
  double squares = 0;
  for (std::size_t v = 0; v < std::size(k_viewers); ++v) {
    progress.update("viewers walked from", v, std::size(k_viewers));
    const oracle::DirectionBins bins{request.thetas, request.phis};
    const auto orders = oracle::scattering_of(walked(request.fibre), {k_viewers[v], 0, {}}, bins, k_crossings, request.walks, 20260501 + v);
    Colors sum(orders[0].density.size(), glm::dvec3(0));
    for (const oracle::OrderScattering& order : orders)
      for (std::size_t b = 0; b < sum.size(); ++b) {
        sum[b] += order.density[b].mean;
        squares += order.density[b].standard_error.y * order.density[b].standard_error.y;
      }
    truth.values.insert(truth.values.end(), sum.begin(), sum.end());
  }
  truth.noise = std::sqrt(squares / double(truth.values.size()));
  return truth;
}

/// The directions of all bins, `inner` x `inner` each, even in the sine of the inclination.
std::vector<bsdf::Point> directions(const ModelsRequest& request) {
  std::vector<bsdf::Point> points;
  for (const double theta_o : k_viewers)
    for (int t = 0; t < request.thetas; ++t)
      for (int p = 0; p < request.phis; ++p)
        for (int i = 0; i < request.inner; ++i)
          for (int k = 0; k < request.inner; ++k) {
            const double low = std::sin(pi * (double(t) / request.thetas - 0.5)), high = std::sin(pi * (double(t + 1) / request.thetas - 0.5));
            const double sine = low + (high - low) * (i + 0.5) / request.inner;
            points.push_back({.theta_i = std::asin(sine), .theta_o = theta_o, .phi = 2 * pi * ((p + (k + 0.5) / request.inner) / request.phis - 0.5)});
          }
  return points;
}

double rms(const Colors& values) {
  double sum = 0;
  for (const glm::dvec3& value : values) sum += (value.x * value.x + value.y * value.y + value.z * value.z) / 3;
  return std::sqrt(sum / double(values.size()));
}

/// What all points of the group share.
struct Shared {
  std::vector<bsdf::Point> points;
  Truth truth;
  std::size_t inner = 1;  ///< directions of a bin

  Measured errors_of(const Colors& values, double bytes) const {
    const double scale = 1 / rms(truth.values);
    std::vector<double> errors;
    for (std::size_t b = 0; b < truth.values.size(); ++b) {
      glm::dvec3 off = -truth.values[b];
      for (std::size_t k = 0; k < inner; ++k) off += values[b * inner + k] / double(inner);
      errors.push_back(scale * std::sqrt((off.x * off.x + off.y * off.y + off.z * off.z) / 3));
    }
    return {{errors}, bytes};
  }
};
using SharedPtr = std::shared_ptr<const Shared>;

constexpr std::size_t k_timed = 256;

Point direct_point(const bsdf::Model& model, const registry::ParameterValues& values, const SharedPtr& shared) {
  const auto measure = [&model, values, shared]() -> Result<Measured> {
    Colors out(shared->points.size());
    CUTICLE_TRY(bsdf::evaluate(model, values, bsdf::Precision::f32, {bsdf::Quantity::S, -1, shared->points}, out));
    return shared->errors_of(out, 0);
  };
  const auto work = [&model, values, shared, out = std::make_shared<Colors>(k_timed)]() -> Result<void> {
    model.evaluate_f32(values, {bsdf::Quantity::S, -1, std::span(shared->points).first(k_timed)}, *out);
    return {};
  };
  return {std::string(model.entry.name), {{"evaluate", "direct"}}, measure, {{}, work, double(k_timed)}};
}

ShaderInputs inputs_of(const bsdf::Point& at) {
  return {float(std::sin(at.theta_i)), float(std::sin(at.theta_o)), float(std::cos(at.phi))};
}

Result<Point> table_point(const bsdf::Model& model, const registry::ParameterValues& values, const SharedPtr& shared) {
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout("nalu"));
  CUTICLE_ASSIGN(const lut::TableSet set, lut::bake(model, values, *layout, 128, silent_progress()));
  CUTICLE_ASSIGN(TableSampler made, TableSampler::make(set));
  const auto sampler = std::make_shared<const TableSampler>(std::move(made));
  const auto measure = [sampler, shared]() -> Result<Measured> {
    Colors out;
    for (const bsdf::Point& at : shared->points) out.emplace_back(sampler->scattering(inputs_of(at)));
    return shared->errors_of(out, 0);
  };
  std::vector<ShaderInputs> inputs;
  for (std::size_t i = 0; i < k_timed; ++i) inputs.push_back(inputs_of(shared->points[i]));
  const auto work = [sampler, inputs]() -> Result<void> {
    glm::vec3 sum(0);
    for (const ShaderInputs& in : inputs) sum += sampler->scattering(in);
    volatile float sink = sum.x + sum.y + sum.z;
    static_cast<void>(sink);
    return {};
  };
  return Point{std::string(model.entry.name), {{"evaluate", "tables"}}, measure, {{}, work, double(k_timed)}};
}

/// The far field where the model has both.
std::string far_field_of(const bsdf::Model& model) {
  const auto found = std::ranges::find(model.entry.parameters, "field", &registry::Parameter::name);
  return found == model.entry.parameters.end() ? "" : ",field=far";
}

}  // namespace

Result<Group> models_against_walks(const ModelsRequest& request, std::vector<std::string>& notes, Progress& progress) {
  ModelsRequest round = request;
  round.fibre.aspect = 1;
  round.fibre.medulla_ratio = 0;
  const auto shared = std::make_shared<Shared>(Shared{directions(round), walk_all(round, progress), std::size_t(round.inner) * std::size_t(round.inner)});
  Group group{.name = "lobes",
              .title = "Every model against light walked through a rough fibre",
              .truth = fmt::format("{} walks through facets for each of 3 viewers; mean S over {} bins of directions; standard error over the rms {:.2g}",
                                   request.walks, shared->truth.values.size(), shared->truth.noise / rms(shared->truth.values)),
              .metrics = {{"S", "rms error of S / rms of S", "1", Mean::root_mean_square}},
              .item = "bin",
              .floor = shared->truth.noise / rms(shared->truth.values)};
  for (const bsdf::Model* model : bsdf::models()) {
    if (!model->from_fibre) continue;
    const bsdf::FibreMapping mapping = model->from_fibre(round.fibre);
    notes.push_back(fmt::format("{}: {} ({})", model->entry.name, mapping.settings, mapping.words));
    CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(*model, "", mapping.settings + far_field_of(*model)));
    group.points.push_back(direct_point(*model, values, shared));
    Result<Point> tables = table_point(*model, values, shared);
    if (tables)
      group.points.push_back(std::move(*tables));
    else
      notes.push_back(fmt::format("No tables of {}: {}", model->entry.name, tables.error().message));
  }
  return group;
}

}  // namespace cuticle::study
