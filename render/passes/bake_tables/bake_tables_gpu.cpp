#include "render/passes/bake_tables/bake_tables_gpu.h"

#include <fmt/format.h>

#include "lut/bake_gpu.h"
#include "lut/evaluate.h"
#include "render/strand_shading/tables_gpu.h"

namespace cuticle::render::bake_tables {

namespace {

Result<const lut::Layout*> layout_of(const FibreMaterial& material) {
  return lut::find_layout(material.layout, *material.model, *material.values);
}

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

/// Works when it is made, and when the model has other parameters.
class BakeTables : public GpuPass {
 public:
  BakeTables(std::shared_ptr<gpu::Device> device, const FibreMaterial& material, const lut::Layout& layout)
      : device_(std::move(device)), baker_(*device_, *material.model, layout, material.lut_size), layout_(layout) {}

  Result<bool> take_parameters(const Resources& resources) override {
    CUTICLE_ASSIGN(const lut::Layout* layout, layout_of(resources.get<FibreMaterial>()));
    if (layout != &layout_) return false;
    CUTICLE_ASSIGN(set_, bake(resources));
    CUTICLE_ASSIGN(textures_,
                   strand_shading::upload_drawn(*device_, set_, parameters_of<Parameters>(resources).mip_levels));
    return true;
  }
  void publish(Resources& resources) const override {
    Tables tables{.set = &set_};
    for (const gpu::Texture& texture : textures_) tables.textures.push_back(&texture);
    resources.put(std::move(tables));
  }
  Result<void> record(gpu::Commands&, const Resources&) override { return {}; }

 private:
  /// A software device runs on the same cores and has a kernel to compile first.
  Result<lut::TableSet> bake(const Resources& resources) {
    const FibreMaterial& material = resources.get<FibreMaterial>();
    Progress& progress = resources.progress ? *resources.progress : silent_progress();
    const bool is_baked_here = device_->info().is_software;
    if (is_baked_here || layout_.solve) CUTICLE_TRY(announce(layout_, material, progress));
    if (is_baked_here) return lut::bake(*material.model, *material.values, layout_, material.lut_size, progress);
    return baker_.bake(*material.values);
  }

  std::shared_ptr<gpu::Device> device_;
  lut::DeviceBaker baker_;
  const lut::Layout& layout_;
  lut::TableSet set_;
  std::vector<gpu::Texture> textures_;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const FibreMaterial& material = resources.get<FibreMaterial>();
  CUTICLE_ASSIGN(const lut::Layout* layout, layout_of(material));
  auto pass = std::make_unique<BakeTables>(std::move(device), material, *layout);
  CUTICLE_TRY(pass->take_parameters(resources));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"bake_tables", create};
  return table;
}

}  // namespace cuticle::render::bake_tables
