// Scenes put together by chance: what runs is what their facts demand, no more and no less, with the dispatches and the
// memory that the plan says; taking a thing out leaves all results that
// do not depend on it, bit for bit.
#include "tests/support/small_frames.h"

#include <bit>
#include <cstdlib>
#include <random>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "shadows/method_gpu.h"
#include "strands/formats/formats.h"

namespace cuticle::plan::random_scenes_gpu_test {
namespace {

using namespace tests;

/// Results of a frame: places of the hair, picture, layers of what each pixel sees.
enum Results : unsigned { k_places = 1, k_picture = 2, k_layers = 4, k_seen = k_picture | k_layers, k_all = 7 };

/// What a scene may have; each is there or not. All results but those that it may change are the same without it.
struct Part {
  std::string_view text;
  unsigned changes;
};
constexpr Part k_parts[] = {
    {R"("lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [6, 6, 6]}])", k_seen},
    {R"("motion": {"bvh": "motion/head_turn.bvh"})", k_all},
    {R"("floor": {"height_m": -0.2})", k_seen},
    {R"("head": {"present": false})", k_seen},
    {R"("outputs": {"aovs": true})", k_layers},
    {R"("colliders": {"head": true})", k_all},
    {R"("fins": {"mesh": "fins/ear_fins.obj", "weights": "fins/ear_fins.png"})", k_seen},
    {R"("groom": {"follow_hairs": {"per_guide": 3, "reach_m": 0.003}})", k_seen},
};
constexpr std::string_view k_draws[] = {"lines", "quads", "tiles", "cards"};
/// Temporal anti-aliasing moves the camera by parts of a pixel; motion blur and lenses are laid over the picture;
/// motion vectors are a layer.
constexpr Part k_passes[] = {
    {R"("surface_shadow": {})", k_seen},         {R"("ambient_occlusion": {})", k_picture},
    {R"("depth_of_field": {})", k_picture},      {R"("motion_blur": {})", k_seen},
    {R"("temporal_antialiasing": {})", k_seen},  {R"("velocity": {})", k_layers},
    {R"("dual_scattering": {})", k_picture},     {R"("shade_strands": {"point_px": 8})", k_picture},
    {R"("cull_strands": {"wanted": false})", 0}, {R"("strands_in_sight": {"wanted": false})", 0}};

/// Shadow methods with kernels, solvers and effects: all that are registered.
std::vector<std::string> methods() {
  std::vector<std::string> names;
  for (const registry::Entry* method : catalogue().methods)
    if (shadows::find_gpu_method(method->name)) names.emplace_back(method->name);
  return names;
}
std::vector<std::string> names_of(std::span<const registry::Entry* const> entries) {
  std::vector<std::string> names;
  for (const registry::Entry* entry : entries) names.emplace_back(entry->name);
  return names;
}
/// What a solver refuses, and what exclude each other (README of the effect); "cloth" moves fins wherever there are
/// any.
bool go_together(std::string_view solver, const std::vector<std::string>& effects, std::string_view effect) {
  const auto has = [&](std::string_view other) { return std::ranges::find(effects, other) != effects.end(); };
  const bool pushes_strands = effect == "strand_interaction" || effect == "clumping";
  if (effect == "sleep" && (solver == "classic" || has("strand_interaction") || has("clumping"))) return false;
  return !(pushes_strands && (solver == "classic" || has("sleep"))) && effect != "cloth";
}

struct RandomScene {
  std::vector<Part> parts;
  std::string solver, solve_on = "auto", shadow, draw;  ///< empty: none
  bool by_formulas = false;                             ///< the material, in place of tables
  std::vector<std::string> effects;
  std::vector<Part> passes;

