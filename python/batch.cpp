// Arrays of unit vectors, without a copy: what bsdf/batch does.
#include <algorithm>

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "bsdf/batch/batch.h"

#include "python/arrays.h"
#include "python/interruptible.h"

namespace cuticle::python {
namespace {

using Target = nb::ndarray<float, nb::c_contig, nb::device::cpu>;

/// Three rows of numbers.
bsdf::VectorSpans rows(const Floats& array, const char* name, std::size_t count) {
  if (array.ndim() != 2 || array.shape(0) != 3 || array.shape(1) != count)
    raise(usage_error(fmt::format("{}: not an array of (3, {})", name, count)));
  return {{array.data(), count}, {array.data() + count, count}, {array.data() + 2 * count, count}};
}

class Batch {
 public:
  Batch(const std::string& model_name, const std::string& preset, const std::string& settings)
      : evaluator_(make(model_name, preset, settings)) {}

  void evaluate(const Floats& to_light, const Floats& to_viewer, const std::optional<Floats>& h,
                const Target& color) const {
    const std::size_t count = count_of(color, 3);
    float* const out = color.data();
    const bsdf::OutputSpans spans = {{out, count}, {out + count, count}, {out + 2 * count, count}};
    run(count, points_of(to_light, to_viewer, h, count),
        [&](const bsdf::BatchPoints& points) { return evaluator_.evaluate(points, spans); });
  }
  void pdf(const Floats& to_light, const Floats& to_viewer, const std::optional<Floats>& h,
           const Target& density) const {
    const std::size_t count = density.size();
    run(count, points_of(to_light, to_viewer, h, count), [&](const bsdf::BatchPoints& points) {
      return evaluator_.pdf(points, {density.data(), count});
    });
  }
  /// `u`: eight rows of numbers.
  void sample(const Floats& to_viewer, const std::optional<Floats>& h, const Floats& u, const Target& to_light) const {
    const std::size_t count = count_of(to_light, 3);
    if (u.ndim() != 2 || u.shape(0) != 8 || u.shape(1) != count)
      raise(usage_error(fmt::format("u: not an array of (8, {})", count)));
    bsdf::BatchQueries queries{.to_viewer = rows(to_viewer, "to_viewer", count), .h = offsets(h), .u = {}};
    for (std::size_t k = 0; k < 8; ++k) queries.u[k] = {u.data() + k * count, count};
    float* const out = to_light.data();
    require(interruptible([&] {
      return evaluator_.sample(queries, {{out, count}, {out + count, count}, {out + 2 * count, count}});
    }));
  }
  bool is_vectorised() const { return evaluator_.is_vectorised(); }

 private:
  static bsdf::BatchEvaluator make(const std::string& model_name, const std::string& preset,
                                   const std::string& settings) {
    const bsdf::Model* model = value_or_raise(bsdf::find_model(model_name));
    return value_or_raise(
        bsdf::BatchEvaluator::make(*model, value_or_raise(bsdf::parse_settings(*model, preset, settings))));
  }
  static std::size_t count_of(const Target& array, std::size_t components) {
    if (array.ndim() != 2 || array.shape(0) != components) raise(usage_error("out: not an array of (3, points)"));
    return array.shape(1);
  }
  static std::span<const float> offsets(const std::optional<Floats>& h) {
    return h ? std::span<const float>(h->data(), h->size()) : std::span<const float>();
  }
  static bsdf::BatchPoints points_of(const Floats& to_light, const Floats& to_viewer, const std::optional<Floats>& h,
                                     std::size_t count) {
    return {rows(to_light, "to_light", count), rows(to_viewer, "to_viewer", count), offsets(h)};
  }
  template <class Call>
  static void run(std::size_t count, const bsdf::BatchPoints& points, const Call& call) {
    constexpr std::size_t few = 1 << 16;  // a thread to look for signals costs more
    if (count > few) return require(interruptible([&] { return call(points); }));
    require(call(points));
  }

  bsdf::BatchEvaluator evaluator_;
};

}  // namespace

void add_batch(nb::module_& module) {
  nb::class_<Batch>(module, "Batch")
      .def(nb::init<const std::string&, const std::string&, const std::string&>())
      .def("evaluate", &Batch::evaluate, nb::arg(), nb::arg(), nb::arg().none(), nb::arg())
      .def("pdf", &Batch::pdf, nb::arg(), nb::arg(), nb::arg().none(), nb::arg())
      .def("sample", &Batch::sample, nb::arg(), nb::arg().none(), nb::arg(), nb::arg())
      .def("is_vectorised", &Batch::is_vectorised);
}

}  // namespace cuticle::python
