#include "render/passes/bake_tables/bake_tables_gpu.h"

#include <fmt/format.h>

#include "lut/bake_gpu.h"
#include "lut/evaluate.h"
#include "render/strand_shading/tables_gpu.h"

namespace cuticle::render::bake_tables {

namespace {

/// Works once, when it is made.
class BakeTables : public GpuPass {
 public:
  explicit BakeTables(lut::TableSet set) : set_(std::move(set)) {}
  Result<void> upload(gpu::Device& device, bool mip_levels) {
    CUTICLE_ASSIGN(textures_, strand_shading::upload_drawn(device, set_, mip_levels));
    return {};
  }
  void publish(Resources& resources) const override {
    Tables tables{.set = &set_};
    for (const gpu::Texture& texture : textures_) tables.textures.push_back(&texture);
    resources.put(std::move(tables));
  }
  Result<void> record(gpu::Commands&, const Resources&) override { return {}; }

 private:
  lut::TableSet set_;
  std::vector<gpu::Texture> textures_;
};

/// Says what the tables take, and what to do where that is long.
Result<void> announce(const lut::Layout& layout, const FibreMaterial& material, Progress& progress) {
  constexpr double k_long_s = 20;
  const lut::Source source = lut::cpu_source(*material.model, *material.values);
  CUTICLE_ASSIGN(const double seconds, lut::seconds_to_bake(source, layout, material.lut_size));
  progress.message(
      seconds < k_long_s
          ? "baking lookup tables"
          : fmt::format("baking lookup tables of {} takes about {}: \"material\": {{\"evaluate\": \"direct\"}} needs "
                        "none, a smaller \"lut_size\" takes less",
                        material.model->entry.name,
                        seconds < 120 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60)));
  return {};
}

/// A software device runs on the same cores and has a kernel to compile first.
Result<lut::TableSet> bake(gpu::Device& device, const FibreMaterial& material, Progress& progress) {
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout(material.layout, *material.model, *material.values));
  const bool is_baked_here = device.info().is_software;
  if (is_baked_here || layout->solve) CUTICLE_TRY(announce(*layout, material, progress));
  if (is_baked_here)
    return lut::bake(*material.model, *material.values, *layout, material.lut_size, progress);
  return lut::bake_gpu(device, *material.model, *material.values, *layout, material.lut_size);
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  Progress& progress = resources.progress ? *resources.progress : silent_progress();
  CUTICLE_ASSIGN(lut::TableSet set, bake(*device, resources.get<FibreMaterial>(), progress));
  auto pass = std::make_unique<BakeTables>(std::move(set));
  CUTICLE_TRY(pass->upload(*device, parameters_of<Parameters>(resources).mip_levels));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"bake_tables", create};
  return table;
}

}  // namespace cuticle::render::bake_tables
