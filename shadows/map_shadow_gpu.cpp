#include "shadows/map_shadow_gpu.h"

#include <algorithm>
#include <bit>

#include <fmt/core.h>

#include "gpu/groups.h"
#include "shadows/map_strips_gpu.h"
#include "strands/lod/strand_list_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <map_fit_comp.spv.h>

namespace cuticle::shadows {
namespace {

const MapPass k_fit{"shadow.fit", {}, {k_vertices, k_box}, MapRun::per_vertices};
const gpu::TexelBinding k_vertex_texels = strands::drawn_texels(0), k_segment_texels{1};

/// Vertices and segments stand at the front.
gpu::ShaderInterface interface_of(const MapPass& pass, std::uint32_t textures) {
  gpu::ShaderInterface interface { std::uint32_t(pass.buffers.size()), textures, sizeof(MapPush) };
  for (std::uint32_t i = 0; i < pass.buffers.size(); ++i) {
    if (pass.buffers[i] == k_vertices) interface.texels.push_back(k_vertex_texels);
    if (pass.buffers[i] == k_segments) interface.texels.push_back(k_segment_texels);
  }
  for (const std::uint32_t binding : pass.texels) interface.texels.push_back({binding});
  interface.specialization = pass.constants;
  return interface;
}

class MapShadowGpu : public GpuShadow {
 public:
  MapShadowGpu(std::shared_ptr<gpu::Device> device, MapDescription description)
      : device_(std::move(device)), description_(std::move(description)) {}
  Result<void> make();
  Result<void> record(gpu::Commands& commands, const GpuStrands& strands, double alpha, const LightSource& light,
                      const gpu::Buffer& transmittance) override;
  Result<bool> record_counts(gpu::Commands& commands, const GpuStrands& strands, double alpha,
                             const LightSource& light) override;
  Result<MapRoom> settle() override;
  std::uint32_t dispatches_per_frame(const GpuStrands& strands) const override;
  std::size_t bytes() const override;
  std::vector<const gpu::Buffer*> map_buffers() const override;
  std::vector<const gpu::Texture*> map_targets() const override;

 private:
  Result<void> make_drawing();
  Result<void> make_kernels();
  Result<void> record_passes(std::size_t passes, gpu::Commands& commands, const GpuStrands& strands, double alpha,
                             const LightSource& light, const gpu::Buffer& transmittance);
  bool make_room(std::uint64_t needed);
  bool grow(std::uint64_t room);
  void draw(gpu::Commands& commands, const GpuStrands& strands, MapPush push) const;
  std::uint32_t flags_of(const MapSettings& settings, const GpuStrands& strands) const;
  MapPush push_for(const LightAxes& axes, const GpuStrands& strands) const;
  void clear(gpu::Commands& commands) const;
  std::uint32_t invocations(const GpuStrands& strands, const MapPass& pass) const;
  void clear_strip(gpu::Commands& commands) const;
  std::size_t end_of_strip_passes(std::size_t first) const;
  void run(gpu::Commands& commands, const MapPass& pass, const gpu::Kernel& kernel, const GpuStrands& strands,
           MapPush push, const gpu::Buffer& transmittance) const;

