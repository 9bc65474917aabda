#include "study/render/render_study.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/core.h>

#include "core/expect.h"
#include "plan/frame_runner_gpu.h"
#include "render/passes/tiles/tiles.h"
#include "study/picture/pose.h"

namespace cuticle::study {

namespace {

constexpr int k_moving_frame = 16;

/// What one pass is told beside the scene's own.
struct Setting {
  std::string pass, parameter;
  registry::Value value;
};

/// A way to draw.
struct Variant {
  std::string method;
  std::vector<Setting> settings = {};
  bool shown = false;  ///< at its defaults, in the pictures
};

Setting truth_samples(int samples) { return {"supersampled", "samples", std::int64_t(samples)}; }

/// Tiles: samples that coverage is kept by.
void add_coverage(std::vector<Variant>& list, bool all) {
  const auto usual = std::int64_t(render::tiles::Parameters{}.coverage_rows);
  for (const std::int64_t rows :
       all ? std::vector<std::int64_t>{0, 2, 4, 8, 16} : std::vector<std::int64_t>{0, 4, 8, 16})
    list.push_back({"tiles", {{"tiles", "coverage_rows", rows}}, rows == usual});
}

/// Tiles: order of transparency x shading points x level of detail.
void add_tiles(std::vector<Variant>& list) {
  for (int slice : {0, 8, 32, 128})
    for (double point : {0.0, 16.0})
      for (double px : {0.0, 1e5}) {
        Variant variant{.method = "tiles"};
        if (slice > 0) variant.settings.push_back({"tile_sort", "slices", std::int64_t(slice)});
        if (point > 0) variant.settings.push_back({"shade_strands", "point_px", point});
        if (px > 0) variant.settings.push_back({"tile_lists", "full_px", px});
        if (!variant.settings.empty()) list.push_back(std::move(variant));
      }
}

std::vector<Variant> variants(int truth_most, bool all) {
  std::vector<Variant> list = {{.method = "lines", .shown = true},
                               {"lines", {{"lines", "widest_px", 16.0}}},
                               {"quads", {{"quads", "samples", std::int64_t(1)}}},
                               {.method = "quads", .shown = true},
                               {.method = "cards", .shown = true}};
  if (all) {
    list.push_back({"lines", {{"lines", "full_px", 1e4}}});
    list.push_back({"quads", {{"quads", "full_px", 1e4}}});
  }
  add_coverage(list, all);
  if (all)
    add_tiles(list);
  else
    list.push_back({"tiles", {{"tile_sort", "slices", std::int64_t(32)}}});
  for (int samples = 1; samples < truth_most; samples *= all ? 2 : 4)
    list.push_back({"supersampled", {truth_samples(samples)}});
  return list;
}

void apply(const Variant& variant, scene::Scene& scene) {
  scene.render_method = variant.method;
  const auto& passes = plan::catalogue().passes;
  for (const Setting& setting : variant.settings) {
    const auto entry = std::ranges::find(passes, setting.pass, &registry::Entry::name);
    CUTICLE_EXPECT(entry != passes.end(), "the study names registered passes");
    auto& values = scene.passes.try_emplace(setting.pass, registry::default_values((*entry)->parameters)).first->second;
    values.set(setting.parameter, setting.value);
  }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The hair alone, at rest.
scene::Scene hair_of(const scene::Scene& scene) {
  scene::Scene hair = scene;
  hair.head.present = false;
  hair.motion.reset();
  hair.simulation = {};
  hair.passes.erase("resolve");
  return hair;
}

/// Coverage that is missing in red, that is too much in green; four times the difference.
Image difference(const Image& picture, const Image& truth) {
  Image image = make_image(truth.width, truth.height, {"R", "G", "B", "A"});
  for (std::size_t p = 0; p < image.pixels.size(); p += 4) {
    const float more = 4 * (picture.pixels[p + 3] - truth.pixels[p + 3]);
    image.pixels[p] = std::clamp(-more, 0.0f, 1.0f);
    image.pixels[p + 1] = std::clamp(more, 0.0f, 1.0f);
    image.pixels[p + 3] = 1;
  }
  return image;
}

std::vector<Knob> knobs_of(const Variant& variant) {
  std::vector<Knob> knobs;
  for (const Setting& setting : variant.settings)
    knobs.push_back({setting.parameter, registry::to_text(setting.value)});
  return knobs;
}

/// One view: its runner, which every variant changes, and the truth.
struct View {
  std::shared_ptr<plan::FrameRunner> runner;
  std::shared_ptr<gpu::Device> device;
  scene::Scene scene;
  std::size_t bytes_before = 0;
  Image truth;

  Result<void> change(const Variant& variant) {
    scene::Scene changed = scene;
    apply(variant, changed);
    return runner->change(changed, silent_progress());
  }
  Result<Image> draw(const Variant& variant) {
    CUTICLE_TRY(change(variant));
    CUTICLE_ASSIGN(plan::FrameResult frame, runner->run(0));
    return std::move(frame.color);
  }
};
using SharedView = std::shared_ptr<View>;

Result<SharedView> make_view(const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene, int samples,
                             Progress& progress) {
  const auto view = std::make_shared<View>(View{nullptr, device, scene, device->allocated_bytes(), {}});
  const Variant truth{.method = "supersampled", .settings = {truth_samples(samples)}};
  scene::Scene first = scene;
  apply(truth, first);
  CUTICLE_ASSIGN(view->runner, plan::FrameRunner::create(device, first, progress));
  CUTICLE_ASSIGN(plan::FrameResult frame, view->runner->run(0));
  view->truth = std::move(frame.color);
  return view;
}

Point point_of(const SharedView& view, const Variant& variant) {
  const auto measure = [=]() -> Result<Measured> {
    CUTICLE_ASSIGN(const Image picture, view->draw(variant));
    PictureErrors errors = compare(picture, view->truth);
    return Measured{{std::move(errors.coverage), std::move(errors.color)},
                    double(view->device->allocated_bytes() - view->bytes_before)};
  };
  // Shaders and tables are made in the frame that is not timed; the one that is leaves nothing out.
  const auto before = [=]() -> Result<void> {
    CUTICLE_TRY(view->draw(variant));
    return {};
  };
  const auto run = [=]() -> Result<void> {
    CUTICLE_TRY(view->runner->run(0, {.everything = true}));
    return {};
  };
  return {variant.method, knobs_of(variant), measure, {before, run, 1}};
}

/// Pictures of the methods at their defaults, and what their coverage lacks.
Result<void> add_pictures(Study& study, const std::string& name, View& view, const std::vector<Variant>& list) {
  const double exposure = view.scene.outputs.exposure_stops;
  const std::string truth = fmt::format("{}_truth.png", name);
  study.pictures.push_back({truth, fmt::format("{}: truth", name), "", tone_map(view.truth, exposure)});
  for (const Variant& variant : list) {
    if (!variant.shown) continue;
    CUTICLE_ASSIGN(const Image picture, view.draw(variant));
    const std::string stem = fmt::format("{}_{}", name, variant.method);
    study.pictures.push_back(
        {stem + ".png", fmt::format("{}: {}", name, variant.method), truth, tone_map(picture, exposure)});
    study.pictures.push_back({stem + "_error.png", "coverage: missing red, too much green, four times", "",
                              difference(picture, view.truth)});
  }
  return {};
}

Result<void> add_view(Study& study, const std::string& name, const SharedView& view, const RenderRequest& request) {
  const std::vector<Variant> list = variants(request.truth_samples, request.grows);
  Group group{
      .name = name,
      .title = fmt::format("Ways to draw hair, {}", name),
      .truth = fmt::format("every sample of {0} x {0} in a pixel with all strands that cover it, sorted exactly",
                           request.truth_samples),
      .metrics = {{"coverage", "mean error of coverage"}, {"color", "mean error of luminance / mean luminance"}},
      .item = "tile of 16 x 16 pixels"};
  for (const Variant& variant : list) group.points.push_back(point_of(view, variant));
  study.groups.push_back(std::move(group));
  return add_pictures(study, name, *view, list);
}

scene::Scene sized(const scene::Scene& scene, std::string_view what, double factor) {
  scene::Scene changed = scene;
  if (what == "strands") changed.strand_count = std::max(1, int(scene.strand_count * factor));
  if (what == "pixels")
    changed.camera.camera.resolution = glm::ivec2(glm::dvec2(scene.camera.camera.resolution) * std::sqrt(factor));
  if (what == "overlap")
    changed.fibre_count = (scene.fibre_count > 0 ? scene.fibre_count : scene::k_usual_fibre_count) * factor;
  return changed;
}

/// The least of three frames' wall clock.
Result<double> frame_seconds(const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene) {
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, silent_progress()));
  double best = 1e300;
  for (int k = 0; k < 3; ++k) {
    const auto start = std::chrono::steady_clock::now();
    CUTICLE_TRY(runner->run(0));
    best = std::min(best, seconds_since(start));
  }
  return best;
}

/// What a frame costs as one size grows and the others stand; the widest strands overlap most.
Result<void> add_growth(Study& study, const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene,
                        Progress& progress) {
  for (const char* what : {"strands", "pixels", "overlap"}) {
    Group group{.name = fmt::format("growth of {}", what), .title = fmt::format("A frame's time as the {} grow", what)};
    for (const char* method : {"lines", "quads", "tiles"})
      for (double factor : {0.0625, 0.25, 1.0, 4.0}) {
        progress.message(fmt::format("{} times the {} by {}", factor, what, method));
        scene::Scene changed = sized(scene, what, factor);
        changed.render_method = method;
        CUTICLE_ASSIGN(const double seconds, frame_seconds(device, changed));
        group.points.push_back({method,
                                {{"factor", fmt::format("{:g}", factor)}},
                                [] { return Result<Measured>(Measured{}); },
                                {},
                                seconds});
      }
    study.groups.push_back(std::move(group));
  }
  return {};
}

}  // namespace

