// What an evaluation of each fibre model costs on one core and how exact it is: S, pdf and sample of every registered
// model through its scalar float formulas from angles, and for every instruction set that this processor has through
// arrays and point by point. Random directions over the sphere and random offsets; the error is that of float against
// double on the same directions, relative to the value or to a millionth of the largest. Beside them the operations of
// the formulas, counted, and the time for each of them relative to chiang's near field.
#include <algorithm>
#include <numbers>

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <CLI/CLI.hpp>

#include "bsdf/batch/batch.h"
#include "core/json/json.h"
#include "core/random.h"
#include "bench/calibration.h"
#include "bench/operations.h"

namespace {

using namespace cuticle;
using namespace cuticle::bsdf;

struct Options {
  std::vector<std::string> models;
  std::string set, preset, reference, format = "text";
  bool tiers = false;
};

/// One measurement.
struct Row {
  std::string model, settings, path, task;
  double ns = 0, median_error = 0, tail_error = 0, largest_error = 0;
  double operations = 0, ratio = 0;  ///< of one point; of the time for each to that of chiang
};

struct Arrays {
  std::vector<float> x, y, z;
  explicit Arrays(std::size_t count) : x(count), y(count), z(count) {}
  VectorSpans in(std::size_t n) const { return {std::span(x).first(n), std::span(y).first(n), std::span(z).first(n)}; }
  OutputSpans out(std::size_t n) { return {std::span(x).first(n), std::span(y).first(n), std::span(z).first(n)}; }
};

constexpr std::size_t most_points = 16384;

/// Random directions, as vectors for arrays and as angles for scalar formulas.
struct Directions {
  Arrays light{most_points}, viewer{most_points}, out{most_points};
  std::vector<float> h = std::vector<float>(most_points), density = h;
  std::array<std::vector<float>, 5> u;
  std::vector<Point> points;
  std::vector<SampleQuery> queries;

  Directions() {
    RandomStream random(7);
    for (std::size_t i = 0; i < most_points; ++i) {
      set(light, i, random);
      set(viewer, i, random);
      h[i] = float(2 * random.next_unit() - 1);
      for (auto& numbers : u) numbers.push_back(float(random.next_word() >> 8) * 0x1p-24f);
      points.push_back(point(i));
      queries.push_back({.theta_o = points[i].theta_o, .h = points[i].h});
      for (std::size_t k = 0; k < u.size(); ++k) queries[i].u[k] = double(u[k][i]);
    }
  }
  static void set(Arrays& to, std::size_t i, RandomStream& random) {
    const double s = 2 * random.next_unit() - 1, phi = 2 * std::numbers::pi * random.next_unit(),
                 c = std::sqrt(1 - s * s);
    to.x[i] = float(s);
    to.y[i] = float(c * std::cos(phi));
    to.z[i] = float(c * std::sin(phi));
  }
  Point point(std::size_t i) const {
    const auto theta = [&](const Arrays& v) {
      return std::atan2(double(v.x[i]), std::hypot(double(v.y[i]), double(v.z[i])));
    };
    const auto phi = [&](const Arrays& v) { return std::atan2(double(v.z[i]), double(v.y[i])); };
    const double theta_i = theta(light), theta_o = theta(viewer);
    return {theta_i, theta_o, (theta_o - theta_i) / 2, phi(viewer) - phi(light), double(h[i]), phi(viewer)};
  }
  BatchPoints batch_points(std::size_t n) const { return {light.in(n), viewer.in(n), std::span(h).first(n)}; }
  std::vector<bench::Place> places() const {
    std::vector<bench::Place> all;
    for (std::size_t i = 0; i < 500; ++i)
      all.push_back({{light.x[i], light.y[i], light.z[i]}, {viewer.x[i], viewer.y[i], viewer.z[i]}, h[i]});
    return all;
  }
  BatchQueries batch_queries(std::size_t n) const {
    BatchQueries result{viewer.in(n), std::span(h).first(n), {}};
    for (std::size_t k = 0; k < u.size(); ++k) result.u[k] = std::span(u[k]).first(n);
    return result;
  }
};

/// ns for each of so many items that a run takes about 2 ms: the best of 40 runs, or of as many as fit into a second.
template <class Work>
double best_ns(const Work& work) {
  const double probe = bench::best_ms(2, [&] { work(8); }) / 8;
  const std::size_t count = std::clamp<std::size_t>(std::size_t(2 / std::max(probe, 1e-9)), 8, most_points);
  const double run_ms = probe * double(count);
  const int runs = std::clamp(int(1000 / std::max(run_ms, 1e-3)), 2, 200);
  return bench::best_ms(runs, [&] { work(count); }) * 1e6 / double(count);
}

/// Fills the errors of a row from values and the truth.
void set_errors(Row& row, std::span<const glm::dvec3> values, std::span<const glm::dvec3> truth) {
  double largest = 0;
  for (const glm::dvec3& t : truth) largest = std::max({largest, t.x, t.y, t.z});
  std::vector<double> errors;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c)
      errors.push_back(std::abs(values[i][c] - truth[i][c]) / std::max({truth[i][c], 1e-6 * largest, 1e-300}));
  std::ranges::sort(errors);
  row.median_error = errors[errors.size() / 2];
  row.tail_error = errors[errors.size() * 99 / 100];
  row.largest_error = errors.back();
}

