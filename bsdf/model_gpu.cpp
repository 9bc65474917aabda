#include <cuticle/bsdf/model_gpu.h>

#include <algorithm>

#include <fmt/core.h>

#include <cuticle/bsdf/shared/batch.h>

namespace cuticle::bsdf {
namespace {

constexpr std::uint32_t group_size = 64;      // local_size_x of gpu/evaluate.comp
constexpr std::uint64_t most_groups = 65535;  // every Vulkan device allows so many in one direction

/// Push constants of gpu/evaluate.comp.
struct Batch {
  std::uint32_t count;
  std::int32_t quantity, lobe;
};

const GpuModel* find_gpu_model(std::string_view name) {
  for (const GpuModel* model : gpu_models())
    if (model->name == name) return model;
  return nullptr;
}

using DevicePoint = EvaluationPoint<float>;
static_assert(sizeof(DevicePoint) == 6 * sizeof(float), "gpu/evaluate.comp reads six floats a point");

std::vector<DevicePoint> narrow_points(std::span<const Point> points) {
  std::vector<DevicePoint> narrowed(points.size());
  std::transform(points.begin(), points.end(), narrowed.begin(),
                 [](const Point& point) { return narrow<float>(point); });
  return narrowed;
}

}  // namespace

Result<GpuEvaluator> GpuEvaluator::make(gpu::Device& device, const Model& model) {
  const GpuModel* gpu_model = find_gpu_model(model.entry.name);
  if (!gpu_model) return usage_error(fmt::format("model {} has no GPU kernel", model.entry.name), "precision f32");
  gpu::ShaderInterface interface { .storage_buffers = 3, .push_constant_bytes = sizeof(Batch) };
  CUTICLE_ASSIGN(gpu::Kernel kernel, device.make_kernel(gpu_model->evaluate_spirv, interface));
  return GpuEvaluator(device, model, std::move(kernel));
}

Result<void> GpuEvaluator::evaluate_chunk(const gpu::Buffer& parameters, const Request& request,
                                          std::span<glm::dvec3> out) {
  const std::vector<DevicePoint> narrowed = narrow_points(request.points);
  CUTICLE_ASSIGN(gpu::Buffer points, gpu::make_buffer_from(*device_, std::span<const DevicePoint>(narrowed)));
  CUTICLE_ASSIGN(gpu::Buffer results, device_->make_buffer(out.size() * sizeof(glm::vec3)));
  const Batch batch{std::uint32_t(out.size()), std::int32_t(request.quantity), request.lobe};
  gpu::Commands commands = device_->record();
  commands.begin_pass("bsdf evaluate");
  commands.dispatch(kernel_, {&parameters, &points, &results}, {}, gpu::bytes_of(batch),
                    (batch.count + group_size - 1) / group_size);
  commands.end_pass();
  CUTICLE_TRY(device_->submit(std::move(commands)));
  CUTICLE_ASSIGN(std::vector<glm::vec3> values, gpu::read_buffer<glm::vec3>(*device_, results, out.size()));
  std::copy(values.begin(), values.end(), out.begin());
  return {};
}

Result<void> GpuEvaluator::evaluate(const registry::ParameterValues& values, const Request& request,
                                    std::span<glm::dvec3> out) {
  CUTICLE_TRY(check_request(*model_, request, out.size()));
  const std::vector<float> packed = model_->pack(values);
  CUTICLE_EXPECT(packed.size() == CUTICLE_PACKED_COUNT, "a model packs as many numbers as Packed holds");
  CUTICLE_ASSIGN(gpu::Buffer parameters, gpu::make_buffer_from(*device_, std::span<const float>(packed)));
  const std::uint64_t limit =
      std::min(device_->info().max_storage_buffer_bytes, most_groups * group_size * sizeof(DevicePoint));
  for (const gpu::Chunk& chunk : gpu::chunks(out.size(), sizeof(DevicePoint), limit)) {
    const std::size_t size = chunk.end - chunk.begin;
    const Request part{request.quantity, request.lobe, request.points.subspan(chunk.begin, size)};
    CUTICLE_TRY(evaluate_chunk(parameters, part, out.subspan(chunk.begin, size)));
  }
  return {};
}

Result<void> evaluate_gpu(gpu::Device& device, const Model& model, const registry::ParameterValues& values,
                          const Request& request, std::span<glm::dvec3> out) {
  CUTICLE_ASSIGN(GpuEvaluator evaluator, GpuEvaluator::make(device, model));
  return evaluator.evaluate(values, request, out);
}

}  // namespace cuticle::bsdf
