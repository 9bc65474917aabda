#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "bsdf/batch/batch.h"
#include "bsdf/fibre/fibres.h"
#include "bsdf/listing/listing.h"
#include "bsdf/model.h"
#include "bsdf/pigment/pigment.h"
#include "bsdf/together.h"
#include "core/memory_limit.h"
#include "study/conformance/conformance.h"

#include "python/arrays.h"
#include "python/interruptible.h"
#include "python/points.h"
#include "python/signals.h"
#include "python/unit_vectors.h"

namespace cuticle::python {
namespace {

bsdf::Precision find_precision(const std::string& name) {
  if (name == "f64") return bsdf::Precision::f64;
  if (name == "f32") return bsdf::Precision::f32;
  raise(usage_error("precision '" + name + "' is not one of f32, f64",
                    "the program for the GPU: cuticle eval --precision gpu"));
}

/// A named hair in the model's parameters. Error: usage.
Result<bsdf::FibreMapping> map_hair(const bsdf::Model& model, const std::string& hair) {
  CUTICLE_ASSIGN(const bsdf::NamedFibre named, bsdf::find_fibre(hair));
  if (!model.from_fibre)
    return usage_error("model " + std::string(model.entry.name) + " has no mapping from a hair", "set={...}");
  return model.from_fibre(named.fibre);
}

/// Settings over the hair, where one is named, or over the preset.
registry::ParameterValues find_values(const bsdf::Model& model, const std::string& preset, const std::string& settings,
                                      const std::string& hair) {
  if (hair.empty()) return value_or_raise(bsdf::parse_settings(model, preset, settings));
  if (!preset.empty()) raise(usage_error("preset and hair exclude each other"));
  const std::string mapped = value_or_raise(map_hair(model, hair)).settings;
  return value_or_raise(bsdf::parse_settings(model, "", settings.empty() ? mapped : mapped + "," + settings));
}

/// The array that is returned.
Result<void> require_room(const std::vector<std::size_t>& shape) {
  constexpr std::uint64_t huge = std::uint64_t(1) << 56;
  const std::vector<std::uint64_t> lengths(shape.begin(), shape.end());
  const std::uint64_t count = product_within(huge, lengths).value_or(huge);
  return require_memory(fmt::format("broadcasting to {} points", fmt::join(lengths, " x ")),
                        {count, sizeof(glm::dvec3)});
}

/// Numbers that nobody has written yet: the work writes each once, in the thread that computes it.
struct Unset {
  explicit Unset(std::size_t points) : values(new double[3 * points]) {}
  std::span<glm::dvec3> span(std::size_t first, std::size_t count) {
    return {reinterpret_cast<glm::dvec3*>(values.get()) + first, count};
  }
  std::unique_ptr<double[]> values;
};

/// What a block of points is computed by: the batch where it does this (S and pdf in float), else the formulas one by
/// one.
class BlockEvaluator {
 public:
  BlockEvaluator(const bsdf::Model& model, const registry::ParameterValues& values, bsdf::Precision precision,
                 const bsdf::Request& what)
      : values_(values),
        what_(what),
        run_(precision == bsdf::Precision::f32 ? model.evaluate_f32 : model.evaluate_f64) {
    const bool in_batch = what.quantity == bsdf::Quantity::S || what.quantity == bsdf::Quantity::pdf;
    if (precision != bsdf::Precision::f32 || !in_batch || what.lobe != -1) return;
    auto batch = bsdf::BatchEvaluator::make(model, values);
    if (batch && batch->is_vectorised()) batch_ = std::move(batch).value();
  }
  /// Points from `first` on, as many as `out` has room for.
  Result<void> operator()(const PointReader& points, std::size_t first, std::span<glm::dvec3> out) const {
    if (batch_) return in_batch(points, first, out);
    std::vector<bsdf::Point>& read = scratch_points();
    CUTICLE_TRY(points.read(first, out.size(), read));
    run_(values_, {what_.quantity, what_.lobe, read}, out);
    return {};
  }