  std::shared_ptr<gpu::Device> device_;
  MapDescription description_;
  DepositBuffer deposits_;
  gpu::Buffer box_, all_receive_;
  Strips strips_;
  bool has_run_ = false;  // the passes, by the last record
  std::vector<gpu::Buffer> own_;
  std::vector<gpu::Texture> targets_;
  gpu::GraphicsPipeline drawing_;
  gpu::Kernel fit_;
  std::vector<gpu::Kernel> kernels_;  // one per pass
};

Result<void> MapShadowGpu::make() {
  CUTICLE_EXPECT(description_.own.size() <= 3, "three numbers fit into the push constants");
  const std::uint64_t layers = description_.need.grown.empty() ? description_.layers : 1;
  strips_ = strips_of(description_.settings, layers, device_->info());
  for (MapBuffer& buffer : description_.buffers) {
    if (buffer.per_strip) buffer.words = strips_.texels * description_.layers;
    CUTICLE_ASSIGN(gpu::Buffer made, device_->make_buffer(4 * buffer.words));
    own_.push_back(std::move(made));
  }
  CUTICLE_ASSIGN(box_, device_->make_buffer(4 * 6));
  CUTICLE_ASSIGN(all_receive_, strands::make_no_strand_list(*device_));
  CUTICLE_TRY(deposits_.make(*device_, description_.settings.accumulation, description_.after_deposits));
  if (description_.drawing.targets > 0) CUTICLE_TRY(make_drawing());
  return make_kernels();
}

Result<void> MapShadowGpu::make_drawing() {
  const MapDrawing& drawing = description_.drawing;
  gpu::GraphicsDescription pipeline;
  pipeline.vertex_spirv = drawing.vertex_code;
  pipeline.fragment_spirv = drawing.fragment_code;
  pipeline.interface = {4, 0, sizeof(MapPush), {}, {k_vertex_texels, k_segment_texels}};
  pipeline.color_formats.assign(drawing.targets, drawing.format);
  pipeline.blend = gpu::BlendMode::additive;
  CUTICLE_ASSIGN(drawing_, device_->make_graphics(pipeline));
  for (std::uint32_t i = 0; i < drawing.targets; ++i) {
    const glm::ivec2 size(int(description_.settings.resolution));
    CUTICLE_ASSIGN(gpu::Texture target,
                   device_->make_texture({size, drawing.format, gpu::Filter::nearest, 1, /*render_target=*/true}));
    targets_.push_back(std::move(target));
  }
  return {};
}

Result<void> MapShadowGpu::make_kernels() {
  CUTICLE_ASSIGN(fit_, device_->make_kernel(map_fit_comp, interface_of(k_fit, 0)));
  for (const MapPass& pass : description_.passes) {
    const std::uint32_t textures = pass.reads_targets ? description_.drawing.targets : 0;
    CUTICLE_ASSIGN(gpu::Kernel kernel, device_->make_kernel(pass.code, interface_of(pass, textures)));
    kernels_.push_back(std::move(kernel));
  }
  return {};
}

std::uint32_t MapShadowGpu::flags_of(const MapSettings& settings, const GpuStrands& strands) const {
  return (settings.accumulation.poisson ? k_poisson_flag : 0) | (targets_.empty() ? 0 : k_square_flag) |
         (description_.drawing.format == gpu::TextureFormat::rgba8 ? k_byte_target_flag : 0) |
         (settings.knows_depths ? 0 : k_intervals_flag) | (strands.seen_from ? k_seen_flag : 0) |
         (strands.segment_parts - 1) << k_parts_shift;
}

MapPush MapShadowGpu::push_for(const LightAxes& axes, const GpuStrands& strands) const {
  const MapSettings& settings = description_.settings;
  MapPush push{{axes.right, axes.origin.x},
               {axes.up, axes.origin.y},
               {axes.forward, axes.origin.z},
               description_.intervals,
               float(settings.filter_texels),
               float(settings.filter_radius),
               float(-settings.accumulation.k / deposits_.scale()),
               settings.resolution,
               description_.layers,
               0,
               description_.flags | flags_of(settings, strands),
               description_.pieces_per_step,
               {},
               strands.fibre_width,
               float(settings.depth_offset),
               strands.caster_width,
               axes.reach,
               strands.segment_count};
  std::copy(description_.own.begin(), description_.own.end(), push.own);
  for (int axis = 0; strands.seen_from && axis < 3; ++axis) push.eye[axis] = (*strands.seen_from)[axis];
  return push;
}

void MapShadowGpu::clear(gpu::Commands& commands) const {
  commands.begin_pass("shadow.clear");
  for (std::size_t i = 0; i < own_.size(); ++i)
    if (description_.buffers[i].cleared) commands.fill(own_[i], description_.buffers[i].clear);
  commands.fill(box_, ~0u);
  commands.end_pass();
}

void MapShadowGpu::clear_strip(gpu::Commands& commands) const {
  commands.begin_pass("shadow.clear");
  for (std::size_t i = 0; i < own_.size(); ++i)
    if (description_.buffers[i].per_strip || description_.buffers[i].cleared_per_strip)
      commands.fill(own_[i], description_.buffers[i].clear);
  commands.end_pass();
}

/// One past the last of the passes from `first` on that run for each strip.
std::size_t MapShadowGpu::end_of_strip_passes(std::size_t first) const {
  std::size_t end = first;
  while (end < kernels_.size() && description_.passes[end].per_strip) ++end;
  return end;
}

std::uint32_t MapShadowGpu::invocations(const GpuStrands& strands, const MapPass& pass) const {
  const std::uint32_t side = description_.settings.resolution;
  switch (pass.run) {
    case MapRun::per_segment:
      return strands.segment_count;
    case MapRun::per_counted_segment:
      return pass.counted(strands.segment_count);
    case MapRun::per_texel:
      return pass.per_strip ? std::uint32_t(strips_.texels) : side * side;
    case MapRun::per_row:
      return side;
    case MapRun::per_vertex:
      return strands.vertex_count;
    case MapRun::per_vertices:
      return (strands.vertex_count + k_vertices_each - 1) / k_vertices_each;
    case MapRun::one_group:
      return gpu::k_threads;
    case MapRun::given:
      return pass.invocations;
  }
  return 0;
}

void MapShadowGpu::run(gpu::Commands& commands, const MapPass& pass, const gpu::Kernel& kernel,
                       const GpuStrands& strands, MapPush push, const gpu::Buffer& transmittance) const {
  const gpu::Buffer* const receivers = strands.receivers ? strands.receivers : &all_receive_;
  const gpu::Buffer* common[] = {receivers, strands.vertices,    strands.segments,
                                 &box_,     &deposits_.buffer(), &transmittance};
  std::vector<const gpu::Buffer*> bound;
  for (const int buffer : pass.buffers) bound.push_back(buffer < 0 ? common[buffer + 6] : &own_[std::size_t(buffer)]);
  const std::uint32_t count = invocations(strands, pass);
  push.count = pass.run == MapRun::per_counted_segment ? strands.segment_count
               : pass.run == MapRun::per_vertices      ? strands.vertex_count
                                                       : count;
  const gpu::Groups groups = gpu::groups_for(count);
  const auto textures = pass.reads_targets ? map_targets() : std::vector<const gpu::Texture*>{};
  commands.begin_pass(pass.name);
  if (pass.run == MapRun::per_vertex && strands.receivers)
    commands.dispatch_counted(kernel, bound, textures, gpu::bytes_of(push), *strands.receivers,
                              strands::k_listed_vertex_groups);
  else
    commands.dispatch(kernel, bound, textures, gpu::bytes_of(push), groups.x, groups.y);
  commands.end_pass();
}

void MapShadowGpu::draw(gpu::Commands& commands, const GpuStrands& strands, MapPush push) const {
  std::vector<gpu::Commands::Target> targets;
  for (const gpu::Texture& target : targets_) targets.push_back({.color = &target});
  push.count = strands.segment_count;
  commands.begin_pass("shadow.draw");
  commands.begin_rendering(targets, nullptr);
  commands.draw(drawing_, {strands.vertices, strands.segments, &box_, &deposits_.buffer()}, {}, gpu::bytes_of(push),
                6 * strands.segment_count);
  commands.end_rendering();
  commands.end_pass();
}

Result<void> MapShadowGpu::record(gpu::Commands& commands, const GpuStrands& strands, double alpha,
                                  const LightSource& light, const gpu::Buffer& transmittance) {
  has_run_ = dispatches_per_frame(strands) > 0;
  if (!has_run_) {  // nothing casts a shadow
    if (strands.vertex_count > 0) commands.fill(transmittance, std::bit_cast<std::uint32_t>(1.0f));
    return {};
  }
  return record_passes(kernels_.size(), commands, strands, alpha, light, transmittance);
}

Result<bool> MapShadowGpu::record_counts(gpu::Commands& commands, const GpuStrands& strands, double alpha,
                                         const LightSource& light) {
  const MapNeed& need = description_.need;
  has_run_ = need.counting > 0 && dispatches_per_frame(strands) > 0;
  const gpu::Buffer& none = box_;  // these passes look nothing up
  if (has_run_) CUTICLE_TRY(record_passes(need.counting, commands, strands, alpha, light, none));
  return has_run_;
}

Result<void> MapShadowGpu::record_passes(std::size_t passes, gpu::Commands& commands, const GpuStrands& strands,
                                         double alpha, const LightSource& light, const gpu::Buffer& transmittance) {
  if (description_.in_world && light.position) return point_light_refused(description_.settings.method);
  CUTICLE_ASSIGN(const LightAxes axes, light_axes(light, strands.bounds));
  CUTICLE_TRY(deposits_.update(*device_, alpha, (description_.signed_sums ? 2ull : 1ull) * strands.segment_count));
  MapPush push = push_for(axes, strands);
  clear(commands);
  run(commands, k_fit, fit_, strands, description_.in_world ? push_for({}, strands) : push, transmittance);
  if (!targets_.empty()) draw(commands, strands, push);
  const auto run_passes = [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
      run(commands, description_.passes[i], kernels_[i], strands, push, transmittance);
  };
  for (std::size_t first = 0, end = 0; first < passes; first = end) {
    end = std::min(passes, end_of_strip_passes(first));
    const std::uint32_t strips = end > first ? strips_.count : 1, margin = end > first ? strips_.margin : 0;
    end = std::max(end, first + 1);
    for (std::uint32_t strip = 0; strip < strips; ++strip) {
      push.strip_word = MapPush::strip_word_of(strip, strips, margin);
      if (strip > 0) clear_strip(commands);
      run_passes(first, end);
    }
  }
  return {};
}

Result<MapRoom> MapShadowGpu::settle() {
  const MapNeed& need = description_.need;
  if (need.counter < 0 || !has_run_) return MapRoom{};
  const gpu::Buffer& counter = own_[std::size_t(need.counter)];
  std::uint32_t needed = 0;
  CUTICLE_TRY(device_->download(counter, std::as_writable_bytes(std::span(&needed, 1)), counter.size() - 4));
  if (needed <= need.room) return MapRoom{};
  if (make_room(needed)) return MapRoom{.holds = false};
  return MapRoom{.note =
                     fmt::format("{}: of {} {} {} found no room, so the shadow is too weak: {}",
                                 description_.settings.method, needed, need.items, needed - need.room, need.advice)};
}

/// Larger buffers, as far as they may grow, and beyond that more strips. False: neither.
bool MapShadowGpu::make_room(std::uint64_t needed) {
  const MapNeed& need = description_.need;
  if (need.grown.empty()) return false;
  const std::uint64_t wanted = needed + needed / 8,
                      largest = device_->info().max_storage_buffer_bytes / need.item_bytes;
  const std::uint64_t room = std::min({wanted, need.most_room, largest});
  const bool has_grown = room > need.room && grow(room);
  if (needed <= need.room || strips_.count == k_max_strips) return has_grown;
  strips_.count = std::uint32_t(std::min<std::uint64_t>(k_max_strips, strips_.count * (wanted / need.room + 1)));
  strips_.margin = margin_of(description_.settings);
  return true;
}

/// False, and nothing changed, where the device has no memory for it.
bool MapShadowGpu::grow(std::uint64_t room) {
  MapNeed& need = description_.need;
  std::vector<gpu::Buffer> larger;
  for ([[maybe_unused]] const int buffer : need.grown) {
    auto made = device_->make_buffer(room * need.item_bytes);
    if (!made) return false;
    larger.push_back(std::move(*made));
  }
  for (std::size_t i = 0; i < larger.size(); ++i) {
    const auto buffer = std::size_t(need.grown[i]);
    own_[buffer] = std::move(larger[i]);
    description_.buffers[buffer].words = room * need.item_bytes / 4;
  }
  need.room = room;
  description_.layers = std::uint32_t(room);
  return true;
}

std::uint32_t MapShadowGpu::dispatches_per_frame(const GpuStrands& strands) const {
  if (strands.segment_count == 0 || strands.vertex_count == 0) return 0;
  std::uint32_t dispatches = 1;
  for (const MapPass& pass : description_.passes) dispatches += pass.per_strip ? strips_.count : 1;
  return dispatches;
}

std::size_t MapShadowGpu::bytes() const {
  const std::size_t side = description_.settings.resolution;
  const std::size_t texel = description_.drawing.format == gpu::TextureFormat::rgba8 ? 4 : 8;
  std::size_t bytes = targets_.size() * texel * side * side;
  for (const MapBuffer& buffer : description_.buffers) bytes += buffer.kept ? 4 * buffer.words : 0;
  return bytes;
}

std::vector<const gpu::Buffer*> MapShadowGpu::map_buffers() const {
  std::vector<const gpu::Buffer*> buffers;
  for (const gpu::Buffer& buffer : own_) buffers.push_back(&buffer);
  return buffers;
}

std::vector<const gpu::Texture*> MapShadowGpu::map_targets() const {
  std::vector<const gpu::Texture*> targets;
  for (const gpu::Texture& target : targets_) targets.push_back(&target);
  return targets;
}

}  // namespace

Result<std::unique_ptr<GpuShadow>> make_map_shadow(std::shared_ptr<gpu::Device> device, MapDescription description) {
  auto shadow = std::make_unique<MapShadowGpu>(std::move(device), std::move(description));
  CUTICLE_TRY(shadow->make());
  return std::unique_ptr<GpuShadow>(std::move(shadow));
}

}  // namespace cuticle::shadows
