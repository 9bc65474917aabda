// What leaving a thing out saves: frames of one scene with a feature and without, and frames in which nothing happens.
#include <algorithm>
#include <memory>
#include <sstream>

#include <fmt/core.h>

#include "gpu/device.h"
#include "plan/frame_runner_gpu.h"
#include "study/plan/accuracy_gpu.h"
#include "study/registry/entries.h"

namespace cuticle::study {
namespace {

using plan::FrameRunner;

/// A feature: the keys of the scene with it and without it; what runs for it alone is counted and timed.
struct Feature {
  std::string_view name, on, off;
};
constexpr std::string_view k_base = R"("schema_version": 1, "strand_vertices": 16,
  "material": {"lut_size": 32, "layout": "nalu"})";
/// A camera that sees the head; what it takes beside that, and how many pixels it has each way.
constexpr std::string_view k_sees_the_head = R"("position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0])",
                           k_sees_nothing = R"("position_m": [0.2, 0.15, 1.1], "target_m": [0.4, 0.25, 2.2])",
                           k_turns = R"(, "turntable_deg_per_frame": 1)";
std::string camera(const StudyRequest& request, std::string_view place, std::string_view more = "") {
  return fmt::format(R"(, "camera": {{{0}, "fov_deg": 24, "resolution_px": [{2}, {2}]{1}}})", place, more,
                     request.quick ? 96 : 256);
}
constexpr std::string_view k_light = R"(, "lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [3, 3, 3]}])",
                           k_no_surface_shadow = R"(, "passes": {"surface_shadow": {"wanted": false}})",
                           k_moves = R"(, "motion": {"bvh": "motion/head_turn.bvh"})",
                           k_quads = R"(, "render": {"method": "quads"})",
                           k_tiles = R"(, "render": {"method": "tiles"})",
                           k_shadow = R"(, "shadow": {"method": {"deep_opacity": {}}})";

struct Ablation {
  Feature feature;
  std::string_view beside, further = "";  ///< keys that both have
};
constexpr Ablation k_ablations[] = {
    {{"opacity_map", R"(, "shadow": {"method": {"opacity_map": {}}})", ""}, k_light, k_no_surface_shadow},
    {{"deep_opacity", k_shadow, ""}, k_light, k_no_surface_shadow},
    {{"moments", R"(, "shadow": {"method": {"moments": {}}})", ""}, k_light, k_no_surface_shadow},
    {{"voxel", R"(, "shadow": {"method": {"voxel": {}}})", ""}, k_light, k_no_surface_shadow},
    {{"surface_shadow", R"(, "passes": {"surface_shadow": {}})", ""}, k_light},
    {{"head", "", R"(, "head": {"present": false})"}, k_light},
    {{"floor", R"(, "floor": {"height_m": -0.2})", ""}, k_light},
    {{"layers", R"(, "outputs": {"aovs": true})", ""}, k_light},
    {{"velocity", R"(, "passes": {"velocity": {}})", ""}, k_moves},
    {{"motion_blur", R"(, "passes": {"motion_blur": {}})", ""}, k_moves},
    {{"temporal_antialiasing", R"(, "render": {"method": "quads"}, "passes": {"temporal_antialiasing": {}})", k_quads},
     k_light},
    {{"ambient_occlusion", R"(, "passes": {"ambient_occlusion": {}})", ""}, k_light},
    {{"depth_of_field", R"(, "passes": {"depth_of_field": {}})", ""}, k_light},
    {{"cull_strands", "", R"(, "passes": {"cull_strands": {"wanted": false}})"}, k_light},
    {{"simulation", R"(, "simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}}})", ""}, k_moves},
    {{"colliders", R"(, "colliders": {"head": true})", ""},
     R"(, "simulation": {"solver": {"classic": {}}, "effects": {"gravity": {}, "colliders": {}}, "solve_on": "device"})"},
    {{"strand_interaction",
      R"(, "simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}, "strand_interaction": {}}, "solve_on": "device"})",
      R"(, "simulation": {"solver": {"exact": {}}, "effects": {"gravity": {}}, "solve_on": "device"})"},
     ""},
    {{"tiles", k_tiles, R"(, "render": {"method": "lines"})"}, k_light},
};

