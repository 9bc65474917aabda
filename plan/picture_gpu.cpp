#include "plan/picture_gpu.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include <fmt/core.h>
#include <glm/gtc/packing.hpp>

#include "lut/bake_gpu.h"
#include "render/passes/aovs/aovs.h"
#include "render/passes/bake_tables/bake_tables.h"
#include "render/passes/lines/frame_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/passes/lines/tables_gpu.h"
#include "render/passes/quads/quads.h"
#include "render/passes/resolve/resolve.h"
#include "render/passes/temporal_antialiasing/pixel_shift_gpu.h"
#include "render/passes/tile_lists/tile_lists.h"
#include "render/passes/tile_lists/tile_lists_gpu.h"
#include "render/passes/tiles/tiles.h"
#include "render/passes/truth/rasterise.h"
#include "render/passes/truth/truth.h"
#include "render/passes/velocity/velocity.h"
#include "strands/spline/place_gpu.h"
#include "strands/spline/smooth_gpu.h"

namespace cuticle::plan {

namespace {

/// Texels across a pixel. Quads have multisampling alone; the truth's own scene has none, and is not the place to save.
int supersampling(const Plan& plan) {
  if (find_pass(plan, "quads")) return 1;
  return find_pass(plan, "truth") ? 4 : 2;
}

/// The multisampling to draw with: what quads ask for; else 4 where the device offers it and only the strands' own
/// draws read the depth.
int sample_count(const gpu::DeviceInfo& info, const Plan& plan, const render::FrameResources& resources) {
  if (find_pass(plan, "quads")) return render::parameters_of<render::quads::Parameters>(resources).samples;
  if (!find_pass(plan, "lines")) return 1;
  return std::ranges::find(info.sample_counts, 4) != info.sample_counts.end() ? 4 : 1;
}

constexpr int k_most_at_once = 4096, k_usual_chunk = 1024;  ///< pixels each way

}  // namespace

Result<std::unique_ptr<Picture>> Picture::create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                 const StrandSet& set, const Plan& plan, const Camera& first_camera,
                                                 Progress& progress) {
  std::unique_ptr<Picture> picture(new Picture(std::move(device), scene, set, plan));
  picture->resources_.camera = first_camera;
  picture->resources_.parameters = scene.passes;
  picture->resources_.says_seen = find_pass(plan, "aovs") != nullptr;
  CUTICLE_TRY(picture->choose_chunks());
  CUTICLE_TRY(picture->make_strands());
  CUTICLE_TRY(picture->make_rest());
  CUTICLE_ASSIGN(picture->shadows_, StrandShadows::make(picture->device_, scene, plan, picture->resources_));
  CUTICLE_TRY(picture->make_tables(progress));
  CUTICLE_TRY(picture->make_targets());
  CUTICLE_TRY(picture->make_passes());
  return picture;
}

Result<void> Picture::choose_chunks() {
  const glm::ivec2 all = resources_.camera.resolution;
  const bool is_large = std::max(all.x, all.y) > k_most_at_once;
  int chunk = parameters_of<render::tiles::Parameters>(resources_).chunk_px;
  if (chunk == 0 && is_large) chunk = k_usual_chunk;
  if (chunk == 0 || !(is_large || find_pass(plan_, "tiles"))) return {};
  for (const render::Pass* pass : render::passes())
    if (pass->whole_pictures && find_pass(plan_, pass->entry.name))
      return bad_input(
          fmt::format("camera.resolution_px: {} x {} in chunks of {}: '{}' draws whole pictures only, of at "
                      "most {} pixels each way",
                      all.x, all.y, chunk, pass->entry.name, k_most_at_once),
          "the method 'tiles' draws in chunks, without passes over the whole picture");
  constexpr int k_tile = int(render::tile_lists::k_tile);
  resources_.part_size = glm::min(glm::ivec2((chunk + k_tile - 1) / k_tile * k_tile), all);
  return {};
}

