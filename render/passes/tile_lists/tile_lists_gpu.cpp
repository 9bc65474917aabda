#include "render/passes/tile_lists/tile_lists_gpu.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "gpu/groups.h"
#include "render/passes/lines/lines.h"
#include "render/passes/strands_in_sight/strands_in_sight_gpu.h"
#include "render/passes/tile_sort/tile_sort.h"
#include "render/passes/tiles/tiles.h"
#include "render/strand_shading/frame_gpu.h"
#include "render/visibility/drawn_part_gpu.h"
#include "strands/lod/strand_list_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <tile_count_comp.spv.h>
#include <tile_scan_comp.spv.h>
#include <tile_scatter_comp.spv.h>
#include <tile_scene_comp.spv.h>

namespace cuticle::render::tile_lists {

namespace {

constexpr std::size_t k_entry_bytes = 2 * sizeof(glm::uvec2);  // as scattered and as sorted
constexpr double k_least_share = 1e-6;
constexpr double k_filled = 0.95, k_steps_of_octave = 16;  ///< of the budget's entries; of the kept share

struct Kernels {
  gpu::Kernel scene, count, scan, scatter;
};

/// Words counted on the device, as tile_count.comp and tile_scan.comp have them.
enum Statistic : std::size_t { k_wanted, k_not_finite, k_statistics };

class TileListsPass : public GpuPass {
 public:
  TileListsPass(std::shared_ptr<gpu::Device> device, Kernels kernels, TileLists lists, gpu::Buffer all_strands,
                std::uint64_t most)
      : device_(std::move(device)),
        kernels_(std::move(kernels)),
        lists_(std::move(lists)),
        all_strands_(std::move(all_strands)),
        most_(most) {}

  void publish(Resources& resources) const override { resources.put_reference(lists_); }

  void change_view(FrameView& view, const PassParameters&) const override {
    view.strand_widening = 1 / lists_.kept_share;
  }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const TilePush push = push_of(resources, lists_);
    const auto bytes = gpu::bytes_of(push);
    const gpu::Groups tiles = gpu::groups_for(std::size_t(lists_.grid.x) * lists_.grid.y);
    const gpu::Buffer& listed = listed_of(resources);
    const gpu::Buffer *vertices = hair.strands.vertices, *indices = hair.strands.segments;
    for (const gpu::Buffer* cleared : {&lists_.counts, &lists_.visible, &lists_.statistics}) commands.fill(*cleared, 0);
    commands.dispatch(kernels_.scene, {&lists_.scene_depth, &lists_.tile_depth}, {resources.get<Targets>().depth},
                      bytes, tiles.x, tiles.y);
    over_segments(commands, resources, kernels_.count,
                  {vertices, hair.tangents, indices, &lists_.tile_depth, &lists_.counts, &lists_.visible,
                   &lists_.statistics, &listed},
                  push);
    commands.dispatch(kernels_.scan, {&lists_.counts, &lists_.offsets, &lists_.statistics}, {}, bytes, 1);
    over_segments(commands, resources, kernels_.scatter,
                  {vertices, hair.tangents, indices, &lists_.tile_depth, &lists_.counts, &lists_.entries, &listed},
                  push);
    return {};
  }

  const gpu::Buffer& listed_of(const Resources& resources) const {
    const auto* const seen = resources.find<strands_in_sight::StrandsInSight>();
    return seen ? seen->list : all_strands_;
  }

  /// Over the segments of the strands in sight, where they are known.
  static void over_segments(gpu::Commands& commands, const Resources& resources, const gpu::Kernel& kernel,
                            std::initializer_list<const gpu::Buffer*> buffers, const TilePush& push) {
    const std::span bound(buffers.begin(), buffers.size());
    if (const auto* const seen = resources.find<strands_in_sight::StrandsInSight>())
      return commands.dispatch_counted(kernel, bound, {}, gpu::bytes_of(push), seen->list,
                                       strands::k_listed_segment_groups);
    const gpu::Groups segments = gpu::groups_for(push.segment_count);
    commands.dispatch(kernel, bound, {}, gpu::bytes_of(push), segments.x, segments.y);
  }

