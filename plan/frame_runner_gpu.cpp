#include "plan/frame_runner_gpu.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "core/content_key.h"
#include "core/wall_clock.h"
#include "plan/camera_path.h"
#include "plan/frame_cost_gpu.h"
#include "plan/hair_in_view.h"
#include "plan/picture_gpu.h"
#include "plan/strand_motion_gpu.h"
#include "plan/strand_order.h"
#include "plan/told_strands.h"
#include "plan/traced_frame.h"
#include "render/pass_gpu.h"

namespace cuticle::plan {

namespace {

constexpr int k_none = -2;

bool same_but_for_parameters(scene::MaterialSource a, const scene::MaterialSource& b) {
  a.model.values = b.model.values;
  return a == b;
}

bool has_same_passes(const Plan& a, const Plan& b) {
  return std::ranges::equal(a.passes, b.passes, {}, &PlannedPass::entry, &PlannedPass::entry) &&
         std::ranges::equal(a.resources, b.resources, {}, &PlannedResource::name, &PlannedResource::name);
}

}  // namespace

struct FrameRunner::Impl {
  std::shared_ptr<gpu::Device> device;
  scene::Scene scene;
  Trace* trace = nullptr;
  StrandSet set;
  strands::Bounds rest_bounds;
  Plan plan;
  std::unique_ptr<StrandMotion> motion;
  std::unique_ptr<Picture> picture;
  std::unique_ptr<MemoryMeter> motion_memory;
  int painted = k_none;  ///< the frame last painted
  FramePlan frame_plan;
  /// What the results on the device were made of.
  struct Keys {
    std::uint64_t hair = 0, surfaces = 0, view = 0;
  } made_of;
  int passed = k_none;  ///< the frame of passed_places
  PlacesBefore passed_places;

  Result<void> build(Progress& progress) {
    CUTICLE_TRY(check_told_strands(scene));
    CUTICLE_ASSIGN(set, build_strand_set(scene));
    for (const std::string& note : set.notes) progress.message(note);
    leave_out_missing_head();
    rest_bounds = strands::bounds(set.control);
    CUTICLE_TRY(check_size(shape()));
    plan = planned();
    return make(true, scene.outputs.color, progress);
  }

  /// A head that could not be fitted to the hair: the set's notes say why.
  void leave_out_missing_head() {
    if (set.head.triangles.empty()) scene.head.present = false;
  }

  std::string_view solver_name() const {
    return scene.simulation.solver ? std::string_view(scene.simulation.solver->name) : "control hairs";
  }

  DeviceTraits traits() const { return {device->info().name, device->info().is_software}; }

  registry::FrameShape shape() const {
    registry::FrameShape shape = shape_of(scene, set);
    shape.max_storage_buffer_bytes = device->info().max_storage_buffer_bytes;
    return shape;
  }

  /// With the dispatches that this device needs.
  Plan planned() const {
    Plan made = make_plan(scene, shape(), traits());
    for (const render::GpuPassEntry* entry : render::gpu_passes()) {
      const auto found =
          std::ranges::find_if(made.passes, [&](const auto& pass) { return pass.entry->name == entry->name; });
      if (found != made.passes.end() && entry->dispatches)
        found->dispatches = entry->dispatches(device->info(), scene.passes, made.shape);
    }
    return made;
  }

  Result<void> make(bool with_motion, bool with_picture, Progress& progress) {
    std::unique_ptr<StrandMotion> new_motion;
    auto new_memory = std::make_unique<MemoryMeter>(*device);
    if (with_motion) {
      CUTICLE_ASSIGN(new_motion,
                     new_memory->count(solver_name(), [&] { return StrandMotion::create(device, scene, set, plan); }));
    }
    if (with_picture) {
      CUTICLE_ASSIGN(picture, Picture::create(device, scene, set, plan, camera(0), progress));
    }
    if (with_motion) {
      motion = std::move(new_motion);
      motion_memory = std::move(new_memory);
    }
    return {};
  }

