// N15: a running scene whose model gets other parameters: its frames are those of a new runner, by what it has made.
#include <functional>

#include <fmt/core.h>

#include "core/wall_clock.h"
#include "tests/support/small_frames.h"

namespace cuticle::plan::changed_material_gpu_test {
namespace {

using namespace tests;

constexpr std::string_view k_dual = R"("passes": {"dual_scattering": {}})";

/// Of marschner, with these parameters.
std::string material(const std::string& parameters, const std::string& more = "") {
  return fmt::format(R"("material": {{"model": {{"marschner": {{{}}}}}, "lut_size": 32{}}})", parameters, more);
}
const std::string k_first = R"("sigma_a": [0.2, 0.4, 0.8])",
                  k_second = R"("sigma_a": [2, 0.5, 0.1], "eta": 1.4, "alpha": -0.07, "beta": 0.2)";

struct Way {
  std::string name, parts, of_material;
};
const Way k_ways[] = {{"lines", std::string(k_lines), ""},
                      {"lines, layout nalu", std::string(k_lines), R"(, "layout": "nalu")"},
                      {"quads", std::string(k_quads), ""},
                      {"cards", std::string(k_cards), ""},
                      {"tiles", std::string(k_tiles), ""},
                      {"tiles, evaluated", std::string(k_tiles), R"(, "evaluate": "direct")"},
                      {"tiles, dual scattering", std::string(k_tiles) + ", " + std::string(k_dual), ""},
                      {"cards, dual scattering", std::string(k_cards) + ", " + std::string(k_dual), ""}};

scene::Scene scene_by(const Way& way, const std::string& parameters) {
  return scene_of({k_light, k_shadow, way.parts, material(parameters, way.of_material)});
}

std::unique_ptr<FrameRunner> runner_of(const scene::Scene& scene) {
  auto made = FrameRunner::create(device(), scene, silent_progress());
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return std::move(*made);
}

double largest(const std::vector<float>& values) { return double(*std::ranges::max_element(values)); }

}  // namespace

TEST(ChangedMaterial, EveryWayOfDrawing_IsThatOfANewRunner) {
  for (const Way& way : k_ways) {
    const auto changed = runner_of(scene_by(way, k_first)), anew = runner_of(scene_by(way, k_second));
    const std::vector<float> first = frame_of(*changed, 0).color.pixels;
    ASSERT_TRUE(changed->change(scene_by(way, k_second), silent_progress())) << way.name;
    const FrameResult second = frame_of(*changed, 1);
    frame_of(*anew, 0);
    const FrameResult expected = frame_of(*anew, 1);
    EXPECT_EQ(second.color.pixels, expected.color.pixels) << way.name;
    EXPECT_NE(second.color.pixels, first) << way.name;
    EXPECT_GT(largest(second.color.pixels), 0.01) << way.name;
    EXPECT_EQ(changed->tables().values, anew->tables().values) << way.name;
  }
}

TEST(ChangedMaterial, Parameters_AreTakenInLessTimeThanAPictureIsMade) {
  const Way& way = k_ways[4];
  const auto runner = runner_of(scene_by(way, k_first));
  const auto least_ms = [&](const std::function<scene::Scene(int)>& next) {
    double least = 1e9;
    for (int k = 0; k < 4; ++k) {
      const auto begin = std::chrono::steady_clock::now();
      EXPECT_TRUE(runner->change(next(k), silent_progress()));
      least = std::min(least, milliseconds_since(begin));
    }
    return least;
  };
  const double kept = least_ms([&](int k) { return scene_by(way, k % 2 ? k_first : k_second); });
  const double made = least_ms([&](int k) {
    scene::Scene next = scene_by(way, k % 2 ? k_first : k_second);
    next.material.lut_size = 33 + k % 2;
    return next;
  });
  fmt::print("parameters {:.1f} ms, a picture made anew {:.1f} ms\n", kept, made);
  EXPECT_LT(kept, 0.7 * made);
}

TEST(ChangedMaterial, ParametersThatAreRefused_LeaveTheSceneAsItWas) {
  const Way direct{"chiang", std::string(k_tiles), ""};
  const auto scene = [&](const std::string& field) {
    return scene_of({k_light, k_shadow, k_tiles,
                     R"("material": {"evaluate": "direct", "model": {"chiang": {"field": ")" + field + R"("}}})"});
  };
  const auto runner = runner_of(scene("far"));
  const std::vector<float> before = frame_of(*runner, 0).color.pixels;
  const auto refused = runner->change(scene("near"), silent_progress());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(frame_of(*runner, 0).color.pixels, before);
}

}  // namespace cuticle::plan::changed_material_gpu_test
