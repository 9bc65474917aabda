#include "render/passes/strands_in_sight/strands_in_sight_gpu.h"

#include <algorithm>

#include <fmt/core.h>

#include "gpu/groups.h"
#include "render/visibility/drawn_part_gpu.h"
#include "strands/lod/strand_list_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <in_sight_list_comp.spv.h>
#include <in_sight_see_comp.spv.h>

namespace cuticle::render::strands_in_sight {

namespace {

constexpr double k_margin = 0.1;     ///< of the picture, on each side: filters, and pictures moved by parts of a pixel
constexpr double k_margin_px = 2.0;  ///< beside it, for small pictures and lines of a width in pixels

/// As in_sight_push.glsl has it.
struct Push {
  glm::mat4 world_to_clip;
  glm::vec2 side, per_radius;
  std::uint32_t strand_count, vertices_per_strand;
};

Push push_of(const Resources& resources) {
  const FrameView& view = resources.get<FrameView>();
  const DrawnHair& hair = resources.get<DrawnHair>();
  const StrandDraw& draw = resources.get<StrandDraw>();
  const glm::dmat4 to_clip = projection_matrix(view.camera);
  const visibility::DrawnPart part = visibility::drawn_part(resources, draw.full_px);
  const double wider = std::max(1.0, draw.width_factor) * part.width / part.opacity * view.strand_widening;
  Push push{};
  push.world_to_clip = glm::mat4(to_clip * view_matrix(view.camera));
  push.side = glm::vec2(1 + 2 * k_margin + 2 * k_margin_px / glm::dvec2(view.camera.resolution));
  push.per_radius = glm::vec2(wider * glm::abs(glm::dvec2(to_clip[0][0], to_clip[1][1])));
  push.vertices_per_strand = hair.vertices_per_strand;
  push.strand_count = part.strands;
  return push;
}

class InSight : public GpuPass {
 public:
  InSight(std::shared_ptr<gpu::Device> device, gpu::Kernel see, gpu::Kernel list, gpu::Buffer seen,
          StrandsInSight strands)
      : device_(std::move(device)),
        see_(std::move(see)),
        list_(std::move(list)),
        seen_(std::move(seen)),
        strands_(std::move(strands)) {}

  void publish(Resources& resources) const override { resources.put_reference(strands_); }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const Push push = push_of(resources);
    const gpu::Groups groups = gpu::groups_for(push.strand_count);
    commands.fill(seen_, 0);
    commands.dispatch(see_, {resources.get<DrawnHair>().strands.vertices, &seen_}, {}, gpu::bytes_of(push), groups.x,
                      groups.y);
    commands.dispatch(list_, {&seen_, &strands_.list}, {}, gpu::bytes_of(push), 1);
    all_ = push.strand_count;
    return {};
  }

  Result<Settled> settle() override {
    CUTICLE_ASSIGN(const auto count, gpu::read_buffer<std::uint32_t>(*device_, strands_.list, 1));
    if (count[0] == all_) return Settled{};
    return Settled{.notes = {fmt::format("strands_in_sight: {} of {} strands shaded, the others are out of view",
                                         count[0], all_)}};
  }

 private:
  std::shared_ptr<gpu::Device> device_;
  gpu::Kernel see_, list_;
  gpu::Buffer seen_;
  StrandsInSight strands_;
  std::uint32_t all_ = 0;  ///< strands, of the frame recorded last
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const DrawnHair& hair = resources.get<DrawnHair>();
  const std::size_t strands = hair.strands.vertex_count / std::max(1u, hair.vertices_per_strand), word = 4;
  CUTICLE_ASSIGN(gpu::Kernel see,
                 device->make_kernel(in_sight_see_comp, {2, 0, sizeof(Push), {}, {strands::drawn_texels(0)}}));
  CUTICLE_ASSIGN(gpu::Kernel list, device->make_kernel(in_sight_list_comp, {2, 0, sizeof(Push)}));
  CUTICLE_ASSIGN(gpu::Buffer seen, device->make_buffer(word * std::max<std::size_t>(1, (strands + 31) / 32)));
  StrandsInSight made;
  CUTICLE_ASSIGN(made.list, device->make_buffer(word * (strands::k_list_head + std::max<std::size_t>(1, strands))));
  return std::unique_ptr<GpuPass>(
      std::make_unique<InSight>(std::move(device), std::move(see), std::move(list), std::move(seen), std::move(made)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"strands_in_sight", create};
  return table;
}

}  // namespace cuticle::render::strands_in_sight