/// One model with one group of settings.
class Subject {
 public:
  Subject(const Model& model, std::string settings, registry::ParameterValues values, Directions& on)
      : model_(model), settings_(std::move(settings)), values_(std::move(values)), on_(on) {}

  std::vector<Row> measure() {
    std::vector<Row> rows;
    rows.push_back(scalar("S", Quantity::S));
    checked_ = std::clamp<std::size_t>(std::size_t(1e9 / rows[0].ns / 4), 16, most_points);
    set_truth();
    add_errors(rows[0], Quantity::S);
    if (model_.sample_f32) {
      rows.push_back(scalar("pdf", Quantity::pdf));
      add_errors(rows.back(), Quantity::pdf);
      rows.push_back(scalar_sample());
    }
    for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
      if (is_supported(set)) batch(*BatchEvaluator::make(model_, values_, set), name_of(set), rows);
    return rows;
  }

 private:
  Row row(std::string_view path, std::string_view task) const {
    return {std::string(model_.entry.name), settings_, std::string(path), std::string(task)};
  }

  Row scalar(std::string_view task, Quantity quantity) {
    Row result = row("scalar", task);
    result.ns = best_ns([&](std::size_t n) {
      model_.evaluate_f32(values_, {quantity, -1, std::span(on_.points).first(n)}, std::span(results_).first(n));
    });
    return result;
  }
  Row scalar_sample() {
    Row result = row("scalar", "sample and weight");
    std::vector<Sample> samples(most_points);
    result.ns = best_ns([&](std::size_t n) {
      model_.sample_f32(values_, std::span(on_.queries).first(n), std::span(samples).first(n));
    });
    return result;
  }

  void set_truth() {
    const auto points = std::span(on_.points).first(checked_);
    truth_.assign(checked_, glm::dvec3(0));
    truth_pdf_ = truth_;
    model_.evaluate_f64(values_, {Quantity::S, -1, points}, truth_);
    if (model_.sample_f32) model_.evaluate_f64(values_, {Quantity::pdf, -1, points}, truth_pdf_);
  }
  void add_errors(Row& to, Quantity quantity) {
    const auto results = std::span(results_).first(checked_);
    model_.evaluate_f32(values_, {quantity, -1, std::span(on_.points).first(checked_)}, results);
    set_errors(to, results, quantity == Quantity::pdf ? truth_pdf_ : truth_);
  }

  /// By the batch's formulas; 0 where these settings have none.
  double operations(bool density) const {
    return bench::operations_of(model_.entry.name, model_.pack(values_), density, on_.places());
  }

  void batch(const BatchEvaluator& evaluator, std::string_view path, std::vector<Row>& rows) {
    if (!evaluator.is_vectorised()) return;
    rows.push_back(row(path, "S"));
    rows.back().operations = operations(false);
    rows.back().ns =
        best_ns([&](std::size_t n) { return evaluator.evaluate(on_.batch_points(n), on_.out.out(n)).ok(); });
    static_cast<void>(evaluator.evaluate(on_.batch_points(checked_), on_.out.out(checked_)));
    for (std::size_t i = 0; i < checked_; ++i) results_[i] = glm::dvec3(on_.out.x[i], on_.out.y[i], on_.out.z[i]);
    set_errors(rows.back(), std::span(results_).first(checked_), truth_);
    batch_varying(evaluator, path, rows);
    points(evaluator, fmt::format("{}, point", path), rows);
    if (!model_.sample_f32) return;
    rows.push_back(row(path, "pdf"));
    rows.back().operations = operations(true);
    rows.back().ns = best_ns(
        [&](std::size_t n) { return evaluator.pdf(on_.batch_points(n), std::span(on_.density).first(n)).ok(); });
    static_cast<void>(evaluator.pdf(on_.batch_points(checked_), std::span(on_.density).first(checked_)));
    for (std::size_t i = 0; i < checked_; ++i) results_[i] = glm::dvec3(double(on_.density[i]));
    set_errors(rows.back(), std::span(results_).first(checked_), truth_pdf_);
    if (!evaluator.draws_vectorised()) return;
    rows.push_back(row(path, "sample"));
    rows.back().ns =
        best_ns([&](std::size_t n) { return evaluator.sample(on_.batch_queries(n), on_.out.out(n)).ok(); });
  }