Result<void> Picture::make_generator() {
  if (scene::draws_as_given(scene_)) {
    CUTICLE_ASSIGN(generator_, strands::StrandPlacer::create(device_, set_.control, set_.placed,
                                                             find_pass(plan_, "place_velocities") != nullptr));
    return {};
  }
  const strands::StrandGeneratorInput input{.control = &set_.control,
                                            .vertices_per_strand = scene_.strand_vertices,
                                            .hairs = set_.hairs,
                                            .weights = set_.weights,
                                            .radius = set_.radius,
                                            .taper = set_.taper,
                                            .moves = find_pass(plan_, "interpolate_velocities") != nullptr};
  CUTICLE_ASSIGN(auto generator, strands::StrandGenerator::create(device_, input));
  resources_.generator = generator.get();
  generator_ = std::move(generator);
  return {};
}

Result<void> Picture::make_strands() {
  CUTICLE_TRY(make_generator());
  resources_.drawn_strands = generator_.get();
  resources_.strands = {
      &generator_->vertices(), &generator_->segments(), generator_->vertex_count(), generator_->segment_count(), {}};
  resources_.tangents = &generator_->tangents();
  if (generator_->velocities()) resources_.velocities = &generator_->velocities();
  resources_.frame_duration = 1 / scene_.frames_per_second;
  resources_.vertices_per_strand = generator_->vertices_per_strand();
  resources_.strand_radius = double(set_.radius);
  resources_.head = set_.head.triangles.empty() ? nullptr : &set_.head;
  resources_.scalp = set_.scalp.triangles.empty() ? nullptr : &set_.scalp;
  resources_.floor = scene_.floor;
  resources_.fins = set_.fins.triangles.empty() ? nullptr : &set_.fins;
  resources_.lights = scene_.lights;
  resources_.fibre_alpha = scene_.fibre_alpha.value_or(glm::dvec3(set_.opacity));
  return {};
}

/// The strands that will be drawn, as the control hairs rest.
Result<void> Picture::make_rest() {
  CUTICLE_ASSIGN(resources_.model, bsdf::find_model(scene_.material.model.name));
  resources_.model_values = &scene_.material.model.values;
  resources_.evaluates_directly = scene_.material.evaluate == "direct";
  if (!find_pass(plan_, "cards")) return {};
  std::vector<glm::vec4> positions;
  for (const glm::vec3& position : set_.control.positions) positions.emplace_back(position, 1);
  CUTICLE_ASSIGN(const gpu::Buffer control, gpu::make_buffer_from<glm::vec4>(*device_, positions));
  gpu::Commands commands = device_->record();
  CUTICLE_TRY(generator_->record(commands, control, glm::mat3(1)));
  CUTICLE_TRY(device_->submit(std::move(commands)));
  CUTICLE_ASSIGN(rest_, read_strands());
  resources_.rest = &rest_;
  return {};
}

Result<void> Picture::make_tables(Progress& progress) {
  if (!find_pass(plan_, "bake_tables")) return {};
  progress.message("baking lookup tables");
  const registry::ParameterValues& values = scene_.material.model.values;
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout(scene_.material.layout, *resources_.model, values));
  // A software device runs on the same cores and has a kernel to compile first.
  CUTICLE_ASSIGN(table_set_,
                 device_->info().is_software
                     ? lut::bake(*resources_.model, values, *layout, scene_.material.lut_size, progress)
                     : lut::bake_gpu(*device_, *resources_.model, values, *layout, scene_.material.lut_size));
  const bool mip_levels = parameters_of<render::bake_tables::Parameters>(resources_).mip_levels;
  CUTICLE_ASSIGN(tables_, render::lines::upload_drawn(*device_, table_set_, mip_levels));
  for (const gpu::Texture& table : tables_) resources_.tables.push_back(&table);
  resources_.table_set = &table_set_;
  return {};
}

