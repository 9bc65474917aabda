// Scenes put together by chance: what runs is what their facts demand, no more and no less, with the dispatches and the
// memory that the plan says; taking a thing out leaves all results that
// do not depend on it, bit for bit.
#include "tests/support/small_frames.h"

#include <bit>
#include <cstdlib>
#include <random>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

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
    {R"("simulation": {"solver": {"classic": {}}, "effects": {"gravity": {}, "colliders": {}}})", k_all},
};
constexpr std::string_view k_methods[] = {"opacity_map", "deep_opacity", "shadow_map", "moments", "fourier", "voxel"};
constexpr std::string_view k_draws[] = {"lines", "quads", "tiles", "cards"};
/// Temporal anti-aliasing moves the camera by parts of a pixel; motion blur and lenses are laid over the picture.
constexpr Part k_passes[] = {{"surface_shadow", k_seen},
                             {"ambient_occlusion", k_picture},
                             {"depth_of_field", k_picture},
                             {"motion_blur", k_picture},
                             {"temporal_antialiasing", k_seen}};

struct RandomScene {
  std::vector<Part> parts;
  std::string shadow, draw;
  std::vector<Part> passes;

  std::string text() const {
    std::string text = fmt::format(R"({{"schema_version": 1, "strand_count": 200, "strand_vertices": 8,
      "material": {{"lut_size": 16, "layout": "nalu"}}, "camera": {{"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0],
      "fov_deg": 30, "resolution_px": [32, 32]}}, "render": {{"method": "{}"}})",
                                   draw);
    for (const Part& part : parts) text += fmt::format(", {}", part.text);
    if (!shadow.empty()) text += fmt::format(R"(, "shadow": {{"method": {{"{}": {{}}}}}})", shadow);
    std::vector<std::string> blocks;
    for (const Part& pass : passes) blocks.push_back(fmt::format(R"("{}": {{}})", pass.text));
    return text + fmt::format(R"(, "passes": {{{}}}}})", fmt::join(blocks, ", "));
  }
  std::size_t things() const { return parts.size() + passes.size() + !shadow.empty(); }
};
/// Takes a thing out; gives the results that this may change.
unsigned take_out(RandomScene& scene, std::size_t thing) {
  const auto from = [](std::vector<Part>& list, std::size_t at) {
    const unsigned changes = list[at].changes;
    list.erase(list.begin() + std::ptrdiff_t(at));
    return changes;
  };
  if (thing < scene.parts.size()) return from(scene.parts, thing);
  if (thing - scene.parts.size() < scene.passes.size()) return from(scene.passes, thing - scene.parts.size());
  scene.shadow.clear();
  return k_seen;
}

RandomScene scene_by_chance(std::mt19937& chance) {
  const auto coin = [&] { return (chance() >> 7 & 1) == 1; };
  RandomScene scene;
  for (const Part& part : k_parts)
    if (coin()) scene.parts.push_back(part);
  if (coin()) scene.shadow = k_methods[chance() % std::size(k_methods)];
  scene.draw = k_draws[chance() % std::size(k_draws)];
  for (const Part& pass : k_passes)
    if (coin() && coin()) scene.passes.push_back(pass);
  return scene;
}

std::unique_ptr<FrameRunner> runner_of(const std::string& text) {
  const auto scene = scene::parse_scene(text, CUTICLE_SOURCE_DIR "/scenes", "chance", catalogue());
  EXPECT_TRUE(scene) << text;
  auto made = FrameRunner::create(test_device(), *scene, silent_progress());
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
    EXPECT_FALSE(find_pass(plan, left.entry->name) && left.entry->name != "truth") << left.entry->name;
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

void expect_as_planned(const RandomScene& scene) {
  SCOPED_TRACE(scene.text());
  const std::size_t before = test_device()->allocated_bytes();
  const auto runner = runner_of(scene.text());
  ASSERT_TRUE(runner);
  expect_demanded(runner->plan());
  for (int frame = 0; frame < 3; ++frame) {
    const FrameResult result = frame_of(*runner, frame);
    if (result.repeats == 0) expect_dispatched_as_planned(*runner, result);
    EXPECT_EQ(together(*runner), test_device()->allocated_bytes() - before);
  }
}

std::vector<FrameResult> frames_of(const std::string& text) {
  std::vector<FrameResult> frames;
  const auto runner = runner_of(text);
  for (int frame = 0; frame < 2; ++frame) frames.push_back(frame_of(*runner, frame));
  return frames;
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
    EXPECT_TRUE((changes & k_layers) || with[k].aovs.pixels == without[k].aovs.pixels) << "frame " << k;
  }
  return 3 - std::popcount(changes);
}

int scenes() { return std::getenv("CUTICLE_SWEEPS") ? 60 : 6; }

TEST(RandomScenes, Each_RunsWhatItsFactsDemand) {
  std::mt19937 chance(7);
  for (int k = 0; k < scenes(); ++k) expect_as_planned(scene_by_chance(chance));
}

TEST(RandomScenes, ThingTakenOut_LeavesTheRestBitForBit) {
  std::mt19937 chance(11);
  int compared = 0;
  for (int k = 0; k < scenes() / 2; ++k) compared += expect_rest_unchanged(scene_by_chance(chance), chance);
  EXPECT_GT(compared, 1);
}

}  // namespace
}  // namespace cuticle::plan::random_scenes_gpu_test