  Result<Settled> settle() override {
    CUTICLE_ASSIGN(const auto words,
                   gpu::read_buffer<std::uint32_t>(*device_, lists_.statistics, std::size_t(k_statistics)));
    if (words[k_wanted] > lists_.capacity) {
      CUTICLE_TRY(make_room(words[k_wanted]));
      return Settled{.holds = false};
    }
    Settled settled;
    if (words[k_not_finite] > 0)
      settled.notes.push_back(fmt::format("tiles: {} segments left out: not finite", words[k_not_finite]));
    if (lists_.kept_share < 1)
      settled.notes.push_back(
          fmt::format("tiles: {:.3g} of the strands drawn, wider, to stay within budget_mib", lists_.kept_share));
    lists_.kept_share = share_for(words[k_wanted]);
    return settled;
  }

  /// The share of which the lists fill nearly the budget, if the kept one wants so many entries: no less than there is
  /// room for, as strands that stand for fewer others are narrower. In steps, so that pictures that follow each other
  /// have the same where they are alike; the next picture keeps what this one found out.
  double share_for(std::uint64_t wanted) const {
    const double share = lists_.kept_share * k_filled * double(most_) / double(std::max<std::uint64_t>(wanted, 1));
    return share >= 1 ? 1 : std::exp2(std::floor(std::log2(share) * k_steps_of_octave) / k_steps_of_octave);
  }

  /// Lists for so many entries, or for the budget's, with fewer segments.
  Result<void> make_room(std::uint64_t wanted) {
    const std::uint64_t grown = std::min(most_, wanted + wanted / 4);
    if (wanted > most_) lists_.kept_share = share_for(wanted);
    if (lists_.kept_share < k_least_share)
      return Error{ErrorKind::out_of_memory,
                   fmt::format("tile_lists.budget_mib: {} entries are far too few for the tiles' lists", most_),
                   "raise passes.tile_lists.budget_mib"};
    if (grown == lists_.capacity) return {};
    lists_.capacity = std::uint32_t(grown);
    for (gpu::Buffer* buffer : {&lists_.entries, &lists_.sorted}) {
      *buffer = gpu::Buffer();  // before the next is made, so that they do not add up
      CUTICLE_ASSIGN(*buffer, device_->make_buffer(std::size_t(grown) * sizeof(glm::uvec2)));
    }
    return {};
  }

 private:
  std::shared_ptr<gpu::Device> device_;
  Kernels kernels_;
  TileLists lists_;
  gpu::Buffer all_strands_;  ///< a list that is none
  std::uint64_t most_;       ///< entries that the budget has room for
};

/// Of the one workgroup that adds up the tiles' counts.
std::uint32_t scan_lanes(const gpu::DeviceInfo& device, const Resources& resources) {
  const bool is_wide = lanes_of(device, resources.parameters) > k_tile;
  return is_wide ? std::min(1024u, device.max_workgroup_invocations) : 256;
}

Result<Kernels> make_kernels(gpu::Device& device, const Resources& resources) {
  constexpr std::uint32_t bytes = sizeof(TilePush);
  const std::vector<gpu::TexelBinding> walked = {strands::drawn_texels(0),
                                                 strands::drawn_texels(1),
                                                 {2, gpu::TextureFormat::r32u},
                                                 {3, gpu::TextureFormat::r32f}};  // of tile_walk.glsl
  const std::uint32_t parts = listed_parts(resources);
  Kernels kernels;
  CUTICLE_ASSIGN(kernels.scene, device.make_kernel(tile_scene_comp, {2, 1, bytes}));
  CUTICLE_ASSIGN(kernels.count, device.make_kernel(tile_count_comp, {8, 0, bytes, {parts}, walked}));
  CUTICLE_ASSIGN(kernels.scan,
                 device.make_kernel(tile_scan_comp, {3, 0, bytes, {scan_lanes(device.info(), resources)}}));
  CUTICLE_ASSIGN(kernels.scatter, device.make_kernel(tile_scatter_comp, {7, 0, bytes, {parts}, walked}));
  return kernels;
}

Result<TileLists> make_lists(gpu::Device& device, const Resources& resources) {
  const glm::uvec2 resolution(drawn_size(resources));
  TileLists lists;
  lists.grid = (resolution + k_tile - 1u) / k_tile;
  const std::size_t tiles = std::size_t(lists.grid.x) * lists.grid.y, word = sizeof(std::uint32_t);
  CUTICLE_ASSIGN(lists.scene_depth, device.make_buffer(word * resolution.x * resolution.y));
  CUTICLE_ASSIGN(lists.tile_depth, device.make_buffer(word * tiles));
  CUTICLE_ASSIGN(lists.counts, device.make_buffer(word * tiles));
  CUTICLE_ASSIGN(lists.offsets, device.make_buffer(word * (tiles + 1)));
  CUTICLE_ASSIGN(lists.depth_ranges, device.make_buffer(sizeof(glm::vec2) * tiles));
  CUTICLE_ASSIGN(lists.visible,
                 device.make_buffer(word * ((resources.get<DrawnHair>().strands.vertex_count + 31) / 32)));
  CUTICLE_ASSIGN(lists.statistics, device.make_buffer(word * std::size_t(k_statistics)));
  return lists;
}

/// A first guess; the first frame's count corrects it.
std::uint64_t likely_entries(const Resources& resources) {
  return 2 * std::uint64_t(resources.get<DrawnHair>().strands.segment_count / listed_parts(resources));
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  CUTICLE_ASSIGN(Kernels kernels, make_kernels(*device, resources));
  CUTICLE_ASSIGN(TileLists lists, make_lists(*device, resources));
  CUTICLE_ASSIGN(gpu::Buffer all_strands, strands::make_no_strand_list(*device));
  const double budget = parameters_of<Parameters>(resources).budget_mib * 1024 * 1024;
  const std::uint64_t most = std::min(std::uint64_t(budget / double(k_entry_bytes)),
                                      device->info().max_storage_buffer_bytes / sizeof(glm::uvec2));
  auto pass = std::make_unique<TileListsPass>(std::move(device), std::move(kernels), std::move(lists),
                                              std::move(all_strands), most);
  CUTICLE_TRY(pass->make_room(std::min(most, likely_entries(resources))));
  return std::unique_ptr<GpuPass>(std::move(pass));
}

}  // namespace