Result<void> Picture::make_targets() {
  const glm::ivec2 resolution = drawn_size(resources_);
  using gpu::Filter, gpu::TextureFormat;
  const int samples = sample_count(device_->info(), plan_, resources_);
  resources_.supersampling = supersampling(plan_);
  const glm::ivec2 size = resolution * resources_.supersampling;
  CUTICLE_ASSIGN(color_, device_->make_texture({size, TextureFormat::rgba16f, Filter::nearest, samples, true}));
  const bool read = samples > 1 && (find_pass(plan_, "pixel_depth") || find_pass(plan_, "cull_strands"));
  CUTICLE_ASSIGN(depth_, device_->make_texture({size, TextureFormat::depth32f, Filter::nearest, samples, true, read}));
  CUTICLE_ASSIGN(output_, device_->make_texture({resolution, TextureFormat::rgba32f, Filter::nearest, 1, true}));
  if (samples > 1) {
    CUTICLE_ASSIGN(resolved_, device_->make_texture({size, TextureFormat::rgba16f, Filter::nearest, 1, true}));
  }
  resources_.color = &color_;
  resources_.depth = &depth_;
  resources_.resolved = samples > 1 ? &resolved_ : &color_;
  resources_.output = &output_;
  return {};
}

Result<void> Picture::make_passes() {
  for (const PlannedPass& planned : plan_.passes) {
    if (shadows_ && planned.entry->stage >= registry::Stage::shadow) {
      const std::string_view method =
          resources_.of_surfaces_alone ? "surface_shadow" : std::string_view(scene_.shadow->name);
      passes_.push_back({find_pass(plan_, method)->entry->name, registry::Stage::shadow, false, std::move(shadows_)});
    }
    const auto entry = std::ranges::find(render::gpu_passes(), planned.entry->name, &render::GpuPassEntry::name);
    if (entry == render::gpu_passes().end()) continue;
    CUTICLE_ASSIGN(auto pass, (*entry)->create(device_, resources_));
    pass->publish(resources_);
    const bool draws = planned.entry->stage == registry::Stage::shade && planned.entry->draws > 0;
    passes_.push_back({planned.entry->name, planned.entry->stage, draws, std::move(pass)});
  }
  return {};
}

/// How many strands the frame's level of detail draws, by whichever pass does.
std::uint32_t Picture::strands_of_level() const {
  const auto drawn = [&]<class Parameters>(std::type_identity<Parameters>) -> std::optional<std::uint32_t> {
    if (!find_pass(plan_, Parameters::name)) return std::nullopt;
    return render::lines::drawn_part(resources_, parameters_of<Parameters>(resources_).full_px).strands;
  };
  if (const auto strands = drawn(std::type_identity<render::lines::Parameters>())) return *strands;
  if (const auto strands = drawn(std::type_identity<render::quads::Parameters>())) return *strands;
  if (const auto strands = drawn(std::type_identity<render::tile_lists::Parameters>())) return *strands;
  return resources_.strands.segment_count / (resources_.vertices_per_strand - 1);
}

/// H11: shadows cast by a prefix of the strands drawn, which are in random order, and received by all.
shadows::GpuStrands Picture::casters() const {
  shadows::GpuStrands strands = resources_.strands;
  const std::uint32_t segments = resources_.vertices_per_strand - 1, all = strands.segment_count / segments;
  const auto wanted = std::uint32_t(std::lround(scene_.caster_share * strands_of_level()));
  const std::uint32_t casting = std::clamp(wanted, std::min(1u, all), all);
  strands.segment_count = casting * segments;
  strands.caster_width = casting > 0 ? float(all) / float(casting) : 1;
  strands.seen_from = resources_.camera.position;
  return strands;
}

/// Strands and shadows are those of the frame's first chunk.
Result<void> Picture::record_passes(gpu::Commands& commands) {
  auto left = std::ranges::count_if(passes_, &DrawnPass::draws);
  resources_.keep_target = false;
  for (DrawnPass& drawn : passes_) {
    if (drawn.stage <= registry::Stage::shadow && !begins_frame()) continue;
    if (drawn.draws) resources_.resolve_target = --left == 0;
    commands.begin_pass(drawn.name);
    CUTICLE_TRY(drawn.pass->record(commands, resources_));
    commands.end_pass();
    resources_.keep_target = resources_.keep_target || drawn.draws;
  }
  return {};
}