/// A scene that runs, frame after frame.
struct Running {
  std::unique_ptr<FrameRunner> runner;
  int frame = 0;
  bool everything = true;
  Result<plan::FrameResult> next() { return runner->run(frame++, {.everything = everything}); }
};

Result<std::shared_ptr<Running>> start(const std::shared_ptr<gpu::Device>& device, const StudyRequest& request,
                                       std::string_view keys) {
  const std::string text = fmt::format("{{{}{}, \"strand_count\": {}}}", k_base, keys, request.quick ? 500 : 8000);
  CUTICLE_ASSIGN(const scene::Scene scene,
                 scene::parse_scene(text, request.share + "/scenes", "study plan", plan::catalogue()));
  auto running = std::make_shared<Running>();
  CUTICLE_ASSIGN(running->runner, FrameRunner::create(device, scene, silent_progress()));
  return running;
}

double ran(const plan::FrameResult& frame, const std::vector<std::string>& of) {
  double count = 0;
  for (const gpu::PassCost& pass : frame.cost.passes)
    if (of.empty() || std::ranges::find(of, pass.name) != of.end()) count += pass.dispatches + pass.draws;
  return count;
}

/// Passes of the one plan that the other does not have.
std::vector<std::string> only_in(const plan::Plan& one, const plan::Plan& other) {
  std::vector<std::string> names;
  for (const plan::PlannedPass& pass : one.passes)
    if (!plan::find_pass(other, pass.entry->name)) names.emplace_back(pass.entry->name);
  return names;
}

/// The error is how much ran of `own`, in dispatches and draws: none where the feature is off.
Point point_of(std::string_view method, std::string_view state, std::shared_ptr<Running> running,
               std::vector<std::string> own) {
  Point point{.method = std::string(method), .knobs = {{"state", std::string(state)}}};
  point.measure = [running, own]() -> Result<Measured> {
    CUTICLE_TRY(running->next());
    CUTICLE_ASSIGN(const plan::FrameResult frame, running->next());
    double bytes = 0;
    for (const auto& [name, held] : running->runner->memory()) bytes += double(held);
    return Measured{{{ran(frame, own)}}, bytes};
  };
  point.work.run = [running]() -> Result<void> {
    CUTICLE_TRY(running->next());
    return {};
  };
  return point;
}

Group group_of(std::string name, std::string title) {
  return {.name = std::move(name),
          .title = std::move(title),
          .truth = "nothing of the feature runs",
          .metrics = {{"ran", "dispatches and draws of its passes", "1", Mean::arithmetic}},
          .item = "frame"};
}

Result<Group> ablations(const std::shared_ptr<gpu::Device>& device, const StudyRequest& request, Progress& progress) {
  Group group = group_of("features", "A frame with a feature and without it");
  std::size_t done = 0;
  for (const Ablation& ablation : k_ablations) {
    progress.update("features", done++, std::size(k_ablations));
    const auto with = [&](std::string_view keys) {
      return start(device, request,
                   fmt::format("{}{}{}{}", camera(request, k_sees_the_head), ablation.beside, ablation.further, keys));
    };
    CUTICLE_ASSIGN(const auto on, with(ablation.feature.on));
    CUTICLE_ASSIGN(const auto off, with(ablation.feature.off));
    const std::vector<std::string> own = only_in(on->runner->plan(), off->runner->plan());
    group.points.push_back(point_of(ablation.feature.name, "on", on, own));
    group.points.push_back(point_of(ablation.feature.name, "off", off, own));
  }
  return group;
}

