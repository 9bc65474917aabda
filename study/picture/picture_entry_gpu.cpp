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

Result<LadderRequest> request_of(const StudyRequest& request, const std::string& file, const std::string& name,
                                 std::string hair) {
  LadderRequest ladder;
  ladder.name = name;
  CUTICLE_ASSIGN(ladder.scene, scene::load_scene(file, plan::catalogue()));
  ladder.hair = request.options.at("hair").empty() ? std::move(hair) : request.options.at("hair");
  ladder.truth_model = request.options.at("truth-model");
  for (const std::string& rung : split_commas(request.options.at("without"))) ladder.without.insert(rung);
  if (request.quick) {
    ladder.scene.camera.camera.resolution = ladder.scene.camera.camera.resolution * 3 / 8;
    ladder.samples = 64;
    ladder.batches = 4;
    ladder.truth_coverage = 8;
  }
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
  study.timing.rounds = request.quick ? 3 : 5;
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
                  {"without", "", "rungs that are switched off, a,b,c"}},
      .declare = declare_picture,
      .quick_seconds = 65,
      .seconds = 600};
  return entry;
}

}  // namespace cuticle::study