Result<gpu::SubmitCost> Picture::paint_part(Trace* trace) {
  for (;;) {
    CUTICLE_ASSIGN(gpu::SubmitCost cost, paint_once(trace));
    CUTICLE_ASSIGN(const bool holds, settle());
    if (holds) return cost;
  }
}

Result<gpu::SubmitCost> Picture::paint(const PictureInput& input, Trace* trace) {
  resources_.frames_since_cut = input.follows ? resources_.frames_since_cut + 1 : 1;
  use_frame(input);
  notes_.clear();
  if (!in_chunks()) return paint_part(trace);
  const glm::ivec2 all = input.camera.resolution, size = resources_.part_size;
  chunks_ = make_image(all.x, all.y, {"R", "G", "B", "A"});
  gpu::SubmitCost cost;
  for (int y = 0; y < all.y; y += size.y)
    for (int x = 0; x < all.x; x += size.x) {
      resources_.part_corner = {x, y};
      CUTICLE_ASSIGN(const gpu::SubmitCost more, paint_part(trace));
      CUTICLE_TRY(keep_part());
      cost.wall_ms += more.wall_ms;
      cost.passes.insert(cost.passes.end(), more.passes.begin(), more.passes.end());
    }
  return cost;
}

/// What lies in the picture of the chunk last drawn.
Result<void> Picture::keep_part() {
  CUTICLE_ASSIGN(const std::vector<float> pixels, device_->download(output_));
  const glm::ivec2 corner = resources_.part_corner, size = resources_.part_size;
  const int rows = std::min(size.y, chunks_.height - corner.y), columns = std::min(size.x, chunks_.width - corner.x);
  for (int y = 0; y < rows; ++y)
    std::copy_n(pixels.begin() + std::ptrdiff_t(4) * y * size.x, std::ptrdiff_t(4) * columns,
                &chunks_.at(corner.x, corner.y + y, 0));
  return {};
}

/// Adds each note once: chunks may say the same.
Result<bool> Picture::settle() {
  bool holds = true;
  for (DrawnPass& drawn : passes_) {
    CUTICLE_ASSIGN(const render::Settled settled, drawn.pass->settle());
    holds = holds && settled.holds;
    for (const std::string& note : settled.notes)
      if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
  }
  return holds;
}

void Picture::use_frame(const PictureInput& input) {
  resources_.strands.bounds = input.bounds;
  resources_.head_transform = input.head;
  resources_.camera = input.camera;
  if (find_pass(plan_, "temporal_antialiasing"))
    resources_.camera.pixel_shift = render::temporal_antialiasing::pixel_shift(resources_);
  resources_.camera_before = input.camera_before;
  resources_.control_positions = input.control_positions;
  resources_.control_motion = input.control_motion;
  resources_.control_vertices = std::uint32_t(set_.control.vertex_count());
  resources_.head_positions = input.character ? &input.character->mesh_positions() : nullptr;
  resources_.head_normals = input.character ? &input.character->mesh_normals() : nullptr;
  resources_.fin_positions = input.fins ? &input.fins->positions() : nullptr;
  resources_.fin_normals = input.fins ? &input.fins->normals() : nullptr;
  resources_.character.reset();
  if (input.records_character) resources_.character = input.character->posed();
  resources_.casters = casters();
}

Result<gpu::SubmitCost> Picture::paint_once(Trace* trace) {
  gpu::Commands commands = device_->record();
  CUTICLE_TRY(record_passes(commands));
  return device_->submit(std::move(commands), trace);
}

