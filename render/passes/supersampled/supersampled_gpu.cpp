#include <algorithm>

#include <glm/gtc/packing.hpp>

#include "render/pass_gpu.h"
#include "render/passes/resolve/resolve.h"
#include "render/passes/shade_strands/shade_strands_gpu.h"
#include "render/passes/supersampled/rasterise.h"
#include "render/passes/supersampled/supersampled.h"
#include "render/passes/tiles/tiles.h"

namespace cuticle::render::supersampled {

namespace {

/// The strands as the device generated and shaded them, and the scene as it drew it, composited on the CPU.
class Supersampled : public GpuPass {
 public:
  explicit Supersampled(std::shared_ptr<gpu::Device> device) : device_(std::move(device)) {}
  Result<void> record(gpu::Commands&, const Resources& resources) override {
    has_scene_ = resources.get<Targets>().keep;
    drawn_.reset();
    return {};
  }
  Result<std::optional<Image>> finish(const Resources& resources) override {
    if (!drawn_) {
      CUTICLE_ASSIGN(const Read read, read_back(resources));
      drawn_ = rasterise(resources.get<FrameView>().camera, read.strands(), read.scene(), read.sampling);
    }
    Image image = std::move(*drawn_);
    drawn_.reset();
    resolve::add_background(image, parameters_of<resolve::Parameters>(resources).background);
    return std::optional(std::move(image));
  }
  Result<std::optional<SeenStrands>> seen_strands(const Resources& resources) override {
    CUTICLE_ASSIGN(const Read read, read_back(resources));
    const Camera& camera = resources.get<FrameView>().camera;
    ToldImage told = rasterise_told(camera, read.strands(), read.scene(), read.sampling,
                                    resources.get<DrawnHair>().vertices_per_strand);
    drawn_ = std::move(told.image);
    return std::optional(SeenStrands{std::move(told.shares), behind(camera, read.scene())});
  }

 private:
  struct Read {
    std::vector<glm::vec4> vertices, colors;
    std::vector<std::uint32_t> segments;
    std::vector<float> scene_color, scene_depth;
    int supersampling = 1;
    Sampling sampling;
    ColoredStrands strands() const { return {vertices, colors, segments}; }
    OpaqueScene scene() const { return {scene_color, scene_depth, supersampling}; }
  };

  Result<Read> read_back(const Resources& resources) const {
    const shadows::GpuStrands& strands = resources.get<DrawnHair>().strands;
    Read read;
    CUTICLE_ASSIGN(read.vertices, gpu::read_buffer<glm::vec4>(*device_, *strands.vertices, strands.vertex_count));
    CUTICLE_ASSIGN(const auto halves,
                   gpu::read_buffer<std::uint64_t>(*device_, *resources.get<shade_strands::StrandColors>().values,
                                                   strands.vertex_count));
    CUTICLE_ASSIGN(read.segments, gpu::read_buffer<std::uint32_t>(*device_, *strands.segments, strands.segment_count));
    read.colors.resize(halves.size());
    std::ranges::transform(halves, read.colors.begin(),
                           [](std::uint64_t packed) { return glm::unpackHalf4x16(packed); });
    read.sampling = {int(parameters_of<Parameters>(resources).samples),
                     parameters_of<tiles::Parameters>(resources).opacity};
    const Targets& targets = resources.get<Targets>();
    read.supersampling = targets.supersampling;
    if (has_scene_) {
      CUTICLE_ASSIGN(read.scene_color, device_->download(*targets.color));
      CUTICLE_ASSIGN(read.scene_depth, device_->download(*targets.depth));
    }
    return read;
  }

  std::shared_ptr<gpu::Device> device_;
  bool has_scene_ = false;      ///< a pass before this drew into the targets
  std::optional<Image> drawn_;  ///< the frame's picture, where its strands were told apart
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources&) {
  return std::unique_ptr<GpuPass>(std::make_unique<Supersampled>(std::move(device)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"supersampled", create};
  return table;
}

}  // namespace cuticle::render::supersampled
