#include "plan/picture_gpu.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/expect.h"
#include "plan/frame_cost_gpu.h"
#include "plan/picture_layers_gpu.h"
#include "render/hair_shadows_gpu.h"
#include "render/passes/bake_tables/bake_tables_gpu.h"
#include "render/passes/tile_lists/tile_lists_gpu.h"
#include "render/strand_shading/frame_gpu.h"
#include "render/visibility/drawn_part_gpu.h"
#include "strands/spline/place_gpu.h"
#include "strands/spline/smooth_gpu.h"

namespace cuticle::plan {

constexpr int k_max_at_once = 4096, k_usual_chunk = 1024;  ///< pixels each way

Result<std::unique_ptr<Picture>> Picture::create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                 const StrandSet& set, const Plan& plan, const Camera& first_camera,
                                                 Progress& progress) {
  std::unique_ptr<Picture> picture(new Picture(std::move(device), scene, set, plan));
  picture->resources_.edit<render::FrameView>().camera = first_camera;
  picture->resources_.parameters = scene.passes;
  picture->resources_.progress = &progress;
  for (const PlannedResource& resource : plan.resources) picture->resources_.want(resource.name);
  CUTICLE_TRY(picture->choose_chunks());
  if (scene.outputs.tells_strands() && picture->in_chunks())
    return bad_input("outputs: deep and cryptomatte: so large a picture is drawn in parts", "draw a smaller picture");
  CUTICLE_TRY(picture->memory_.count("drawn strands", [&] { return picture->make_strands(); }));
  CUTICLE_TRY(picture->make_material());
  CUTICLE_TRY(picture->make_rest());
  CUTICLE_TRY(picture->memory_.count("targets", [&] { return picture->make_targets(); }));
  CUTICLE_TRY(picture->make_passes());
  return picture;
}

/// The property that a planned pass of the render module has, of the one that has it; null: none has.
template <class Property>
Property Picture::planned(Property render::Pass::*property) const {
  for (const PlannedPass& planned : plan_.passes)
    if (const render::Pass* const pass = render::pass_of(*planned.entry); pass && pass->*property)
      return pass->*property;
  return {};
}

Result<void> Picture::choose_chunks() {
  const glm::ivec2 all = resources_.get<render::FrameView>().camera.resolution;
  const bool is_large = std::max(all.x, all.y) > k_max_at_once;
  const auto chunk_px = planned(&render::Pass::chunk_px);
  int chunk = chunk_px ? chunk_px(resources_.parameters) : 0;
  if (chunk == 0 && is_large) chunk = k_usual_chunk;
  if (chunk == 0) return {};
  for (const PlannedPass& planned : plan_.passes)
    if (const render::Pass* const pass = render::pass_of(*planned.entry); pass && pass->whole_pictures)
      return bad_input(
          fmt::format("camera.resolution_px: {} x {} in chunks of {}: '{}' draws whole pictures only, of at "
                      "most {} pixels each way",
                      all.x, all.y, chunk, pass->entry.name, k_max_at_once),
          "the method 'tiles' draws in chunks, without passes over the whole picture");
  constexpr int k_tile = int(render::tile_lists::k_tile);
  resources_.edit<render::FrameView>().part_size = glm::min(glm::ivec2((chunk + k_tile - 1) / k_tile * k_tile), all);
  return {};
}

Result<void> Picture::make_generator() {
  if (scene::draws_as_given(scene_)) {
    CUTICLE_ASSIGN(generator_,
                   strands::StrandPlacer::create(device_, set_.control, set_.placed,
                                                 resources_.wants<render::DrawnVelocities>(), set_.segment_parts));
    return {};
  }
  const strands::StrandGeneratorInput input{.control = &set_.control,
                                            .vertices_per_strand = scene_.strand_vertices,
                                            .hairs = set_.hairs,
                                            .weights = set_.weights,
                                            .radius = set_.radius,
                                            .taper = set_.taper,
                                            .moves = resources_.wants<render::DrawnVelocities>()};
  CUTICLE_ASSIGN(auto generator, strands::StrandGenerator::create(device_, input));
  resources_.edit<render::StrandMaker>().generator = generator.get();
  generator_ = std::move(generator);
  return {};
}