  std::string simulation() const {
    if (solver.empty()) return {};
    std::vector<std::string> blocks;
    for (const std::string& effect : effects) blocks.push_back(fmt::format(R"("{}": {{}})", effect));
    return fmt::format(R"(, "simulation": {{"solver": {{"{}": {{}}}}, "effects": {{{}}}, "solve_on": "{}"}})", solver,
                       fmt::join(blocks, ", "), solve_on);
  }
  std::string text() const {
    std::string text = fmt::format(
        R"({{"schema_version": 1, "strand_count": 200, "strand_vertices": 8,
      "material": {{{}}}, "camera": {{"position_m": [0.2, 0.15, 1.1], "target_m": [0.1, 0.05, 0],
      "fov_deg": 20, "resolution_px": [32, 32]}}, "render": {{"method": "{}"}})",
        by_formulas ? R"("model": {"kajiya_kay": {}}, "evaluate": "direct")" : R"("lut_size": 16, "layout": "nalu")",
        draw);
    for (const Part& part : parts) text += fmt::format(", {}", part.text);
    text += simulation();
    if (!shadow.empty()) text += fmt::format(R"(, "shadow": {{"method": {{"{}": {{}}}}}})", shadow);
    std::vector<std::string_view> blocks;
    for (const Part& pass : passes) blocks.push_back(pass.text);
    return text + fmt::format(R"(, "passes": {{{}}}}})", fmt::join(blocks, ", "));
  }
  std::size_t things() const {
    return parts.size() + passes.size() + effects.size() + !solver.empty() + !shadow.empty();
  }
  void add_effect(const std::string& effect) {
    if (!solver.empty() && go_together(solver, effects, effect)) effects.push_back(effect);
  }
};
/// Takes a thing out; gives the results that this may change.
unsigned take_out(RandomScene& scene, std::size_t thing) {
  for (std::vector<Part>* list : {&scene.parts, &scene.passes}) {
    if (thing < list->size()) {
      const unsigned changes = (*list)[thing].changes;
      list->erase(list->begin() + std::ptrdiff_t(thing));
      return changes;
    }
    thing -= list->size();
  }
  if (thing < scene.effects.size()) {
    scene.effects.erase(scene.effects.begin() + std::ptrdiff_t(thing));
    return k_all;
  }
  thing -= scene.effects.size();
  const bool shadow_is_out = scene.solver.empty() || thing == 1;
  (shadow_is_out ? scene.shadow : scene.solver).clear();
  if (scene.solver.empty()) scene.effects.clear();
  return shadow_is_out ? k_seen : k_all;
}

RandomScene scene_by_chance(std::mt19937& chance) {
  const auto coin = [&] { return (chance() >> 7 & 1) == 1; };
  const auto one_of = [&](const std::vector<std::string>& names) { return names[chance() % names.size()]; };
  RandomScene scene;
  for (const Part& part : k_parts)
    if (coin()) scene.parts.push_back(part);
  if (coin()) scene.shadow = one_of(methods());
  if (coin()) scene.solver = one_of(names_of(catalogue().solvers));
  if (coin()) scene.solve_on = "device";
  for (const std::string& effect : names_of(catalogue().effects))
    if (coin()) scene.add_effect(effect);
  scene.draw = k_draws[chance() % std::size(k_draws)];
  scene.by_formulas = scene.draw == "tiles" && coin();
  for (const Part& pass : k_passes)
    if (coin() && coin()) scene.passes.push_back(pass);
  return scene;
}

/// Strands of a file, which are drawn as they are.
Part strands_of_a_file() {
  static const std::string text = [] {
    strands::Groom groom;
    for (int s = 0; s < 40; ++s) {
      for (int i = 0; i < 8; ++i)
        groom.positions.emplace_back(0.06f + 0.002f * float(s), 0.1f - 0.015f * float(i), 0.001f * float(s % 5));
      groom.offsets.push_back(std::uint32_t(groom.positions.size()));
    }
    groom.radii.assign(groom.positions.size(), strands::k_default_radius);
    const std::string path = CUTICLE_BINARY_DIR "/random_scenes_gpu_test.npz";
    EXPECT_TRUE(strands::write_groom(path, groom));
    return fmt::format(R"("groom": {{"file": "{}", "metres_per_unit": 1}})", path);
  }();
  return {text, k_all};
}