/// The strands as the device generated and shaded them, and the scene as it drew it, composited on the CPU.
Result<Image> Picture::read_truth() const {
  const std::size_t count = generator_->vertex_count();
  CUTICLE_ASSIGN(const auto vertices, gpu::read_buffer<glm::vec4>(*device_, generator_->vertices(), count));
  CUTICLE_ASSIGN(const auto halves, gpu::read_buffer<std::uint64_t>(*device_, *resources_.strand_colors, count));
  CUTICLE_ASSIGN(const auto segments,
                 gpu::read_buffer<std::uint32_t>(*device_, generator_->segments(), generator_->segment_count()));
  std::vector<glm::vec4> colors(count);
  std::ranges::transform(halves, colors.begin(), [](std::uint64_t packed) { return glm::unpackHalf4x16(packed); });
  std::vector<float> scene_color, scene_depth;
  if (resources_.keep_target) {
    CUTICLE_ASSIGN(scene_color, device_->download(color_));
    CUTICLE_ASSIGN(scene_depth, device_->download(depth_));
  }
  const render::truth::Sampling sampling{int(parameters_of<render::truth::Parameters>(resources_).samples),
                                         parameters_of<render::tiles::Parameters>(resources_).opacity};
  return rasterise(resources_.camera, {vertices, colors, segments},
                   {scene_color, scene_depth, resources_.supersampling}, sampling);
}

Result<Image> Picture::read_color() const {
  if (find_pass(plan_, "truth")) {
    CUTICLE_ASSIGN(Image image, read_truth());
    render::resolve::add_background(image, parameters_of<render::resolve::Parameters>(resources_).background);
    return image;
  }
  if (in_chunks()) return chunks_;
  Image image = make_image(output_.size().x, output_.size().y, {"R", "G", "B", "A"});
  CUTICLE_ASSIGN(image.pixels, device_->download(output_));
  return image;
}

Result<Image> Picture::read_aovs(const Image& color) const {
  const bool moves = scene_.passes.contains("velocity");
  if (!resources_.aovs || !(scene_.outputs.aovs || moves)) return Image{};
  CUTICLE_ASSIGN(Image image, with_channels(color, *resources_.aovs, render::aovs::k_channels));
  if (!resources_.motion_vectors || !moves) return image;
  CUTICLE_ASSIGN(image, with_channels(image, *resources_.motion_vectors, render::velocity::k_channels));
  return with_channels(image, *resources_.seen_velocities, render::aovs::k_velocity_channels);
}

/// A picture's channels, then floats of a buffer, as many a pixel as there are names.
Result<Image> Picture::with_channels(const Image& image, const gpu::Buffer& buffer,
                                     std::span<const std::string_view> more_names) const {
  std::vector<std::string> names = image.channel_names;
  const std::size_t own = names.size(), more = more_names.size();
  names.insert(names.end(), more_names.begin(), more_names.end());
  Image wider = make_image(image.width, image.height, std::move(names));
  const std::size_t pixels = image.pixels.size() / own;
  CUTICLE_ASSIGN(const auto values, gpu::read_buffer<float>(*device_, buffer, pixels * more));
  for (std::size_t p = 0; p < pixels; ++p) {
    float* const out = wider.pixels.data() + p * (own + more);
    std::copy_n(image.pixels.data() + p * own, own, out);
    std::copy_n(values.data() + p * more, more, out + own);
  }
  return wider;
}

Result<strands::Groom> Picture::read_strands() const {
  const std::size_t count = generator_->vertex_count();
  CUTICLE_ASSIGN(const auto vertices, gpu::read_buffer<glm::vec4>(*device_, generator_->vertices(), count));
  const bool as_given = scene::draws_as_given(scene_);
  const std::size_t row = generator_->vertices_per_strand();
  strands::Groom groom;
  for (std::size_t s = 0; s < generator_->strand_count(); ++s) {
    const std::size_t size = as_given ? set_.control.strand_size(set_.placed[s].guide) : row;
    for (std::size_t v = s * row; v < s * row + size; ++v) {
      groom.positions.emplace_back(vertices[v]);
      groom.radii.push_back(vertices[v].w);
    }
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  return groom;
}

}  // namespace cuticle::plan