  Result<void> change(const scene::Scene& next, Progress& progress) {
    if (next.camera.camera.resolution != scene.camera.camera.resolution)
      return usage_error("the resolution of a running scene cannot change");
    CUTICLE_TRY(check_told_strands(next));
    painted = passed = k_none;
    const bool moves = next.simulation != scene.simulation;
    const bool other_passes = next.shadow != scene.shadow || next.fibre_alpha != scene.fibre_alpha ||
                              next.caster_share != scene.caster_share || next.passes != scene.passes ||
                              next.render_method != scene.render_method ||
                              !same_but_for_parameters(next.material, scene.material);
    const bool draws = other_passes || next.material != scene.material;
    scene::Scene scene_before = std::exchange(scene, next);
    leave_out_missing_head();
    const std::optional<StrandSet> set_before = put_in_order();
    Plan plan_before = std::exchange(plan, planned());
    const bool keeps_picture = picture && draws && !other_passes && !moves && has_same_passes(plan, plan_before);
    Result<void> made = keeps_picture ? take_parameters(progress) : make(moves, draws && scene.outputs.color, progress);
    if (made) return made;
    scene = std::move(scene_before);
    plan = std::move(plan_before);
    if (set_before) set = *set_before;
    if (keeps_picture) CUTICLE_TRY(make(false, true, progress));
    return made;
  }

  /// The strands as they were, where the scene asks for another order.
  std::optional<StrandSet> put_in_order() {
    if (set.is_spread || !may_use_a_prefix(scene)) return std::nullopt;
    std::optional<StrandSet> before = set;
    put_in_spread_order(set);
    return before;
  }

  /// Of the scene's model, by the picture as it is where its passes can.
  Result<void> take_parameters(Progress& progress) {
    CUTICLE_ASSIGN(const bool taken, picture->take_parameters(progress));
    return taken ? Result<void>() : make(false, true, progress);
  }

  Camera camera(int frame) const {
    return camera_at(scene.camera, rest_bounds,
                     {.frame = frame,
                      .seconds = frame / scene.frames_per_second,
                      .head_travel = motion ? motion->head_travel(frame) : glm::dvec3(0)});
  }

  /// What a vertex shows of a light is the most that a shader reads or writes anywhere in one storage buffer; places,
  /// tangents and colours are written in parts (strands/spline/drawn_parts.h).
  static Result<void> check_size(const registry::FrameShape& shape) {
    const std::uint64_t most = shape.max_storage_buffer_bytes / sizeof(float);
    if (shape.vertices <= most) return {};
    return bad_input(
        fmt::format("strand_count: {} strands have {} vertices; this device allows 1 .. {} vertices in one buffer",
                    shape.strands, shape.vertices, most),
        "lower strand_count or strand_vertices");
  }

  /// Of the frame that motion stands at.
  Keys keys_at(int frame) {
    if (!picture) return {};
    const Camera seen_by = camera(frame);
    ContentKey hair, view;
    hair.add(motion->hair_key());
    hair.add(picture->casting_strands(seen_by));
    view.add(seen_by);
    return {hair.value(), motion->surfaces_key(), view.value()};
  }

  /// Why every picture is drawn anew; empty: it may be that of the frame before.
  std::string always_new(int frame, bool everything) const {
    if (everything) return "all that is planned is asked for";
    if (painted == k_none) return "no frame was drawn before";
    if (frame == painted) return "the frame is asked for again";
    if (find_pass(plan, "temporal_antialiasing")) return "'temporal_antialiasing' gathers frames";
    if (find_pass(plan, "reference")) return "the reference traces paths";
    return {};
  }

  FrameMeasures measure(int frame, const Keys& keys, bool everything) const {
    const auto changed = [&](std::string_view what, std::uint64_t now, std::uint64_t before) -> registry::Fact {
      if (const std::string why = always_new(frame, everything); !why.empty()) return {true, why};
      if (now != before) return {true, fmt::format("{} changed", what)};
      return {false, fmt::format("{} as it was", what)};
    };
    return {motion->hair_awake(),
            motion->colliders_in_reach(),
            changed("hair", keys.hair, made_of.hair),
            changed("the head", keys.surfaces, made_of.surfaces),
            changed("the camera", keys.view, made_of.view),
            everything ? registry::Fact{true, "all that is planned is asked for"}
                       : hair_in_view(scene, set, plan, {motion->bounds(), motion->head(), camera(frame)})};
  }