/// What has a place in no scene of the others.
RandomScene scene_of_a_file() {
  RandomScene scene;
  scene.parts = {k_parts[0], k_parts[1], strands_of_a_file()};
  scene.solver = "exact";
  scene.solve_on = "device";
  scene.effects = {"gravity", "strand_interaction"};
  scene.draw = "quads";
  scene.passes = {k_passes[4], k_passes[5]};  // temporal anti-aliasing, velocity
  return scene;
}

/// As few scenes as have every shadow method, and with them every solver, effect and pass: one of each, in turns.
std::vector<RandomScene> scenes_of_all() {
  const std::vector<std::string> solvers = names_of(catalogue().solvers), effects = names_of(catalogue().effects);
  std::vector<RandomScene> scenes;
  for (const std::string& method : methods()) {
    const std::size_t k = scenes.size();
    RandomScene scene;
    scene.parts = {k_parts[0], k_parts[5]};  // light, colliders
    for (const std::size_t part : {1 + k % 4, 6 + k % 3})
      if (part < std::size(k_parts)) scene.parts.push_back(k_parts[part]);
    scene.shadow = method;
    scene.solver = solvers[k % solvers.size()];
    scene.solve_on = k % 4 == 3 ? "auto" : "device";
    for (std::size_t i = 0; i < 4; ++i) scene.add_effect(effects[(4 * k + i) % effects.size()]);
    scene.draw = k_draws[(k + 2) % std::size(k_draws)];
    scene.by_formulas = scene.draw == "tiles" && k % 8 == 0;
    for (std::size_t i = 0; i < 3; ++i) scene.passes.push_back(k_passes[(3 * k + i) % 8]);
    scenes.push_back(scene);
  }
  scenes.push_back(scene_of_a_file());
  return scenes;
}

std::unique_ptr<FrameRunner> runner_of(const std::string& text) {
  const auto scene = scene::parse_scene(text, CUTICLE_SOURCE_DIR "/scenes", "chance", catalogue());
  EXPECT_TRUE(scene) << text;
  auto made = FrameRunner::create(device(), *scene, silent_progress());
  EXPECT_TRUE(made) << text << (made ? "" : made.error().message);
  return made ? std::move(*made) : nullptr;
}

/// All demands of what is planned hold; what is left out says why: a demand that does not hold, another choice of the
/// scene's, or that nobody reads its results.
void expect_demanded(const Plan& plan) {
  for (const PlannedPass& pass : plan.passes)
    EXPECT_TRUE(registry::judge(*pass.entry, plan.facts).demanded) << pass.entry->name;
  for (const LeftOut& left : plan.left_out) {
    const registry::Verdict verdict = registry::judge(*left.entry, plan.facts);
    EXPECT_FALSE(left.reason.empty()) << left.entry->name;
    EXPECT_TRUE(verdict.demanded || verdict.reason == left.reason) << left.entry->name << ": " << left.reason;
    EXPECT_FALSE(find_pass(plan, left.entry->name) && left.entry->name != "supersampled") << left.entry->name;
  }
}

void expect_dispatched_as_planned(const FrameRunner& runner, const FrameResult& frame) {
  for (const FramePass& pass : runner.frame_plan().passes) {
    std::uint32_t dispatches = 0, draws = 0;
    for (const gpu::PassCost& cost : frame.cost.passes)
      if (cost.name == pass.pass->entry->name) {
        dispatches += cost.dispatches;
        draws += cost.draws;
      }
    EXPECT_EQ(dispatches, pass.dispatches()) << pass.pass->entry->name << ", frame " << runner.frame_plan().frame;
    EXPECT_EQ(draws, pass.draws()) << pass.pass->entry->name << ", frame " << runner.frame_plan().frame;
  }
  for (const gpu::PassCost& cost : frame.cost.passes)
    EXPECT_TRUE(find_pass(runner.plan(), cost.name)) << cost.name << " runs without a plan";
}