Result<void> Picture::make_strands() {
  CUTICLE_TRY(make_generator());
  resources_.edit<render::StrandMaker>().strands = generator_.get();
  resources_.put(render::DrawnHair{.strands = {&generator_->vertices(),
                                               &generator_->segments(),
                                               generator_->vertex_count(),
                                               generator_->segment_count(),
                                               {}},
                                   .tangents = &generator_->tangents(),
                                   .vertices_per_strand = generator_->vertices_per_strand(),
                                   .segment_parts = set_.segment_parts,
                                   .radius = double(set_.radius)});
  if (generator_->velocities()) resources_.put(render::DrawnVelocities{&generator_->velocities()});
  resources_.edit<render::FrameView>().frame_duration = 1 / scene_.frames_per_second;
  resources_.put(render::Surfaces{.head = set_.head.triangles.empty() ? nullptr : &set_.head,
                                  .scalp = set_.scalp.triangles.empty() ? nullptr : &set_.scalp,
                                  .floor = scene_.floor,
                                  .fins = set_.fins.triangles.empty() ? nullptr : &set_.fins});
  resources_.edit<render::Lights>().all = scene_.lights;
  if (const auto strand_draw = planned(&render::Pass::strand_draw)) resources_.put(strand_draw(resources_.parameters));
  return {};
}

Result<void> Picture::make_material() {
  CUTICLE_ASSIGN(const bsdf::Model* const model, bsdf::find_model(scene_.material.model.name));
  resources_.put(render::FibreMaterial{.model = model,
                                       .values = &scene_.material.model.values,
                                       .layout = scene_.material.layout,
                                       .lut_size = scene_.material.lut_size,
                                       .evaluates_directly = scene_.material.evaluate == "direct"});
  resources_.put(render::FibreOpacity{scene_.fibre_alpha.value_or(glm::dvec3(set_.opacity))});
  return {};
}

/// The strands that will be drawn, as the control hairs rest.
Result<void> Picture::make_rest() {
  if (!resources_.wants<render::RestStrands>()) return {};
  std::vector<glm::vec4> positions;
  for (const glm::vec3& position : set_.control.positions) positions.emplace_back(position, 1);
  CUTICLE_ASSIGN(const gpu::Buffer control, gpu::make_buffer_from<glm::vec4>(*device_, positions));
  gpu::Commands commands = device_->record();
  CUTICLE_TRY(generator_->record(commands, control, glm::mat3(1)));
  CUTICLE_TRY(device_->submit(std::move(commands)));
  CUTICLE_ASSIGN(rest_, read_strands());
  resources_.put(render::RestStrands{&rest_});
  return {};
}

Result<void> Picture::make_targets() {
  const glm::ivec2 resolution = drawn_size(resources_);
  using gpu::Filter, gpu::TextureFormat;
  const auto targets = planned(&render::Pass::targets);
  const render::TargetShape shape =
      targets ? targets(resources_.parameters, device_->info().sample_counts) : render::TargetShape{};
  const int samples = shape.samples;
  const glm::ivec2 size = resolution * shape.supersampling;
  CUTICLE_ASSIGN(color_, device_->make_texture({size, TextureFormat::rgba16f, Filter::nearest, samples, true}));
  const bool read = samples > 1 && resources_.wants<render::TargetDepth>();
  CUTICLE_ASSIGN(depth_, device_->make_texture({size, TextureFormat::depth32f, Filter::nearest, samples, true, read}));
  CUTICLE_ASSIGN(output_, device_->make_texture({resolution, TextureFormat::rgba32f, Filter::nearest, 1, true}));
  if (samples > 1) {
    CUTICLE_ASSIGN(resolved_, device_->make_texture({size, TextureFormat::rgba16f, Filter::nearest, 1, true}));
  }
  resources_.put(render::Targets{.color = &color_,
                                 .depth = &depth_,
                                 .resolved = samples > 1 ? &resolved_ : &color_,
                                 .supersampling = shape.supersampling});
  resources_.put(render::Output{&output_});
  return {};
}

/// Null: the entry has no work on the device.
Result<std::unique_ptr<render::GpuPass>> Picture::make_pass(const registry::Entry& entry) {
  const bool casts = entry.kind == registry::EntryKind::method && resources_.wants<render::HairTransmittance>();
  if (casts && !uses_of(entry).empty())
    return render::HairShadows::create(device_, entry.name, scene_.shadow->values, resources_);
  const auto found = std::ranges::find(render::gpu_passes(), entry.name, &render::GpuPassEntry::name);
  if (found == render::gpu_passes().end() || entry.kind != registry::EntryKind::pass)
    return std::unique_ptr<render::GpuPass>();
  return (*found)->create(device_, resources_);
}

Result<void> Picture::make_passes() {
  for (const PlannedPass& planned : plan_.passes) {
    resources_.begin_uses(planned.entry->name, uses_of(*planned.entry));
    CUTICLE_ASSIGN(auto pass, memory_.count(planned.entry->name, [&] { return make_pass(*planned.entry); }));
    if (!pass) continue;
    pass->publish(resources_);
    const bool draws = planned.entry->stage == registry::Stage::shade && planned.entry->draws > 0;
    passes_.push_back({planned.entry->name, planned.entry->stage, draws, uses_of(*planned.entry), std::move(pass)});
  }
  resources_.end_uses();
  return check_uses();
}