  /// Which passes the frame runs; remembers of what their results will be made.
  void plan_this(int frame, bool everything) {
    const Keys keys = keys_at(frame);
    frame_plan = plan_frame(plan, frame, measure(frame, keys, everything));
    made_of.surfaces = keys.surfaces;
    made_of.view = keys.view;
    if (frame_plan.facts.at("hair_seen").holds) made_of.hair = keys.hair;
  }

  Result<void> paint(int frame, const FrameOptions& options, FrameResult& result) {
    if (frame_plan.paints()) CUTICLE_TRY(paint_anew(frame, result));
    painted = frame;
    if (find_pass(plan, "reference")) return trace_paths(frame, options, result);
    const auto begin = std::chrono::steady_clock::now();
    CUTICLE_TRY(read_back(result));
    result.read_back_ms = milliseconds_since(begin);
    return {};
  }

  Result<void> read_back(FrameResult& result) {
    if (scene.outputs.tells_strands()) {
      CUTICLE_ASSIGN(ToldPicture told, picture->read_told());
      result.color = std::move(told.color);
      result.shares = std::move(told.shares);
    } else {
      CUTICLE_ASSIGN(result.color, picture->read_color());
    }
    CUTICLE_ASSIGN(result.aovs, picture->read_aovs(result.color));
    result.notes = picture->notes();
    return {};
  }

  Result<void> paint_anew(int frame, FrameResult& result) {
    CUTICLE_ASSIGN(const gpu::SubmitCost cost, picture->paint({.control_positions = &motion->positions(),
                                                               .control_motion = motion->control_motion(),
                                                               .bounds = motion->bounds(),
                                                               .head = motion->head(),
                                                               .character = motion->character(),
                                                               .records_character = motion->records_character(),
                                                               .fins = motion->fins(),
                                                               .camera = camera(frame),
                                                               .camera_before = camera(std::max(0, frame - 1)),
                                                               .follows = frame == painted + 1,
                                                               .frame_plan = &frame_plan},
                                                              trace));
    result.repeats = picture->repeats();
    add_cost(cost, result.cost);
    return {};
  }

  /// A character's skin as the device deformed it; none where the head turns.
  Result<std::optional<strands::Mesh>> deformed_skin() const {
    const CharacterMotion* const character = motion->character();
    if (!character || set.head.triangles.empty()) return std::optional<strands::Mesh>();
    strands::Mesh mesh = set.head;
    const std::size_t count = mesh.positions.size();
    CUTICLE_ASSIGN(const auto positions, gpu::read_buffer<glm::vec4>(*device, character->mesh_positions(), count));
    CUTICLE_ASSIGN(const auto normals, gpu::read_buffer<glm::vec4>(*device, character->mesh_normals(), count));
    for (std::size_t v = 0; v < count; ++v) {
      mesh.positions[v] = glm::vec3(positions[v]);
      mesh.normals[v] = glm::vec3(normals[v]);
    }
    return std::optional(std::move(mesh));
  }

  Result<void> advance_to(int frame, const FrameOptions& options, FrameResult& result) {
    CUTICLE_ASSIGN(const gpu::SubmitCost cost, motion_memory->count(solver_name(), [&] {
      return motion->advance_to(frame, trace, options.everything);
    }));
    add_cost(cost, result.cost);
    plan_this(frame, options.everything);
    return {};
  }

  /// For an open shutter of the next frame.
  void keep_places(int frame, std::vector<glm::vec3> hair, std::optional<strands::Mesh> skin) {
    passed_places = {std::move(hair), camera(frame), motion->head(), std::move(skin)};
    if (motion->fins()) passed_places.fins = motion->fins()->mesh();
    passed = frame;
  }

