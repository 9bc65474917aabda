#include <algorithm>

#include <glm/gtc/packing.hpp>

#include "render/pass_gpu.h"
#include "render/passes/resolve/resolve.h"
#include "render/passes/shade_strands/shade_strands_gpu.h"
#include "render/passes/tiles/tiles.h"
#include "render/passes/truth/rasterise.h"
#include "render/passes/truth/truth.h"

namespace cuticle::render::truth {

namespace {

/// The strands as the device generated and shaded them, and the scene as it drew it, composited on the CPU.
class Truth : public GpuPass {
 public:
  explicit Truth(std::shared_ptr<gpu::Device> device) : device_(std::move(device)) {}
  Result<void> record(gpu::Commands&, const Resources& resources) override {
    has_scene_ = resources.get<Targets>().keep;
    return {};
  }
  Result<std::optional<Image>> finish(const Resources& resources) override {
    const shadows::GpuStrands& strands = resources.get<DrawnHair>().strands;
    CUTICLE_ASSIGN(const auto vertices, gpu::read_buffer<glm::vec4>(*device_, *strands.vertices, strands.vertex_count));
    CUTICLE_ASSIGN(const auto halves,
                   gpu::read_buffer<std::uint64_t>(*device_, *resources.get<shade_strands::StrandColors>().values,
                                                   strands.vertex_count));
    CUTICLE_ASSIGN(const auto segments,
                   gpu::read_buffer<std::uint32_t>(*device_, *strands.segments, strands.segment_count));
    std::vector<glm::vec4> colors(halves.size());
    std::ranges::transform(halves, colors.begin(), [](std::uint64_t packed) { return glm::unpackHalf4x16(packed); });
    const Sampling sampling{int(parameters_of<Parameters>(resources).samples),
                            parameters_of<tiles::Parameters>(resources).opacity};
    return composite(resources, {vertices, colors, segments}, sampling);
  }

 private:
  Result<std::optional<Image>> composite(const Resources& resources, const ColoredStrands& strands,
                                         const Sampling& sampling) const {
    const Targets& targets = resources.get<Targets>();
    std::vector<float> color, depth;
    if (has_scene_) {
      CUTICLE_ASSIGN(color, device_->download(*targets.color));
      CUTICLE_ASSIGN(depth, device_->download(*targets.depth));
    }
    Image image =
        rasterise(resources.get<FrameView>().camera, strands, {color, depth, targets.supersampling}, sampling);
    resolve::add_background(image, parameters_of<resolve::Parameters>(resources).background);
    return std::optional(std::move(image));
  }

  std::shared_ptr<gpu::Device> device_;
  bool has_scene_ = false;  ///< a pass before this drew into the targets
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources&) {
  return std::unique_ptr<GpuPass>(std::make_unique<Truth>(std::move(device)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"truth", create};
  return table;
}

}  // namespace cuticle::render::truth