/// A scene's hair as framed, and from four times as far.
Result<void> add_scene(Study& study, const std::shared_ptr<gpu::Device>& device, const std::string& prefix,
                       scene::Scene scene, const RenderRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const SharedView near, make_view(device, scene, request.truth_samples, progress));
  CUTICLE_TRY(add_view(study, prefix + "near", near, request));
  if (scene.camera.automatic) return {};
  Camera& camera = scene.camera.camera;
  camera.position = camera.target + 4.0 * (camera.position - camera.target);
  camera.far_plane *= 4;
  CUTICLE_ASSIGN(const SharedView far, make_view(device, scene, request.truth_samples, progress));
  return add_view(study, prefix + "far", far, request);
}

/// The hair of another scene, at rest and, where it is simulated, in a frame of its motion.
Result<void> add_groom(Study& study, const std::shared_ptr<gpu::Device>& device, const GroomInRender& groom,
                       const RenderRequest& request, Progress& progress) {
  RenderRequest few = request;
  few.grows = false;
  CUTICLE_TRY(add_scene(study, device, groom.name + ", still, ", hair_of(groom.scene), few, progress));
  if (!is_simulated(groom.scene)) return {};
  CUTICLE_ASSIGN(const auto pose, Pose::make(device, groom.scene, k_moving_frame, progress));
  scene::Scene moved = hair_of(pose->at_rest(groom.scene));
  return add_scene(study, device, groom.name + ", moving, ", std::move(moved), few, progress);
}

Result<Study> render_study(std::shared_ptr<gpu::Device> device, const RenderRequest& request, Progress& progress) {
  Study study{
      .name = "render",
      .title = fmt::format("Ways to draw hair against brute force: {}", request.scene.name),
      .question = "Which way of drawing, which anti-aliasing and which order of transparency, at what cost?",
      .cost_label = "one frame",
      .wall_clock = !device->info().is_software,
      .device = device->info().name,
      .driver = device->info().driver,
      .timing = {.rounds = request.rounds, .sample_seconds = 1e-6, .slow_seconds = request.rounds == 1 ? 0.0 : 1.0}};
  const scene::Scene scene = hair_of(request.scene);
  CUTICLE_TRY(add_scene(study, device, "", scene, request, progress));
  if (request.grows) CUTICLE_TRY(add_growth(study, device, scene, progress));
  for (const GroomInRender& groom : request.grooms) CUTICLE_TRY(add_groom(study, device, groom, request, progress));
  return study;
}

}  // namespace cuticle::study