 private:
  Result<void> in_batch(const PointReader& points, std::size_t first, std::span<glm::dvec3> out) const {
    using bsdf::Point;
    constexpr double Point::*members[] = {&Point::theta_i, &Point::theta_o, &Point::phi, &Point::phi_o, &Point::h};
    thread_local UnitVectors vectors;
    thread_local std::vector<double> columns;
    thread_local std::vector<float> results;
    const std::size_t count = out.size();
    columns.resize(5 * count);
    for (std::size_t k = 0; k < 5; ++k)
      CUTICLE_TRY(points.read_column(members[k], first, {columns.data() + k * count, count}));
    vectors.set(columns, count);
    results.resize(3 * count);
    const std::span<float> x(results.data(), count), y(results.data() + count, count),
        z(results.data() + 2 * count, count);
    if (what_.quantity == bsdf::Quantity::pdf) {
      CUTICLE_TRY(batch_->pdf(vectors.points(), x));
      for (std::size_t i = 0; i < count; ++i) out[i] = glm::dvec3(x[i]);
      return {};
    }
    CUTICLE_TRY(batch_->evaluate(vectors.points(), {x, y, z}));
    for (std::size_t i = 0; i < count; ++i) out[i] = {x[i], y[i], z[i]};
    return {};
  }

  const registry::ParameterValues& values_;
  const bsdf::Request& what_;
  void (*run_)(const registry::ParameterValues&, const bsdf::Request&, std::span<glm::dvec3>);
  std::optional<bsdf::BatchEvaluator> batch_;
};

/// Parts of a run of points that take about 50 ms each, so that signals and progress are not kept waiting.
class Parts {
 public:
  explicit Parts(std::size_t count) : count_(count) {}
  std::size_t first() const { return first_; }
  std::size_t end() const { return std::min(first_ + length_, count_); }
  std::size_t grain() const { return std::clamp<std::size_t>(length_ >> 5, 4, 1 << 11); }
  bool is_done() const { return first_ >= count_; }
  void go_on() {
    const auto now = std::chrono::steady_clock::now();
    first_ = end();
    if (now - begun_ < std::chrono::milliseconds(50)) length_ = std::min<std::size_t>(4 * length_, 1 << 20);
    begun_ = now;
  }

 private:
  std::size_t count_, first_ = 0, length_ = 1 << 8;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// Without the interpreter's lock; between two parts a signal may end it.
Result<void> evaluate_in_parts(const bsdf::Model& model, const registry::ParameterValues& values,
                               bsdf::Precision precision, const bsdf::Request& what, const PointReader& points,
                               Unset& out, CalledProgress& progress) {
  const BlockEvaluator evaluate(model, values, precision, what);
  const nb::gil_scoped_release released;
  for (Parts parts(points.count()); !parts.is_done();) {
    FirstError failed;
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(parts.first(), parts.end(), parts.grain()),
        [&](const auto& range) {
          const Result<void> done = evaluate(points, range.begin(), out.span(range.begin(), range.size()));
          if (!done) failed.set(done.error());
        },
        tbb::simple_partitioner());
    CUTICLE_TRY(failed.result());
    parts.go_on();
    progress.update("eval", parts.first(), points.count());
  }
  return {};
}

/// What a model's quantity depends on, by the names of eval's arguments less "_deg".
std::vector<std::string> needed(const std::string& model_name, const std::string& quantity_name,
                                const std::string& preset, const std::string& settings, const std::string& hair) {
  constexpr std::array<const char*, bsdf::coordinate_count> names = {"theta_i", "theta_o", "theta_d",
                                                                     "phi",     "h",       "phi_o"};
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = find_values(*model, preset, settings, hair);
  const auto used = bsdf::coordinates_of(*model, values, value_or_raise(bsdf::find_quantity(quantity_name)));
  std::vector<std::string> result;
  for (std::size_t c = 0; c < names.size(); ++c)
    if (used[c]) result.emplace_back(names[c]);
  return result;
}

/// All points at once, those of one viewer together.
Result<void> evaluate_viewers(const bsdf::Model& model, const registry::ParameterValues& values, int effort,
                              const bsdf::Request& what, const PointReader& points, Unset& out) {
  std::vector<bsdf::Point> read;
  CUTICLE_TRY(points.read(0, points.count(), read));
  return interruptible([&] {
    return bsdf::evaluate_together(model, values, effort, {what.quantity, what.lobe, read},
                                   out.span(0, points.count()));
  });
}

OutputArray evaluate(const std::string& model_name, const std::string& quantity_name, const std::string& lobe_name,
                     const std::string& preset, const std::string& settings, const std::string& hair,
                     const std::vector<Numbers>& coordinates, const std::string& precision_name,
                     std::optional<int> together, const nb::object& call) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = find_values(*model, preset, settings, hair);
  const bsdf::Quantity quantity = value_or_raise(bsdf::find_quantity(quantity_name));
  const int lobe = value_or_raise(bsdf::find_lobe(*model, lobe_name));
  const bsdf::Precision precision = find_precision(precision_name);
  std::vector<std::size_t> shape = broadcast_shape(coordinates);
  require(require_room(shape));
  const PointReader points(coordinates, shape);
  Unset out(points.count());
  CalledProgress progress(call);
  const bsdf::Request what{quantity, lobe, {}};
  require(together ? evaluate_viewers(*model, values, *together, what, points, out)
                   : evaluate_in_parts(*model, values, precision, what, points, out, progress));
  shape.push_back(3);
  double* flat = out.values.release();
  const nb::capsule owner(flat, [](void* memory) noexcept { delete[] static_cast<double*>(memory); });
  return OutputArray(flat, shape.size(), shape.data(), owner);
}

/// (settings, words) of a hair in a model's parameters.
std::pair<std::string, std::string> hair_mapping(const std::string& model_name, const std::string& hair) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const bsdf::FibreMapping mapping = value_or_raise(map_hair(*model, hair));
  return {mapping.settings, mapping.words};
}