  static glm::vec3 vector_at(const Arrays& v, std::size_t i) { return {v.x[i], v.y[i], v.z[i]}; }

  /// One call for each point, with parameters prepared before.
  void points(const BatchEvaluator& evaluator, const std::string& path, std::vector<Row>& rows) {
    rows.push_back(row(path, "S"));
    const auto color = [&](std::size_t i) {
      return evaluator.evaluate(vector_at(on_.light, i), vector_at(on_.viewer, i), on_.h[i]);
    };
    rows.back().ns = best_ns([&](std::size_t n) {
      for (std::size_t i = 0; i < n; ++i) on_.out.x[i] = color(i).x;
    });
    for (std::size_t i = 0; i < checked_; ++i) results_[i] = glm::dvec3(color(i));
    set_errors(rows.back(), std::span(results_).first(checked_), truth_);
    if (!model_.sample_f32) return;
    rows.push_back(row(path, "pdf"));
    const auto density = [&](std::size_t i) {
      return evaluator.pdf(vector_at(on_.light, i), vector_at(on_.viewer, i), on_.h[i]);
    };
    rows.back().ns = best_ns([&](std::size_t n) {
      for (std::size_t i = 0; i < n; ++i) on_.density[i] = density(i);
    });
    for (std::size_t i = 0; i < checked_; ++i) results_[i] = glm::dvec3(double(density(i)));
    set_errors(rows.back(), std::span(results_).first(checked_), truth_pdf_);
    rows.push_back(row(path, "sample"));
    rows.back().ns = best_ns([&](std::size_t n) {
      for (std::size_t i = 0; i < n; ++i)
        on_.out.x[i] = evaluator
                           .sample(vector_at(on_.viewer, i), on_.h[i],
                                   {on_.u[0][i], on_.u[1][i], on_.u[2][i], on_.u[3][i], on_.u[4][i]})
                           .x;
    });
  }

  /// S where the first parameter has a value for each point (the same one, so that the errors are those of S).
  void batch_varying(const BatchEvaluator& evaluator, std::string_view path, std::vector<Row>& rows) {
    const registry::Parameter& first = model_.entry.parameters[0];
    const bool is_rgb = first.type == registry::ParameterType::rgb;
    const std::string name = fmt::format("{}{}", first.name, is_rgb ? ".r" : "");
    const std::vector<float> values(most_points, float(is_rgb ? values_.rgb(first.name).r : values_.real(first.name)));
    const auto run = [&](std::size_t n) {
      const std::array<VaryingParameter, 1> varying = {{{name, std::span(values).first(n)}}};
      return evaluator.evaluate_varying(on_.batch_points(n), varying, on_.out.out(n)).ok();
    };
    if (!run(8)) return;
    rows.push_back(row(path, "S, varying"));
    rows.back().ns = best_ns(run);
  }

  const Model& model_;
  std::string settings_;
  registry::ParameterValues values_;
  Directions& on_;
  std::size_t checked_ = 0;
  std::vector<glm::dvec3> results_ = std::vector<glm::dvec3>(most_points), truth_, truth_pdf_;
};

/// ns times the digits that are missing to none: what one correct decimal digit costs.
double ns_per_digit(const Row& row) {
  return row.tail_error > 0 ? row.ns / std::max(-std::log10(row.tail_error), 0.1) : row.ns / 16;
}

/// Fills the ratios: the time for each operation over that of chiang's near field on the same path, where it was
/// measured.
void set_ratios(std::vector<Row>& rows) {
  for (Row& r : rows) {
    const auto chiang = std::ranges::find_if(rows, [&](const Row& other) {
      return other.model == "chiang" && other.path == r.path && other.task == r.task && other.operations > 0;
    });
    if (chiang != rows.end() && r.operations > 0) r.ratio = (r.ns / r.operations) / (chiang->ns / chiang->operations);
  }
}