Result<bool> Picture::take_parameters(Progress& progress) {
  resources_.progress = &progress;
  for (DrawnPass& drawn : passes_) {
    const auto material = render::name_of<render::FibreMaterial>();
    if (std::ranges::find(drawn.uses, material, &render::Use::resource) == drawn.uses.end()) continue;
    resources_.begin_uses(drawn.name, drawn.uses);
    CUTICLE_ASSIGN(const bool taken,
                   memory_.count(drawn.name, [&] { return drawn.pass->take_parameters(resources_); }));
    if (!taken) return false;
    drawn.pass->publish(resources_);
  }
  resources_.end_uses();
  CUTICLE_TRY(check_uses());
  return true;
}

/// A pass that reads what it does not declare would run before it is there, or without it.
Result<void> Picture::check_uses() const {
  if (resources_.undeclared().empty()) return {};
  return internal_error(fmt::format("{}", fmt::join(resources_.undeclared(), "; ")));
}

/// How many strands the frame's level of detail draws.
std::uint32_t Picture::strands_of_level() const {
  return render::visibility::drawn_part(resources_, resources_.get<render::StrandDraw>().full_px).strands;
}

/// H11: shadows cast by a prefix of the strands drawn, which is spread over all, and received by all. A level of
/// detail that draws a share of them lets the root of that share cast: strands that stand for n leave out the shadow
/// that these would cast on each other, so that hair far away would be too bright.
shadows::GpuStrands Picture::casters() const {
  const render::DrawnHair& hair = resources_.get<render::DrawnHair>();
  shadows::GpuStrands strands = hair.strands;
  const std::uint32_t segments = hair.vertices_per_strand - 1, all = strands.segment_count / segments;
  const double of_level = std::sqrt(double(strands_of_level()) * all);
  const auto wanted = std::uint32_t(std::lround(scene_.caster_share * of_level));
  const std::uint32_t casting = std::clamp(wanted, std::min(1u, all), all);
  strands.segment_parts = hair.segment_parts;
  strands.segment_count = casting * (segments / hair.segment_parts);
  strands.caster_width = casting > 0 ? float(all) / float(casting) : 1;
  strands.fibre_width = set_.fibre_width;
  strands.seen_from = resources_.get<render::FrameView>().camera.position;
  return strands;
}

std::uint32_t Picture::casting_strands(const Camera& camera) {
  resources_.edit<render::FrameView>().camera = camera;
  return casters().segment_count;
}

/// Strands and shadows are those of the frame's first chunk; of a picture that is painted again, what comes before
/// `from` is there already.
Result<void> Picture::record_passes(gpu::Commands& commands, std::span<DrawnPass> passes, registry::Stage from) {
  auto left = std::ranges::count_if(passes, [&](const DrawnPass& drawn) { return drawn.draws && runs(drawn.name); });
  resources_.edit<render::Targets>().keep = false;
  const bool ends = passes.empty() || &passes.back() == &passes_.back();
  if (ends && left == 0 && frame_plan_ && frame_plan_->runs("resolve")) clear_targets(commands);
  for (DrawnPass& drawn : passes) {
    const bool is_there = drawn.stage < from || (drawn.stage <= registry::Stage::shadow && !begins_frame());
    if (is_there || !runs(drawn.name)) continue;
    if (drawn.draws) resources_.edit<render::Targets>().resolves = --left == 0;
    commands.begin_pass(drawn.name);
    resources_.begin_uses(drawn.name, drawn.uses);
    CUTICLE_TRY(memory_.count(drawn.name, [&] { return drawn.pass->record(commands, resources_); }));
    resources_.end_uses();
    commands.end_pass();
    resources_.edit<render::Targets>().keep = resources_.get<render::Targets>().keep || drawn.draws;
  }
  return check_uses();
}

/// Where nothing is drawn, the picture is empty.
void Picture::clear_targets(gpu::Commands& commands) {
  resources_.edit<render::Targets>().resolves = true;
  begin_target(commands, resources_);
  commands.end_rendering();
}

/// The passes up to the last that makes shadows, where others follow and none of them draws into the targets.
std::span<Picture::DrawnPass> Picture::passes_of_shadows() {
  const auto is_early = [](const DrawnPass& drawn) { return drawn.stage <= registry::Stage::shadow; };
  const auto last = std::find_if(passes_.rbegin(), passes_.rend(), is_early);
  const std::span passes = std::span(passes_).first(std::size_t(passes_.rend() - last));
  if (last == passes_.rbegin() || std::ranges::any_of(passes, &DrawnPass::draws)) return {};
  return passes;
}

