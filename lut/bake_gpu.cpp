#include <cuticle/lut/bake_gpu.h>

#include <chrono>

#include <cuticle/bsdf/model_gpu.h>
#include <cuticle/lut/evaluate.h>

namespace cuticle::lut {
namespace {

Result<Source> device_source(gpu::Device& device, const bsdf::Model& model, const registry::ParameterValues& values) {
  CUTICLE_ASSIGN(bsdf::GpuEvaluator made, bsdf::GpuEvaluator::make(device, model));
  const auto evaluator = std::make_shared<bsdf::GpuEvaluator>(std::move(made));
  return Source{&model,
                [evaluator, values](const bsdf::Request& request, std::span<glm::dvec3> out) {
                  return evaluator->evaluate(values, request, out);
                },
                cpu_source(model, values).evaluate, average_fibre(model, values)};
}

/// Four floats a texel, values with their scale applied, missing channels 0.
std::vector<float> texels_of(const Table& table) {
  const int channels = table.image.channels();
  std::vector<float> texels(std::size_t(table.image.width) * table.image.height * 4, 0.0F);
  for (std::size_t i = 0; i < texels.size() / 4; ++i)
    for (int c = 0; c < channels; ++c)
      texels[i * 4 + c] = float(double(table.image.pixels[i * channels + c]) * table.scale[c]);
  return texels;
}

}  // namespace

Result<TableSet> bake_gpu(gpu::Device& device, const bsdf::Model& model, const registry::ParameterValues& values,
                          const Layout& layout, int size) {
  CUTICLE_TRY(check_size(size));
  const auto start = std::chrono::steady_clock::now();
  CUTICLE_ASSIGN(const Source source, device_source(device, model, values));
  CUTICLE_ASSIGN(TableSet set, bake_from(source, values, layout, size, silent_progress()));
  set.bake_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  set.baked_on = device.info().name;
  return set;
}

Result<std::vector<gpu::Texture>> upload(gpu::Device& device, const TableSet& set) {
  std::vector<gpu::Texture> textures;
  for (const Table& table : set.tables) {
    CUTICLE_ASSIGN(textures.emplace_back(), device.make_texture({.size = {table.image.width, table.image.height}}));
    CUTICLE_TRY(device.upload(textures.back(), texels_of(table)));
  }
  return textures;
}

}  // namespace cuticle::lut
