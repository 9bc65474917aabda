#include "render/passes/seen_vertices/seen_vertices_gpu.h"

#include <algorithm>

#include <fmt/core.h>

#include "gpu/groups.h"

#include <mark_areas_comp.spv.h>
#include <mark_areas_records_comp.spv.h>
#include <mark_spans_comp.spv.h>
#include <mark_spans_records_comp.spv.h>
#include <seen_bits_comp.spv.h>
#include <seen_list_comp.spv.h>

namespace cuticle::render::seen_vertices {

namespace {

struct Kernels {
  gpu::Kernel mark, bits, list;
};

class FindSeen : public GpuPass {
 public:
  FindSeen(std::shared_ptr<gpu::Device> device, Kernels kernels, gpu::Buffer marks, tiles::FineForm form,
           SeenVertices seen)
      : device_(std::move(device)),
        kernels_(std::move(kernels)),
        marks_(std::move(marks)),
        form_(form),
        seen_(std::move(seen)) {}

  void publish(Resources& resources) const override { resources.put_reference(seen_); }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const DrawnHair& hair = resources.get<DrawnHair>();
    const tile_lists::TileLists& lists = resources.get<tile_lists::TileLists>();
    const tile_lists::TilePush push = push_of(resources, lists);
    if (form_.reads_records) seen_.records.record(commands, resources, push, nullptr);
    commands.fill(marks_, 0);
    const gpu::Buffer* const segments = form_.reads_records ? &seen_.records.all() : hair.strands.vertices;
    const gpu::Buffer* const unused = &lists.counts;  // what the picture would be written to
    commands.dispatch(kernels_.mark,
                      {segments, hair.strands.vertices, &lists.offsets, &lists.sorted, &lists.scene_depth, unused,
                       unused, unused, &marks_},
                      {}, gpu::bytes_of(push), lists.grid.x, lists.grid.y);
    all_ = hair.strands.vertex_count;
    const gpu::Groups words = gpu::groups_for((all_ + 31) / 32);
    commands.dispatch(kernels_.bits, {&marks_, &seen_.bits}, {}, gpu::bytes_of(all_), words.x, words.y);
    commands.dispatch(kernels_.list, {&seen_.bits, &seen_.list}, {}, gpu::bytes_of(all_), 1);
    return {};
  }

  Result<Settled> settle() override {
    CUTICLE_ASSIGN(const auto count, gpu::read_buffer<std::uint32_t>(*device_, seen_.list, 1));
    return Settled{
        .notes = {fmt::format("seen_vertices: {} of {} vertices shaded, the others do not show", count[0], all_)}};
  }

 private:
  std::shared_ptr<gpu::Device> device_;
  Kernels kernels_;
  gpu::Buffer marks_;  ///< a word per vertex: the part of a segment that begins there is seen
  tiles::FineForm form_;
  SeenVertices seen_;
  std::uint32_t all_ = 0;  ///< vertices of the frame recorded last
};

std::span<const std::uint32_t> mark_code(const tiles::FineForm& form) {
  using Code = std::span<const std::uint32_t>;
  if (form.spans) return form.reads_records ? Code(mark_spans_records_comp) : Code(mark_spans_comp);
  return form.reads_records ? Code(mark_areas_records_comp) : Code(mark_areas_comp);
}

Result<Kernels> make_kernels(gpu::Device& device, const tiles::FineForm& form) {
  Kernels kernels;
  CUTICLE_ASSIGN(kernels.mark, device.make_kernel(mark_code(form), tiles::fine_interface(form, 9, false)));
  CUTICLE_ASSIGN(kernels.bits, device.make_kernel(seen_bits_comp, {2, 0, sizeof(std::uint32_t)}));
  CUTICLE_ASSIGN(kernels.list, device.make_kernel(seen_list_comp, {2, 0, sizeof(std::uint32_t)}));
  return kernels;
}

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  const tiles::FineForm form = tiles::fine_form(device->info(), resources);
  const std::size_t vertices = std::max<std::size_t>(1, resources.get<DrawnHair>().strands.vertex_count), word = 4;
  CUTICLE_ASSIGN(Kernels kernels, make_kernels(*device, form));
  CUTICLE_ASSIGN(gpu::Buffer marks, device->make_buffer(word * vertices));
  SeenVertices seen;
  CUTICLE_ASSIGN(seen.bits, device->make_buffer(word * ((vertices + 31) / 32)));
  CUTICLE_ASSIGN(seen.list, device->make_buffer(word * (k_list_head + vertices)));
  if (form.reads_records) {
    CUTICLE_ASSIGN(seen.records, tiles::Records::make(*device, resources));
  }
  return std::unique_ptr<GpuPass>(
      std::make_unique<FindSeen>(std::move(device), std::move(kernels), std::move(marks), form, std::move(seen)));
}

std::uint32_t dispatches(const gpu::DeviceInfo& device, const PassParameters& parameters,
                         const registry::FrameShape& shape) {
  return 3 + tiles::prepare_dispatches(device, parameters, shape);
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"seen_vertices", create, dispatches};
  return table;
}

}  // namespace cuticle::render::seen_vertices