/// The first picture's shadows settle before it is drawn with them: lists of fragments learn there what room they take.
Result<gpu::SubmitCost> Picture::paint_part(Trace* trace) {
  gpu::SubmitCost spent;
  const std::span first = shadows_settled_ ? std::span<DrawnPass>() : passes_of_shadows();
  if (!first.empty()) CUTICLE_TRY(paint_passes(trace, first, spent));
  CUTICLE_TRY(paint_passes(trace, std::span(passes_).subspan(first.size()), spent));
  shadows_settled_ = true;
  return spent;
}

Result<void> Picture::paint_passes(Trace* trace, std::span<DrawnPass> passes, gpu::SubmitCost& spent) {
  for (registry::Stage from = registry::Stage::prepare;; ++repeats_) {
    gpu::Commands commands = device_->record();
    CUTICLE_TRY(record_passes(commands, passes, from));
    CUTICLE_ASSIGN(const gpu::SubmitCost cost, device_->submit(std::move(commands), trace));
    add_cost(cost, spent);
    CUTICLE_ASSIGN(const std::optional<registry::Stage> again, settle(passes));
    if (!again) return {};
    from = *again;
  }
}

Result<gpu::SubmitCost> Picture::paint(const PictureInput& input, Trace* trace) {
  resources_.edit<render::FrameView>().frames_since_cut =
      input.follows ? resources_.get<render::FrameView>().frames_since_cut + 1 : 1;
  frame_plan_ = input.frame_plan;
  repeats_ = 0;
  use_frame(input);
  notes_.clear();
  if (!in_chunks()) return paint_part(trace);
  const glm::ivec2 all = input.camera.resolution, size = resources_.get<render::FrameView>().part_size;
  chunks_ = make_image(all.x, all.y, {"R", "G", "B", "A"});
  gpu::SubmitCost cost;
  for (int y = 0; y < all.y; y += size.y)
    for (int x = 0; x < all.x; x += size.x) {
      resources_.edit<render::FrameView>().part_corner = {x, y};
      CUTICLE_ASSIGN(const gpu::SubmitCost more, paint_part(trace));
      CUTICLE_TRY(keep_part());
      add_cost(more, cost);
    }
  return cost;
}

/// What lies in the picture of the chunk last drawn.
Result<void> Picture::keep_part() {
  CUTICLE_ASSIGN(const std::vector<float> pixels, device_->download(output_));
  const glm::ivec2 corner = resources_.get<render::FrameView>().part_corner,
                   size = resources_.get<render::FrameView>().part_size;
  const int rows = std::min(size.y, chunks_.height - corner.y), columns = std::min(size.x, chunks_.width - corner.x);
  for (int y = 0; y < rows; ++y)
    std::copy_n(pixels.begin() + std::ptrdiff_t(4) * y * size.x, std::ptrdiff_t(4) * columns,
                &chunks_.at(corner.x, corner.y + y, 0));
  return {};
}

/// The first stage that has to run again; none: all is there. Adds each note once: chunks may say the same.
Result<std::optional<registry::Stage>> Picture::settle(std::span<DrawnPass> passes) {
  std::optional<registry::Stage> again;
  for (DrawnPass& drawn : passes) {
    if (!runs(drawn.name)) continue;
    CUTICLE_ASSIGN(const render::Settled settled, memory_.count(drawn.name, [&] { return drawn.pass->settle(); }));
    if (!settled.holds) again = std::min(again.value_or(drawn.stage), drawn.stage);
    for (const std::string& note : settled.notes)
      if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
  }
  return again;
}

void Picture::use_frame(const PictureInput& input) {
  resources_.edit<render::DrawnHair>().strands.bounds = input.bounds;
  resources_.edit<render::Surfaces>().head_transform = input.head;
  render::FrameView& view = resources_.edit<render::FrameView>();
  view.camera = input.camera;
  view.camera_before = input.camera_before;
  view.strand_widening = 1;
  for (DrawnPass& drawn : passes_) drawn.pass->change_view(view, resources_.parameters);
  resources_.put(
      render::ControlHairs{input.control_positions, input.control_motion, std::uint32_t(set_.control.vertex_count())});
  if (input.character)
    resources_.put(render::HeadVertices{{&input.character->mesh_positions(), &input.character->mesh_normals()}});
  if (input.fins) resources_.put(render::FinVertices{{&input.fins->positions(), &input.fins->normals()}});
  resources_.take_out<render::PosedCharacter>();
  if (input.records_character) resources_.put(input.character->posed());
  resources_.edit<render::DrawnHair>().casters = casters();
}

const lut::TableSet* Picture::tables() const { return render::bake_tables::table_set_of(resources_); }

}  // namespace cuticle::plan