std::vector<std::string> hairs() {
  std::vector<std::string> names;
  for (const bsdf::NamedFibre& named : bsdf::fibres()) names.emplace_back(named.name);
  return names;
}

using Color = std::array<double, 3>;

Color as_color(const glm::dvec3& rgb) { return {rgb.x, rgb.y, rgb.z}; }

Color absorption_of_pigments(const std::string& table, double eumelanin, double pheomelanin) {
  const bsdf::PigmentTable found = value_or_raise(bsdf::find_pigment_table(table));
  return as_color(value_or_raise(bsdf::absorption_of_pigments(found, eumelanin, pheomelanin)));
}

Color absorption_of_assembly(const Color& color, double beta_n) {
  return as_color(value_or_raise(bsdf::absorption_of_assembly({color[0], color[1], color[2]}, beta_n)));
}

Color absorption_of_fibre(const std::string& model_name, const Color& color, const std::string& settings) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  const registry::ParameterValues values = value_or_raise(bsdf::parse_settings(*model, "", settings));
  return as_color(value_or_raise(bsdf::absorption_of_fibre(*model, values, {color[0], color[1], color[2]})));
}

std::vector<std::string> lobes(const std::string& model_name) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
  return {model->lobes.begin(), model->lobes.end()};
}

/// A model's values with tolerances, as CSV.
std::string conformance(const std::string& name) {
  const bsdf::Model* model = value_or_raise(bsdf::find_model(name));
  return study::conformance_csv(*model, value_or_raise(interruptible([&] { return study::conformance_rows(*model); })));
}

}  // namespace

void add_evaluate(nb::module_& module) {
  module.def("conformance", &conformance);
  module.def("evaluate", &evaluate, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg(), nb::arg().none(), nb::arg().none());
  module.def("needed", &needed);
  module.def("absorption_of_pigments", &absorption_of_pigments);
  module.def("absorption_of_assembly", &absorption_of_assembly);
  module.def("absorption_of_fibre", &absorption_of_fibre);
  module.def("hair_mapping", &hair_mapping);
  module.def("hairs", &hairs);
  module.def("models_json", &bsdf::models_json);
  module.def("lobes", &lobes);
}

}  // namespace cuticle::python