std::size_t together(const FrameRunner& runner) {
  std::size_t bytes = 0;
  for (const auto& [name, held] : runner.memory()) bytes += held;
  return bytes;
}

void expect_as_planned(const RandomScene& scene, std::set<std::string_view>& planned) {
  SCOPED_TRACE(scene.text());
  const std::size_t before = device()->allocated_bytes();
  const auto runner = runner_of(scene.text());
  ASSERT_TRUE(runner);
  expect_demanded(runner->plan());
  for (const PlannedPass& pass : runner->plan().passes) planned.insert(pass.entry->name);
  for (int frame = 0; frame < 2; ++frame) {
    const FrameResult result = frame_of(*runner, frame);
    if (result.repeats == 0) expect_dispatched_as_planned(*runner, result);
    EXPECT_EQ(together(*runner), device()->allocated_bytes() - before);
  }
}

std::vector<FrameResult> frames_of(const std::string& text) {
  std::vector<FrameResult> frames;
  const auto runner = runner_of(text);
  for (int frame = 0; frame < 2; ++frame) frames.push_back(frame_of(*runner, frame));
  return frames;
}

/// What each pixel sees, without the colour that stands before it in the same picture.
std::vector<float> layers_of(const FrameResult& frame) {
  const Image& all = frame.aovs;
  const auto colours = std::size_t(frame.color.channels());
  std::vector<float> layers;
  for (std::size_t k = 0; k < all.pixels.size(); ++k)
    if (k % std::size_t(all.channels()) >= colours) layers.push_back(all.pixels[k]);
  return layers;
}

/// Returns how many results were compared.
int expect_rest_unchanged(const RandomScene& scene, std::mt19937& chance) {
  if (scene.things() == 0) return 0;
  RandomScene less = scene;
  const unsigned changes = take_out(less, chance() % scene.things());
  SCOPED_TRACE(scene.text() + "\nand\n" + less.text());
  const std::vector<FrameResult> with = frames_of(scene.text()), without = frames_of(less.text());
  for (std::size_t k = 0; k < with.size(); ++k) {
    EXPECT_TRUE((changes & k_places) || with[k].state.positions == without[k].state.positions) << "frame " << k;
    EXPECT_TRUE((changes & k_picture) || with[k].color.pixels == without[k].color.pixels) << "frame " << k;
    EXPECT_TRUE((changes & k_layers) || layers_of(with[k]) == layers_of(without[k])) << "frame " << k;
  }
  return 3 - std::popcount(changes);
}

int scenes() { return std::getenv("CUTICLE_SWEEPS") ? 60 : 4; }

/// What needs a character's file, which is not in the repository, or draws and shadows on the CPU.
constexpr std::string_view k_elsewhere[] = {"carry", "skin", "supersampled", "reference", "none", "truth"};

TEST(RandomScenes, Each_RunsWhatItsFactsDemand) {
  std::mt19937 chance(7);
  std::set<std::string_view> planned;
  for (const RandomScene& scene : scenes_of_all()) expect_as_planned(scene, planned);
  for (const auto& entries : {catalogue().solvers, catalogue().effects, catalogue().methods, catalogue().passes})
    for (const registry::Entry* entry : entries)
      EXPECT_TRUE(planned.contains(entry->name) || std::ranges::find(k_elsewhere, entry->name) != std::end(k_elsewhere))
          << entry->name << " ran in no scene";
  for (int k = 0; k < scenes() / 2; ++k) expect_as_planned(scene_by_chance(chance), planned);
}

TEST(RandomScenes, ThingTakenOut_LeavesTheRestBitForBit) {
  std::mt19937 chance(11);
  int compared = 0;
  for (int k = 0; k < scenes(); ++k) compared += expect_rest_unchanged(scene_by_chance(chance), chance);
  EXPECT_GT(compared, 1);
}

}  // namespace
}  // namespace cuticle::plan::random_scenes_gpu_test