/// Frames with all that may be left out left out.
Result<Group> quiet_frames(const std::shared_ptr<gpu::Device>& device, const StudyRequest& request) {
  Group group = group_of("frames", "Frames in which something happens, and in which nothing does");
  const auto add = [&](std::string_view method, std::string_view state, std::string_view keys) -> Result<void> {
    CUTICLE_ASSIGN(auto running, start(device, request, fmt::format("{}{}{}{}", k_light, k_shadow, k_tiles, keys)));
    running->everything = false;
    group.points.push_back(point_of(method, state, std::move(running), {}));
    return {};
  };
  constexpr std::string_view k_bald = R"(, "head": {"present": false})";
  const std::string seen = camera(request, k_sees_the_head);
  CUTICLE_TRY(add("scene", "moving", fmt::format("{}{}", seen, k_moves)));
  CUTICLE_TRY(add("scene", "still", seen));
  const std::string moving_bald = fmt::format("{}{}", k_moves, k_bald);
  CUTICLE_TRY(add("hair", "in view", seen + moving_bald));
  CUTICLE_TRY(add("hair", "behind the camera", camera(request, k_sees_nothing) + moving_bald));
  CUTICLE_TRY(add("camera", "turns", camera(request, k_sees_the_head, k_turns)));
  return group;
}

/// "a,b" as a list.
std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  return names;
}

/// Rows of parts that are not measured, from the file as it is; asked for first, as measuring takes minutes.
Result<std::vector<plan::AccuracyRow>> rows_of_others(const std::string& file, const std::vector<std::string>& parts) {
  std::vector<plan::AccuracyRow> rows;
  if (parts.size() == 4) return rows;
  CUTICLE_ASSIGN(const plan::AccuracyTable before, plan::read_accuracy_table(file));
  for (const plan::AccuracyRow& row : before.rows)
    if (std::ranges::find(parts, row.part) == parts.end()) rows.push_back(row);
  return rows;
}

Result<Study> declare_plan(const StudyRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const auto device, gpu::Device::open({.choice = request.device}));
  Study study{.name = "plan",
              .title = "Only what the scene calls for",
              .question = "What does leaving a feature out save?",
              .cost_label = "time of a frame",
              .wall_clock = !device->info().is_software,  // its kernels run on the processor
              .device = device->info().name,
              .driver = device->info().driver};
  if (request.quick) study.timing.rounds = 3;
  if (const std::string& file = request.options.at("accuracy"); !file.empty()) {
    std::vector<std::string> scenes;
    for (const char* name : {"blond", "curls", "fur"})
      scenes.push_back(fmt::format("{}/scenes/ladder/{}.json", request.share, name));
    for (const char* name : {"waves", "straight", "curls"})
      scenes.push_back(fmt::format("{}/scenes/{}.json", request.share, name));
    const std::vector<std::string> parts = names_in(request.options.at("parts"));
    CUTICLE_ASSIGN(const std::vector<plan::AccuracyRow> others, rows_of_others(file, parts));
    CUTICLE_ASSIGN(plan::AccuracyTable table, measure_accuracy(device, scenes, parts, progress));
    table.rows.insert(table.rows.end(), others.begin(), others.end());
    std::ranges::stable_sort(table.rows, {}, &plan::AccuracyRow::part);
    CUTICLE_TRY(plan::write_accuracy_table(file, table));
  }
  CUTICLE_ASSIGN(study.groups.emplace_back(), ablations(device, request, progress));
  CUTICLE_ASSIGN(study.groups.emplace_back(), quiet_frames(device, request));
  study.notes.push_back("Off: the passes that only the scene with the feature has do not run; their time is none.");
  return study;
}

}  // namespace

const StudyEntry& plan_entry() {
  static const StudyEntry entry{
      .name = "plan",
      .summary =
          "what leaving a feature out saves: frames with each and without, still and "
          "moving, hair in view and behind the camera",
      .options = {{"accuracy", "", "first measure the errors that budgets choose by, and write them to this file"},
                  {"parts", "shadow,coverage,shading,motion",
                   "measure the errors of these parts; the file keeps what it has of others"}},
      .declare = declare_plan,
      .quick_seconds = 35,
      .seconds = 180};
  return entry;
}

}  // namespace cuticle::study