void print_text(const std::vector<Row>& rows, double scale) {
  fmt::print("{:14} {:18} {:15} {:18} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {:>6} {:>8}\n", "model", "settings", "path",
             "task", "ns", "ns scaled", "median", "99 %", "largest", "ns/digit", "ops", "x chiang");
  for (const Row& r : rows) {
    fmt::print("{:14} {:18} {:15} {:18} {:9.2f} {:9.2f}", r.model, r.settings, r.path, r.task, r.ns, r.ns / scale);
    if (r.largest_error > 0)
      fmt::print(" {:8.1e} {:8.1e} {:8.1e} {:8.2f}", r.median_error, r.tail_error, r.largest_error, ns_per_digit(r));
    if (r.operations > 0) fmt::print(" {:6.0f} {:8.2f}", r.operations, r.ratio);
    fmt::print("\n");
  }
}
void print_csv(const std::vector<Row>& rows, double scale) {
  fmt::print(
      "model,settings,path,task,ns,ns_scaled,median_error,error_99,largest_error,ns_per_digit,operations,ratio_to_"
      "chiang\n");
  for (const Row& r : rows)
    fmt::print("{},\"{}\",\"{}\",\"{}\",{:.5g},{:.5g},{:.3g},{:.3g},{:.3g},{:.4g},{:.4g},{:.3g}\n", r.model, r.settings,
               r.path, r.task, r.ns, r.ns / scale, r.median_error, r.tail_error, r.largest_error, ns_per_digit(r),
               r.operations, r.ratio);
}
void print_json(const std::vector<Row>& rows, double scale) {
  Json all = {{"scale", scale}, {"rows", Json::list()}};
  for (const Row& r : rows)
    all["rows"].push_back({{"model", r.model},
                           {"settings", r.settings},
                           {"path", r.path},
                           {"task", r.task},
                           {"ns", r.ns},
                           {"ns_scaled", r.ns / scale},
                           {"median_error", r.median_error},
                           {"error_99", r.tail_error},
                           {"largest_error", r.largest_error},
                           {"ns_per_digit", ns_per_digit(r)},
                           {"operations", r.operations},
                           {"ratio_to_chiang", r.ratio}});
  fmt::print("{}\n", all.dump(1));
}

/// The settings to measure a model with: what was asked for, or its defaults and a near field, and its tiers.
std::vector<std::string> settings_of(const Model& model, const Options& options) {
  std::vector<std::string> all = {options.set};
  const auto is_near = [&](const registry::StudyCase& tier) {
    return model.near_field && model.near_field(*parse_settings(model, "", tier.settings));
  };
  const auto near = std::ranges::find_if(model.entry.study_cases, is_near);
  if (options.set.empty() && !options.tiers && near != model.entry.study_cases.end()) all.emplace_back(near->settings);
  if (options.tiers)
    for (const registry::StudyCase& tier : model.entry.study_cases) all.emplace_back(tier.settings);
  return all;
}

Result<std::vector<Row>> measure_all(const Options& options) {
  Directions directions;
  std::vector<Row> rows;
  for (const Model* model : models()) {
    if (!options.models.empty() && std::ranges::find(options.models, model->entry.name) == options.models.end())
      continue;
    for (const std::string& settings : settings_of(*model, options)) {
      CUTICLE_ASSIGN(registry::ParameterValues values, parse_settings(*model, options.preset, settings));
      const std::vector<Row> more = Subject(*model, settings, std::move(values), directions).measure();
      rows.insert(rows.end(), more.begin(), more.end());
    }
  }
  set_ratios(rows);
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Cost and error of fibre models on one core");
  app.add_option("--models", options.models, "only these")->delimiter(',');
  app.add_option("--set", options.set, "settings for all of them, as of cuticle eval");
  app.add_option("--preset", options.preset, "blond, brown or black");
  app.add_flag("--tiers", options.tiers, "also every tier of accuracy that a model names");
  app.add_option("--reference", options.reference, "bench/reference.json: times are scaled to that machine too");
  app.add_option("--format", options.format)->check(CLI::IsMember({"text", "csv", "json"}));
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  double scale = 1;
  if (!options.reference.empty()) scale = bench::machine_scale(options.reference);
  const auto rows = measure_all(options);
  if (!rows.ok()) {
    fmt::print(stderr, "{}\n", rows.error().message);
    return 2;
  }
  options.format == "json"  ? print_json(*rows, scale)
  : options.format == "csv" ? print_csv(*rows, scale)
                            : print_text(*rows, scale);
}
