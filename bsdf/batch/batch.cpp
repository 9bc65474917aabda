#include "bsdf/batch/batch.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "bsdf/batch/detail/one_by_one.h"
#include "bsdf/batch/detail/padding.h"
#include "bsdf/batch/detail/rows.h"
#include "bsdf/batch/kernel.h"

namespace cuticle::bsdf {
namespace batch {
std::span<const Entry> entries();  // written by CMake (bsdf/CMakeLists.txt)
}

namespace {

// Points in one call, and the least that a thread takes: of a kernel, and where each takes its time.
constexpr std::size_t kernel_block = 4096, slow_block = 64;

const batch::Entry* find_entry(std::string_view model) {
  for (const batch::Entry& entry : batch::entries())
    if (entry.model == model) return &entry;
  return nullptr;
}

struct SizedArray {
  std::string_view name;
  std::size_t size;
};
Result<void> check_sizes(std::size_t count, std::initializer_list<SizedArray> arrays) {
  for (const SizedArray& array : arrays)
    if (array.size != count)
      return bad_input(fmt::format("{} has {} elements, the first array has {}", array.name, array.size, count));
  return {};
}
Result<void> check_points(const BatchPoints& points, bool needs_offset) {
  const std::size_t count = points.to_light.x.size();
  CUTICLE_TRY(check_sizes(count, {{"to_light.y", points.to_light.y.size()},
                                  {"to_light.z", points.to_light.z.size()},
                                  {"to_viewer.x", points.to_viewer.x.size()},
                                  {"to_viewer.y", points.to_viewer.y.size()},
                                  {"to_viewer.z", points.to_viewer.z.size()}}));
  return needs_offset || !points.h.empty() ? check_sizes(count, {{"h", points.h.size()}}) : Result<void>{};
}
Result<void> check_output(std::size_t count, const OutputSpans& out) {
  return check_sizes(count, {{"output x", out.x.size()}, {"output y", out.y.size()}, {"output z", out.z.size()}});
}

batch::DirectionPointers pointers(const BatchPoints& points, std::size_t first) {
  return {points.to_light.x.data() + first,
          points.to_light.y.data() + first,
          points.to_light.z.data() + first,
          points.to_viewer.x.data() + first,
          points.to_viewer.y.data() + first,
          points.to_viewer.z.data() + first,
          (points.h.empty() ? points.to_light.x : points.h).data() + first};
}
std::array<float*, 3> pointers(const OutputSpans& out, std::size_t first) {
  return {out.x.data() + first, out.y.data() + first, out.z.data() + first};
}

batch::QueryPointers pointers(const BatchQueries& queries, std::size_t first) {
  const VectorSpans& viewer = queries.to_viewer;
  const auto u = [&](std::size_t k) { return queries.u[k].data() + first; };
  return {viewer.x.data() + first,
          viewer.y.data() + first,
          viewer.z.data() + first,
          (queries.h.empty() ? viewer.x : queries.h).data() + first,
          {u(0), u(1), u(2), u(3), u(queries.u[4].empty() ? 0 : 4)}};
}
/// `numbers`: how many arrays of random numbers are read.
Result<void> check_queries(const BatchQueries& queries, std::size_t numbers, bool needs_offset) {
  const std::size_t count = queries.to_viewer.x.size();
  CUTICLE_TRY(
      check_sizes(count, {{"to_viewer.y", queries.to_viewer.y.size()}, {"to_viewer.z", queries.to_viewer.z.size()}}));
  if (needs_offset || !queries.h.empty()) CUTICLE_TRY(check_sizes(count, {{"h", queries.h.size()}}));
  for (std::size_t k = 0; k < numbers; ++k) CUTICLE_TRY(check_sizes(count, {{"u", queries.u[k].size()}}));
  return {};
}

VectorSpans one_vector(const glm::vec3& vector) { return {{&vector.x, 1}, {&vector.y, 1}, {&vector.z, 1}}; }
BatchPoints arrays_of_one(const glm::vec3& light, const glm::vec3& viewer, const float& h) {
  return {one_vector(light), one_vector(viewer), {&h, 1}};
}

/// body(first, count) for blocks that cover 0 .. total, on all threads where there are several blocks; each is a task
/// of its own, so that a cancelled group of tasks ends with the blocks in work.
template <class Body>
void in_blocks(std::size_t total, std::size_t block, const Body& body) {
  const std::size_t blocks = (total + block - 1) / block;
  const auto one = [&](std::size_t b) { body(b * block, int(std::min(block, total - b * block))); };
  if (blocks == 1) return one(0);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, blocks, 1),
      [&](const auto& range) {
        for (std::size_t b = range.begin(); b < range.end(); ++b) one(b);
      },
      tbb::simple_partitioner());
}

}  // namespace