std::uint32_t lanes_of(const gpu::DeviceInfo& device, const PassParameters& parameters) {
  const std::uint32_t asked = parameters_of<Parameters>(parameters).lanes;
  if (asked == 0) return !device.is_software && device.subgroup_size >= 32 ? 64 : 8;
  return asked < 32 ? 8 : asked < 64 ? 32 : 64;
}

std::uint32_t listed_parts(const Resources& resources) {
  return parameters_of<Parameters>(resources).whole_segments ? resources.get<DrawnHair>().segment_parts : 1;
}

TilePush push_of(const Resources& resources, const TileLists& lists) {
  const FrameView& view = resources.get<FrameView>();
  const DrawnHair& hair = resources.get<DrawnHair>();
  const Targets& targets = resources.get<Targets>();
  const Camera& camera = view.camera;
  TilePush push{};
  push.world_to_clip = glm::mat4(projection_matrix(camera) * view_matrix(camera));
  push.resolution = glm::uvec2(camera.resolution);
  push.part = glm::uvec2(drawn_size(resources));
  push.corner = std::uint32_t(view.part_corner.x) / k_tile | std::uint32_t(view.part_corner.y) / k_tile << 16;
  const visibility::DrawnPart part = visibility::drawn_part(resources, parameters_of<Parameters>(resources).full_px);
  const std::uint32_t parts = listed_parts(resources);
  push.segment_count = hair.strands.segment_count / parts;
  if (part.width > 1) push.segment_count = part.strands * ((hair.vertices_per_strand - 1) / parts);
  push.vertices_per_strand = hair.vertices_per_strand;
  push.capacity = lists.capacity;
  push.supersampling = targets.keep ? std::uint32_t(targets.supersampling) : 0;
  push.pixel_scale =
      float(part.width / part.opacity * camera.resolution.y / (2 * std::tan(camera.vertical_field_of_view / 2)));
  push.inverse_near = float(1 / camera.near_plane);
  push.inverse_far = float(1 / camera.far_plane);
  push.tip_variation = float(parameters_of<lines::Parameters>(resources).tip_variation);
  push.kept_share = float(lists.kept_share);
  push.opacity = float(parameters_of<tiles::Parameters>(resources).opacity * part.opacity);
  push.slices = parameters_of<tile_sort::Parameters>(resources).slices;
  return push;
}

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"tile_lists", create};
  return table;
}

}  // namespace cuticle::render::tile_lists
