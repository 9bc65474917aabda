#include "study/render/render_study.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/core.h>

#include "core/expect.h"
#include "plan/frame_runner_gpu.h"

namespace cuticle::study {

namespace {

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

std::string text_of(const Variant& variant) {
  std::string text;
  for (const Setting& setting : variant.settings)
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", setting.parameter, registry::to_text(setting.value));
  return text;
}

Setting truth_samples(int samples) { return {"truth", "samples", std::int64_t(samples)}; }

/// Tiles: samples that coverage is kept by.
void add_coverage(std::vector<Variant>& list) {
  for (int rows : {0, 2, 4, 16}) list.push_back({"tiles", {{"tiles", "coverage_rows", std::int64_t(rows)}}});
}

/// Tiles: order of transparency x shading points x level of detail.
void add_tiles(std::vector<Variant>& list, bool all) {
  const std::vector<int> slices = all ? std::vector{0, 8, 32, 128} : std::vector{0, 32};
  const std::vector<double> points = all ? std::vector{0.0, 16.0} : std::vector{0.0, 8.0};
  const std::vector<double> full = all ? std::vector{0.0, 1e5} : std::vector{0.0, 1e4};
  for (int slice : slices)
    for (double point : points)
      for (double px : full) {
        Variant variant{.method = "tiles"};
        if (slice > 0) variant.settings.push_back({"tile_sort", "slices", std::int64_t(slice)});
        if (point > 0) variant.settings.push_back({"shade_strands", "point_px", point});
        if (px > 0) variant.settings.push_back({"tile_lists", "full_px", px});
        variant.shown = variant.settings.empty();
        list.push_back(std::move(variant));
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
  add_coverage(list);
  add_tiles(list, all);
  for (int samples = 1; samples < truth_most; samples *= 2) list.push_back({"truth", {truth_samples(samples)}});
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

struct Picture {
  Image image;
  double ms = 0;
  std::size_t bytes = 0;
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// The truth is timed whole, for the CPU does its work; the others by their submission.
Result<Picture> draw(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, int repeats, Progress& progress) {
  const std::size_t before = device->allocated_bytes();
  const bool is_truth = scene.render_method == "truth";
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, scene, progress));
  Picture picture;
  for (int k = 0; k < (is_truth ? 1 : repeats); ++k) {
    const auto start = std::chrono::steady_clock::now();
    CUTICLE_ASSIGN(plan::FrameResult frame, runner->run(0));
    const double ms = is_truth ? milliseconds_since(start) : frame.cost.wall_ms;
    picture.ms = k == 0 ? ms : std::min(picture.ms, ms);
    picture.image = std::move(frame.color);
  }
  picture.bytes = device->allocated_bytes() - before;
  return picture;
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

class Study {
 public:
  Study(std::shared_ptr<gpu::Device> device, const RenderRequest& request, Progress& progress)
      : device_(std::move(device)), request_(request), progress_(progress) {
    study_.device = device_->info().name;
    study_.scene = request.scene.name;
    study_.truth_samples = request.truth_samples;
  }

  Result<RenderStudy> run() {
    scene::Scene scene = hair_of(request_.scene);
    if (request_.grows) CUTICLE_TRY(run_growth(scene));
    CUTICLE_TRY(run_view("near", scene));
    Camera& camera = scene.camera.camera;
    camera.position = camera.target + 4.0 * (camera.position - camera.target);
    camera.far_plane *= 4;
    if (!scene.camera.automatic) CUTICLE_TRY(run_view("four times as far", scene));
    return std::move(study_);
  }

 private:
  Result<void> run_view(const std::string& name, const scene::Scene& scene) {
    CUTICLE_ASSIGN(const Picture truth, draw_variant({"truth", {truth_samples(request_.truth_samples)}}, scene));
    const double exposure = scene.outputs.exposure_stops;
    RenderView view{name, {"truth"}, {tone_map(truth.image, exposure)}};
    std::vector<Image> differences = {make_image(truth.image.width, truth.image.height, {"R", "G", "B", "A"})};
    for (const Variant& variant : variants(request_.truth_samples, request_.grows)) {
      CUTICLE_ASSIGN(const Picture picture, draw_variant(variant, scene));
      study_.rows.push_back(
          {name, variant.method, text_of(variant), compare(picture.image, truth.image), picture.ms, picture.bytes});
      if (!variant.shown) continue;
      view.titles.push_back(variant.method);
      view.pictures.push_back(tone_map(picture.image, exposure));
      differences.push_back(difference(picture.image, truth.image));
    }
    view.pictures.insert(view.pictures.end(), differences.begin(), differences.end());
    study_.views.push_back(std::move(view));
    return {};
  }

  /// What a frame costs as one size grows and the others stand; the widest strands overlap most.
  Result<void> run_growth(const scene::Scene& scene) {
    for (std::string_view what : {"strands", "pixels", "overlap"})
      for (std::string_view method : {"lines", "quads", "tiles"})
        for (double factor : {0.0625, 0.25, 1.0, 4.0}) {
          scene::Scene sized = scene;
          if (what == "strands") sized.strand_count = std::max(1, int(scene.strand_count * factor));
          if (what == "pixels")
            sized.camera.camera.resolution = glm::ivec2(glm::dvec2(scene.camera.camera.resolution) * std::sqrt(factor));
          if (what == "overlap")
            sized.fibre_count = (scene.fibre_count > 0 ? scene.fibre_count : scene::k_usual_fibre_count) * factor;
          CUTICLE_ASSIGN(const Picture picture, draw_variant({std::string(method)}, sized));
          study_.growth.push_back({std::string(what), std::string(method), factor, picture.ms});
        }
    return {};
  }

  Result<Picture> draw_variant(const Variant& variant, scene::Scene scene) {
    progress_.message(fmt::format("drawing: {} {}", variant.method, text_of(variant)));
    apply(variant, scene);
    return draw(device_, scene, request_.repeats, progress_);
  }

  std::shared_ptr<gpu::Device> device_;
  const RenderRequest& request_;
  Progress& progress_;
  RenderStudy study_;
};

}  // namespace

const RenderRow* cheapest(const std::vector<RenderRow>& rows, std::string_view view, double error) {
  const RenderRow* best = nullptr;
  for (const RenderRow& row : rows)
    if (row.view == view && row.error.coverage <= error && (!best || row.ms < best->ms)) best = &row;
  return best;
}

Result<RenderStudy> run_render_study(std::shared_ptr<gpu::Device> device, const RenderRequest& request,
                                     Progress& progress) {
  return Study(std::move(device), request, progress).run();
}

}  // namespace cuticle::study