bool is_supported(InstructionSet set) {
  const auto built = [&](const batch::Entry& entry) { return entry.kernels[std::size_t(set)] != nullptr; };
  return processor_has(set) && (set == InstructionSet::baseline || std::ranges::any_of(batch::entries(), built));
}

InstructionSet best_instruction_set() {
  for (const InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2})
    if (is_supported(set)) return set;
  return InstructionSet::baseline;
}

Result<BatchEvaluator> BatchEvaluator::make(const Model& model, const registry::ParameterValues& values,
                                            InstructionSet set) {
  if (!is_supported(set)) return usage_error(fmt::format("this processor or build has no {}", name_of(set)));
  BatchEvaluator evaluator(model, values);
  evaluator.numbers_ = model.pack(values);
  evaluator.needs_offset_ = model.near_field && model.near_field(values);
  const batch::Entry* entry = find_entry(model.entry.name);
  const batch::Kernels* kernels = entry ? entry->kernels[std::size_t(set)] : nullptr;
  if (kernels && kernels->holds(evaluator.numbers_.data()))
    evaluator.kernels_ = kernels;
  else if (kernels && kernels->evaluate_integral)
    evaluator.integrals_ = kernels;
  return evaluator;
}

Result<void> BatchEvaluator::evaluate(const BatchPoints& points, const OutputSpans& color) const {
  CUTICLE_TRY(check_points(points, needs_offset_));
  CUTICLE_TRY(check_output(points.to_light.x.size(), color));
  in_blocks(points.to_light.x.size(), kernels_ ? kernel_block : slow_block,
            [&](std::size_t first, int count) { evaluate_block(points, first, count, color); });
  return {};
}

void BatchEvaluator::evaluate_block(const BatchPoints& points, std::size_t first, int count,
                                    const OutputSpans& color) const {
  const std::array<float*, 3> to = pointers(color, first);
  if (integrals_)
    return integrals_->evaluate_integral(numbers_.data(), count, pointers(points, first), {to[0], to[1], to[2]});
  if (!kernels_) return batch::evaluate_one_by_one(*model_, values_, Quantity::S, points, first, count, color);
  batch::in_whole_vectors(count, pointers(points, first), to,
                          [&](int size, const batch::DirectionPointers& in, const std::array<float*, 3>& out) {
                            kernels_->evaluate(numbers_.data(), size, in, {out[0], out[1], out[2]});
                          });
}

Result<void> BatchEvaluator::pdf(const BatchPoints& points, std::span<float> density) const {
  CUTICLE_TRY(check_points(points, needs_offset_));
  CUTICLE_TRY(check_sizes(points.to_light.x.size(), {{"density", density.size()}}));
  in_blocks(density.size(), kernels_ ? kernel_block : slow_block,
            [&](std::size_t first, int count) { pdf_block(points, first, count, density); });
  return {};
}

void BatchEvaluator::pdf_block(const BatchPoints& points, std::size_t first, int count,
                               std::span<float> density) const {
  float* const to = density.data() + first;
  if (integrals_) return integrals_->pdf_integral(numbers_.data(), count, pointers(points, first), to);
  if (!kernels_)
    return batch::evaluate_one_by_one(*model_, values_, Quantity::pdf, points, first, count, {density, {}, {}});
  batch::in_whole_vectors(count, pointers(points, first), {to, to, to},
                          [&](int size, const batch::DirectionPointers& in, const std::array<float*, 3>& out) {
                            kernels_->pdf(numbers_.data(), size, in, out[2]);
                          });
}

