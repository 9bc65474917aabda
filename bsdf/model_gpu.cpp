#include "bsdf/model_gpu.h"

#include <algorithm>

#include <fmt/core.h>

#include "bsdf/shared/batch.h"
#include "gpu/groups.h"

namespace cuticle::bsdf {
namespace {

/// Push constants of gpu/evaluate.comp.
struct Batch {
  std::uint32_t count;
  std::int32_t quantity, lobe;
};

const GpuModel* find_gpu_model(std::string_view name) {
  for (const GpuModel& model : gpu_models())
    if (model.name == name) return &model;
  return nullptr;
}

using DevicePoint = EvaluationPoint<float>;
static_assert(sizeof(DevicePoint) == 6 * sizeof(float), "gpu/evaluate.comp reads six floats a point");

using DeviceQuery = SamplePoint<float>;
static_assert(sizeof(DeviceQuery) == 11 * sizeof(float), "gpu/sample.comp reads eleven floats a query");

/// What gpu/sample.comp writes for each query.
struct DeviceSample {
  float theta_i, phi, pdf, weight[3], lobe;
};

template <class Narrow, class Wide>
std::vector<Narrow> narrow_all(std::span<const Wide> items) {
  std::vector<Narrow> narrowed(items.size());
  std::transform(items.begin(), items.end(), narrowed.begin(), [](const Wide& item) { return narrow<float>(item); });
  return narrowed;
}

Sample widened(const DeviceSample& drawn) {
  return {drawn.theta_i, drawn.phi, drawn.pdf, {drawn.weight[0], drawn.weight[1], drawn.weight[2]}, int(drawn.lobe)};
}

/// Mesa's software Vulkan ends all loops of an invocation after 65,535 rounds, and the result is wrong.
constexpr std::uint64_t most_software_rounds = 65535;

}  // namespace

Result<void> check_loops(const gpu::Device& device, const Model& model, const registry::ParameterValues& values,
                         Quantity quantity) {
  if (!device.info().is_software || !model.loop_rounds) return {};
  const std::uint64_t rounds = model.loop_rounds(values, quantity);
  if (rounds <= most_software_rounds) return {};
  return usage_error(fmt::format("model {}: about {} loop rounds a point, software Vulkan takes at most {}",
                                 model.entry.name, rounds, most_software_rounds),
                     "precision f32, or fewer samples");
}

Result<GpuEvaluator> GpuEvaluator::make(gpu::Device& device, const Model& model) {
  const GpuModel* gpu_model = find_gpu_model(model.entry.name);
  if (!gpu_model) return usage_error(fmt::format("model {} has no GPU kernel", model.entry.name), "precision f32");
  gpu::ShaderInterface interface { .storage_buffers = 3, .push_constant_bytes = sizeof(Batch) };
  CUTICLE_ASSIGN(gpu::Kernel kernel, device.make_kernel(gpu_model->evaluate_spirv, interface));
  return GpuEvaluator(device, model, std::move(kernel));
}

Result<void> GpuEvaluator::evaluate_chunk(const gpu::Buffer& parameters, const Request& request,
                                          std::span<glm::dvec3> out) {
  const std::vector<DevicePoint> narrowed = narrow_all<DevicePoint>(request.points);
  CUTICLE_ASSIGN(gpu::Buffer points, gpu::make_buffer_from(*device_, std::span<const DevicePoint>(narrowed)));
  CUTICLE_ASSIGN(gpu::Buffer results, device_->make_buffer(out.size() * sizeof(glm::vec3)));
  gpu::Commands commands = device_->record();
  commands.begin_pass("bsdf evaluate");
  record(commands, parameters, points, results, std::uint32_t(out.size()), request.quantity, request.lobe);
  commands.end_pass();
  CUTICLE_TRY(device_->submit(std::move(commands)));
  CUTICLE_ASSIGN(std::vector<glm::vec3> values, gpu::read_buffer<glm::vec3>(*device_, results, out.size()));
  std::copy(values.begin(), values.end(), out.begin());
  return {};
}

void GpuEvaluator::record(gpu::Commands& commands, const gpu::Buffer& parameters, const gpu::Buffer& points,
                          const gpu::Buffer& results, std::uint32_t count, Quantity quantity, int lobe) const {
  const Batch batch{count, std::int32_t(quantity), lobe};
  const gpu::Groups groups = gpu::groups_for(count);
  commands.dispatch(kernel_, {&parameters, &points, &results}, {}, gpu::bytes_of(batch), groups.x, groups.y);
}

void GpuEvaluator::record_counted(gpu::Commands& commands, const gpu::Buffer& parameters, const gpu::Buffer& points,
                                  const gpu::Buffer& results, std::uint32_t count, const gpu::Buffer& numbers,
                                  std::size_t offset) const {
  const Batch batch{count, std::int32_t(Quantity::S), -1};
  const gpu::Buffer* const buffers[] = {&parameters, &points, &results};
  commands.dispatch_counted(kernel_, buffers, {}, gpu::bytes_of(batch), numbers, offset);
}

Result<gpu::Buffer> GpuEvaluator::upload(const registry::ParameterValues& values) const {
  return gpu::make_buffer_from(*device_, std::span<const float>(model_->pack(values)));
}

Result<void> GpuEvaluator::evaluate(const registry::ParameterValues& values, const Request& request,
                                    std::span<glm::dvec3> out) {
  CUTICLE_TRY(check_request(*model_, request, out.size()));
  CUTICLE_TRY(check_loops(*device_, *model_, values, request.quantity));
  CUTICLE_ASSIGN(const gpu::Buffer parameters, upload(values));
  const std::uint64_t limit = device_->info().max_storage_buffer_bytes;
  for (const gpu::Chunk& chunk : gpu::chunks(out.size(), sizeof(DevicePoint), limit)) {
    const std::size_t size = chunk.end - chunk.begin;
    const Request part{request.quantity, request.lobe, request.points.subspan(chunk.begin, size)};
    CUTICLE_TRY(evaluate_chunk(parameters, part, out.subspan(chunk.begin, size)));
  }
  return {};
}

Result<void> GpuEvaluator::make_sample_kernel() {
  if (sample_kernel_) return {};
  const GpuModel* gpu_model = find_gpu_model(model_->entry.name);
  gpu::ShaderInterface interface { .storage_buffers = 3, .push_constant_bytes = sizeof(std::uint32_t) };
  CUTICLE_ASSIGN(sample_kernel_, device_->make_kernel(gpu_model->sample_spirv, interface));
  return {};
}

Result<void> GpuEvaluator::sample_chunk(const gpu::Buffer& parameters, std::span<const SampleQuery> queries,
                                        std::span<Sample> out) {
  const std::vector<DeviceQuery> narrowed = narrow_all<DeviceQuery>(queries);
  CUTICLE_ASSIGN(gpu::Buffer numbers, gpu::make_buffer_from(*device_, std::span<const DeviceQuery>(narrowed)));
  CUTICLE_ASSIGN(gpu::Buffer results, device_->make_buffer(out.size() * sizeof(DeviceSample)));
  const std::uint32_t count = std::uint32_t(out.size());
  gpu::Commands commands = device_->record();
  const gpu::Groups groups = gpu::groups_for(count);
  commands.begin_pass("bsdf sample");
  commands.dispatch(*sample_kernel_, {&parameters, &numbers, &results}, {}, gpu::bytes_of(count), groups.x, groups.y);
  commands.end_pass();
  CUTICLE_TRY(device_->submit(std::move(commands)));
  CUTICLE_ASSIGN(std::vector<DeviceSample> drawn, gpu::read_buffer<DeviceSample>(*device_, results, out.size()));
  std::transform(drawn.begin(), drawn.end(), out.begin(), widened);
  return {};
}

Result<void> GpuEvaluator::sample(const registry::ParameterValues& values, std::span<const SampleQuery> queries,
                                  std::span<Sample> out) {
  CUTICLE_TRY(check_queries(queries, out.size()));
  CUTICLE_TRY(make_sample_kernel());
  CUTICLE_ASSIGN(const gpu::Buffer parameters, upload(values));
  const std::uint64_t limit = device_->info().max_storage_buffer_bytes;
  for (const gpu::Chunk& chunk : gpu::chunks(out.size(), sizeof(DeviceQuery), limit)) {
    const std::size_t size = chunk.end - chunk.begin;
    CUTICLE_TRY(sample_chunk(parameters, queries.subspan(chunk.begin, size), out.subspan(chunk.begin, size)));
  }
  return {};
}

Result<void> evaluate_gpu(gpu::Device& device, const Model& model, const registry::ParameterValues& values,
                          const Request& request, std::span<glm::dvec3> out) {
  CUTICLE_ASSIGN(GpuEvaluator evaluator, GpuEvaluator::make(device, model));
  return evaluator.evaluate(values, request, out);
}

}  // namespace cuticle::bsdf