  /// Where things were in the frame before, for an open shutter, unless it is known.
  Result<void> pass_by(int frame, const FrameOptions& options, FrameResult& result) {
    if (frame < 0 || frame == passed || !find_pass(plan, "reference") || !has_open_shutter(scene, plan.facts))
      return {};
    CUTICLE_TRY(advance_to(frame, options, result));
    CUTICLE_TRY(paint_anew(frame, result));
    painted = frame;
    CUTICLE_ASSIGN(strands::Groom hair, picture->read_strands());
    CUTICLE_ASSIGN(std::optional<strands::Mesh> skin, deformed_skin());
    keep_places(frame, std::move(hair.positions), std::move(skin));
    return {};
  }

  Result<void> trace_paths(int frame, const FrameOptions& options, FrameResult& result) {
    TracedPlaces places{.head = motion->head(), .fins = motion->fins() ? &motion->fins()->mesh() : nullptr};
    CUTICLE_ASSIGN(places.hair, picture->read_strands());
    CUTICLE_ASSIGN(places.skin, deformed_skin());
    if (has_open_shutter(scene, plan.facts)) {
      if (frame > 0) places.before = std::move(passed_places);
      keep_places(frame, places.hair.positions, places.skin);
    }
    Progress& progress = options.progress ? *options.progress : silent_progress();
    CUTICLE_ASSIGN(TracedFrame traced,
                   trace_frame(scene, set, std::move(places), camera(frame), options.path_state, progress));
    result.color = std::move(traced.color);
    result.aovs = std::move(traced.layers);
    result.shares = std::move(traced.shares);
    result.notes = {traced.note};
    return {};
  }
};

FrameRunner::FrameRunner(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FrameRunner::~FrameRunner() = default;

Result<std::unique_ptr<FrameRunner>> FrameRunner::create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                         Progress& progress, Trace* trace) {
  auto impl = std::make_unique<Impl>();
  impl->device = std::move(device);
  impl->scene = scene;
  impl->trace = trace;
  CUTICLE_TRY(impl->build(progress));
  return std::unique_ptr<FrameRunner>(new FrameRunner(std::move(impl)));
}

Result<void> FrameRunner::change(const scene::Scene& scene, Progress& progress) {
  return impl_->change(scene, progress);
}

Camera FrameRunner::camera(int frame) const { return impl_->camera(frame); }

const Plan& FrameRunner::plan() const { return impl_->plan; }
const FramePlan& FrameRunner::frame_plan() const { return impl_->frame_plan; }
std::map<std::string, std::size_t, std::less<>> FrameRunner::memory() const {
  auto bytes = impl_->motion_memory->bytes();
  if (!impl_->picture) return bytes;
  for (const auto& [name, size] : impl_->picture->memory().bytes()) bytes[name] += size;
  return bytes;
}
const strands::Mesh* FrameRunner::fins() const {
  return impl_->motion->fins() ? &impl_->motion->fins()->mesh() : nullptr;
}
const strands::Groom& FrameRunner::control_groom() const { return impl_->set.control; }
const std::vector<std::string>& FrameRunner::notes() const { return impl_->set.notes; }

const lut::TableSet& FrameRunner::tables() const {
  static const lut::TableSet none;
  const lut::TableSet* const baked = impl_->picture ? impl_->picture->tables() : nullptr;
  return baked ? *baked : none;
}

Result<FrameResult> FrameRunner::run(int frame, const FrameOptions& options) {
  if (frame < 0) return usage_error(fmt::format("frame {} is below 0", frame));
  const auto begin = std::chrono::steady_clock::now();
  FrameResult result;
  const bool paints = options.render && impl_->picture;
  if (paints) CUTICLE_TRY(impl_->pass_by(frame - 1, options, result));
  CUTICLE_TRY(impl_->advance_to(frame, options, result));
  if (paints) CUTICLE_TRY(impl_->paint(frame, options, result));
  if (options.read_state) {
    CUTICLE_ASSIGN(result.state, impl_->motion->state());
    result.colliders = impl_->motion->colliders();
    result.head = impl_->motion->head();
  }
  result.clock_ms = milliseconds_since(begin);
  return result;
}

Result<strands::Groom> FrameRunner::drawn_strands() {
  if (!impl_->picture)
    return usage_error("the scene wants no picture, so no strands are drawn", "set outputs.color to true");
  return impl_->picture->read_strands();
}

}  // namespace cuticle::plan