glm::vec3 BatchEvaluator::evaluate(const glm::vec3& to_light, const glm::vec3& to_viewer, float h) const {
  glm::vec3 color(0);
  if (kernels_)
    kernels_->evaluate_one(numbers_.data(), {&to_light.x, &to_viewer.x, h}, &color.x);
  else
    evaluate_block(arrays_of_one(to_light, to_viewer, h), 0, 1, {{&color.x, 1}, {&color.y, 1}, {&color.z, 1}});
  return color;
}

float BatchEvaluator::pdf(const glm::vec3& to_light, const glm::vec3& to_viewer, float h) const {
  if (kernels_) return kernels_->pdf_of_one(numbers_.data(), {&to_light.x, &to_viewer.x, h});
  float density = 0;
  pdf_block(arrays_of_one(to_light, to_viewer, h), 0, 1, {&density, 1});
  return density;
}

glm::vec3 BatchEvaluator::sample(const glm::vec3& to_viewer, float h, const std::array<float, 5>& u) const {
  glm::vec3 light(0);
  if (draws_vectorised()) {
    draws()->sample_one(numbers_.data(), &to_viewer.x, h, u.data(), &light.x);
  } else if (model_->sample_f32) {
    BatchQueries queries{one_vector(to_viewer), {&h, 1}, {}};
    for (std::size_t k = 0; k < u.size(); ++k) queries.u[k] = {&u[k], 1};
    batch::sample_one_by_one(*model_, values_, queries, 0, 1, {{&light.x, 1}, {&light.y, 1}, {&light.z, 1}});
  }
  return light;
}

const batch::Kernels* BatchEvaluator::draws() const {
  const batch::Kernels* kernels = kernels_ ? kernels_ : integrals_;
  return kernels && kernels->sample ? kernels : nullptr;
}

bool BatchEvaluator::draws_vectorised() const { return draws() != nullptr; }

Result<void> BatchEvaluator::sample(const BatchQueries& queries, const OutputSpans& to_light) const {
  if (!model_->sample_f32) return usage_error(fmt::format("model {} has no sampler", model_->entry.name));
  const std::size_t count = queries.to_viewer.x.size();
  const bool vectorised = draws_vectorised();
  CUTICLE_TRY(check_queries(queries, vectorised && kernels_ ? 4 : 5, needs_offset_));
  CUTICLE_TRY(check_output(count, to_light));
  in_blocks(count, vectorised ? kernel_block : slow_block, [&](std::size_t first, int size) {
    if (!vectorised) return batch::sample_one_by_one(*model_, values_, queries, first, size, to_light);
    batch::in_whole_vectors(size, pointers(queries, first), pointers(to_light, first),
                            [&](int whole, const batch::QueryPointers& in, const std::array<float*, 3>& out) {
                              draws()->sample(numbers_.data(), whole, in, {out[0], out[1], out[2]});
                            });
  });
  return {};
}

Result<void> BatchEvaluator::evaluate_varying(const BatchPoints& points, std::span<const VaryingParameter> varying,
                                              const OutputSpans& color) const {
  CUTICLE_TRY(check_points(points, needs_offset_));
  CUTICLE_TRY(check_output(points.to_light.x.size(), color));
  if (!kernels_ || !kernels_->evaluate_varying)
    return usage_error(fmt::format("model {} has no parameters that vary from point to point with these settings",
                                   model_->entry.name));
  for (const VaryingParameter& parameter : varying)
    CUTICLE_TRY(check_sizes(points.to_light.x.size(), {{parameter.name, parameter.values.size()}}));
  CUTICLE_ASSIGN(const batch::RowColumns columns,
                 batch::RowColumns::make(*model_, values_, kernels_->varying_numbers(), varying));
  in_blocks(points.to_light.x.size(), batch::row_block, [&](std::size_t first, int count) {
    const batch::VaryingPointPointers from{columns.block(first), pointers(points, first)};
    batch::in_whole_vectors(count, from, pointers(color, first),
                            [&](int size, const batch::VaryingPointPointers& in, const std::array<float*, 3>& out) {
                              kernels_->evaluate_varying(size, in.varying, in.directions, {out[0], out[1], out[2]});
                            });
  });
  return {};
}

}  // namespace cuticle::bsdf
