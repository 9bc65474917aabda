#include <charconv>
#include <filesystem>

#include <fmt/core.h>

#include "plan/plan.h"
#include "study/engine/split.h"
#include "study/picture/picture_study.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

/// The scenes of our own, and the physical fibre of each.
struct LadderScene {
  const char *name, *hair;
};
constexpr LadderScene k_scenes[] = {{"blond", "blond"}, {"curls", "black"}, {"fur", "fur_brown"}};

/// A whole number above zero that was typed, or what stands without it.
Result<int> number_of(const StudyRequest& request, const std::string& name, int without) {
  const std::string& text = request.options.at(name);
  if (text.empty()) return without;
  int number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code == std::errc() && end == text.data() + text.size() && number > 0) return number;
  return usage_error(fmt::format("--{}: '{}' is no whole number above 0", name, text));
}

/// How large the pictures are and how many paths they have.
Result<void> set_size(const StudyRequest& request, LadderRequest& ladder) {
  glm::ivec2& resolution = ladder.scene.camera.camera.resolution;
  CUTICLE_ASSIGN(const int width, number_of(request, "pixels", request.quick ? resolution.x / 4 : resolution.x / 2));
  resolution = {width, std::max(1, resolution.y * width / resolution.x)};
  CUTICLE_ASSIGN(ladder.samples, number_of(request, "samples", request.quick ? 48 : ladder.samples));
  if (request.quick) {
    ladder.truth_coverage = 8;
    ladder.reference_steps = 32;
    ladder.scene.material.lut_size = 64;
  }
  return {};
}

Result<LadderRequest> request_of(const StudyRequest& request, const std::string& file, const std::string& name,
                                 std::string hair) {
  LadderRequest ladder;
  ladder.name = name;
  CUTICLE_ASSIGN(ladder.scene, scene::load_scene(file, plan::catalogue()));
  ladder.hair = request.options.at("hair").empty() ? std::move(hair) : request.options.at("hair");
  ladder.truth_model = request.options.at("truth-model");
  for (const std::string& rung : split_commas(request.options.at("without"))) ladder.without.insert(rung);
  CUTICLE_TRY(set_size(request, ladder));
  return ladder;
}

Result<std::vector<LadderRequest>> requests_of(const StudyRequest& request) {
  const std::string& scene = request.options.at("scene");
  std::vector<LadderRequest> requests;
  for (const LadderScene& known : k_scenes) {
    if (scene != "all" && scene != known.name) continue;
    CUTICLE_ASSIGN(requests.emplace_back(),
                   request_of(request, fmt::format("{}/scenes/ladder/{}.json", request.share, known.name), known.name,
                              known.hair));
  }
  if (!requests.empty()) return requests;
  CUTICLE_ASSIGN(requests.emplace_back(), request_of(request, scene, std::filesystem::path(scene).stem().string(), ""));
  return requests;
}

Result<Study> declare_picture(const StudyRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const std::vector<LadderRequest> requests, requests_of(request));
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = request.device}));
  Study study{.name = "picture",
              .title = "The ladder: from path tracing to the real-time picture",
              .question = "Which approximation costs how much of the final picture, and which saves the time?",
              .cost_label = "one frame",
              .wall_clock = !device->info().is_software,
              .device = device->info().name,
              .driver = device->info().driver};
  study.timing.rounds = 5;
  if (request.quick) study.timing.slow_seconds = 0.05;  // such frames are timed once
  study.notes = {
      "Errors are of premultiplied linear radiance, over the pixels that hair covers in any rung. Times of traced "
      "rungs and of brute-force "
      "coverage are of one frame, by wall clock; of the others medians. Every rung keeps what the rungs before it "
      "changed."};
  for (const LadderRequest& each : requests) {
    CUTICLE_ASSIGN(const Ladder ladder, climb(device, each, progress));
    add_ladder(study, each.name, ladder);
  }
  return study;
}

}  // namespace

const StudyEntry& picture_entry() {
  static const StudyEntry entry{
      .name = "picture",
      .summary = "the ladder: what each approximation between path tracing and the real-time picture adds and saves",
      .options = {{"scene", "all", "scene file, or one of our own: blond, curls, fur; all: these three", true},
                  {"hair", "",
                   "physical fibre of both models; without it that of our scene, or a scene file's own material"},
                  {"truth-model", "chiang", "model of the path-traced truth"},
                  {"without", "", "rungs that are switched off, a,b,c"},
                  {"pixels", "", "width of the pictures; without it half of the scene's, with --quick a quarter"},
                  {"samples", "", "paths of a pixel; without it 256, with --quick 48"}},
      .declare = declare_picture,
      .quick_seconds = 56,
      .seconds = 300};
  return entry;
}

}  // namespace cuticle::study
