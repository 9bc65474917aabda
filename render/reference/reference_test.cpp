// The path tracer: one fibre, furnaces, energy, the same bits whatever the threads, going on from a state.
#include <filesystem>
#include <numbers>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "render/reference/test_scenes.h"

namespace cuticle::render::reference::reference_test {
namespace {

TEST(Reference, Layers_EachWayToSplitSumsToTheWhole) {
  const Picture picture = picture_of(lit_ball(), {.layers = true}, {.samples = 8});
  const auto at = [&](std::string_view name) {
    const auto& names = picture.layers.channel_names;
    const auto found = std::ranges::find(names, name);
    EXPECT_NE(found, names.end()) << name;
    return std::size_t(found - names.begin());
  };
  const auto sum = [&](std::initializer_list<const char*> names) {
    double total = 0;
    for (const char* name : names)
      for (std::size_t p = at(std::string(name) + ".R"); p < picture.layers.pixels.size();
           p += std::size_t(picture.layers.channels()))
        total += double(picture.layers.pixels[p]);
    return total;
  };
  double whole = 0;
  for (std::size_t p = 0; p < picture.color.pixels.size(); p += 4) whole += double(picture.color.pixels[p]);
  const double counted = sum(
      {"scatterings_1", "scatterings_2", "scatterings_3", "scatterings_4_7", "scatterings_8_15", "scatterings_16_on"});
  EXPECT_NEAR(counted / whole, 1, 1e-5);
  EXPECT_NEAR(sum({"single", "multiple_forward", "multiple_backward", "multiple_other"}) / whole, 1, 1e-5);
  EXPECT_NEAR(sum({"lobe_R", "lobe_TT", "lobe_TRT", "lobe_residual"}) / whole, 1, 1e-4);
  EXPECT_GT(sum({"scatterings_16_on"}), 0);
  EXPECT_NEAR(sum({"scatterings_1"}), sum({"single"}), 1e-6 * whole);
  const Picture direct = picture_of(lit_ball(), {.scatterings = 1}, {.samples = 8});
  double single = 0;
  for (std::size_t p = 0; p < direct.color.pixels.size(); p += 4) single += double(direct.color.pixels[p]);
  EXPECT_NEAR(single / sum({"single"}), 1, 1e-6);
}

TEST(Reference, AnyNumberOfThreads_SameBits) {
  const TracedScene scene = lit_ball();
  std::vector<Picture> pictures;
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
    pictures.push_back(picture_of(scene, {.layers = true}, {.samples = 12}));
  }
  EXPECT_EQ(pictures[0].layers.pixels, pictures[1].layers.pixels);
}

TEST(Reference, AnotherSeed_OtherPictureOfTheSameLight) {
  const Picture a = picture_of(lit_ball(), {}, {.samples = 16}),
                b = picture_of(lit_ball(), {.seed = 1}, {.samples = 16});
  const Mean of_a = mean_where_covered(a), of_b = mean_where_covered(b);
  EXPECT_NE(a.color.pixels, b.color.pixels);
  EXPECT_NEAR(of_a.color.x, of_b.color.x, 4 * (of_a.error.x + of_b.error.x));
}

TEST(Reference, SeveralSeedsAtOnce_ThePicturesOfEachAlone) {
  TraceOptions options{.scatterings = 2, .tables = TablesInstead{"nalu", 16}};
  const std::uint64_t seeds[] = {3, 0};
  const auto pictures = trace_pictures(lit_ball(), options, {.samples = 8}, seeds, silent_progress());
  ASSERT_TRUE(pictures);
  for (std::size_t k = 0; k < 2; ++k) {
    options.seed = seeds[k];
    EXPECT_EQ((*pictures)[k].color.pixels, picture_of(lit_ball(), options, {.samples = 8}).color.pixels);
  }
}

struct StateFile {
  std::string path = (std::filesystem::temp_directory_path() /
                      fmt::format("cuticle_reference_{}_{}", testing::UnitTest::GetInstance()->random_seed(),
                                  testing::UnitTest::GetInstance()->current_test_info()->name()))
                         .string();
  ~StateFile() { std::filesystem::remove(path); }
};

// What a killed render leaves is the state after some round.
TEST(Reference, StoppedAndGoneOnFromItsState_SameBits) {
  const StateFile state;
  const TracedScene scene = lit_ball();
  const Picture whole = picture_of(scene, {.layers = true}, {.samples = 20});
  picture_of(scene, {.layers = true}, {.samples = 8, .state = state.path});
  const Picture resumed = picture_of(scene, {.layers = true}, {.samples = 20, .state = state.path});
  EXPECT_EQ(whole.layers.pixels, resumed.layers.pixels);
}

TEST(Reference, StateOfAnotherScene_IsRefused) {
  const StateFile state;
  TracedScene scene = lit_ball();
  picture_of(scene, {}, {.samples = 1, .state = state.path});
  scene.lights[0].irradiance.x += 1e-9;
  const auto refused = trace_picture(scene, {}, {.samples = 2, .state = state.path}, silent_progress());
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, testing::HasSubstr("another scene"));
}

TEST(Reference, StateCutShort_IsRefused) {
  const StateFile state;
  const TracedScene scene = lit_ball();
  picture_of(scene, {}, {.samples = 1, .state = state.path});
  for (const std::uintmax_t size :
       {std::filesystem::file_size(state.path) - 1, std::uintmax_t(20), std::uintmax_t(0)}) {
    std::filesystem::resize_file(state.path, size);
    EXPECT_FALSE(trace_picture(scene, {}, {.samples = 2, .state = state.path}, silent_progress()).ok()) << size;
  }
}

TEST(Reference, ErrorAskedFor_IsMetWithFewerSamplesWhereItIsEasy) {
  const Picture picture = picture_of(lit_ball(), {.scatterings = 1}, {.samples = 512, .max_error = 0.3});
  EXPECT_LT(picture.samples, 512);
  EXPECT_GT(picture.samples, 15);
  EXPECT_LT(picture.error, 0.32);
}

// A point light far away is a distant light.
TEST(Reference, PointLightFarAway_LightsAsADistantLight) {
  TracedScene scene = lit_ball();
  scene.lights.resize(1);
  const Mean distant = mean_where_covered(picture_of(scene, {.scatterings = 2}, {.samples = 8}));
  const double away = 1000;
  scene.lights[0].point_light =
      PointLight{.position = away * scene.lights[0].to_light, .intensity = glm::dvec3(3 * away * away)};
  const Mean point_light = mean_where_covered(picture_of(scene, {.scatterings = 2}, {.samples = 8}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(point_light.color[c] / distant.color[c], 1, 2e-3);
}

// The limit holds for each path, and leaves direct light alone.
TEST(Reference, ClampIndirect_LimitsWhatScatteredMoreThanOnce) {
  const TracedScene scene = lit_ball();
  const Picture free = picture_of(scene, {.layers = true}, {.samples = 1});
  const Picture limited = picture_of(scene, {.layers = true, .clamp_indirect = 0.01}, {.samples = 1});
  const auto& names = free.layers.channel_names;
  const auto channel = std::size_t(std::ranges::find(names, "scatterings_1.G") - names.begin());
  double without = 0, with = 0;
  for (std::size_t p = 0; p < free.layers.pixels.size(); p += names.size()) {
    EXPECT_EQ(free.layers.pixels[p + channel], limited.layers.pixels[p + channel]);
    without += double(free.layers.pixels[p + 1]), with += double(limited.layers.pixels[p + 1]);
  }
  EXPECT_LT(with, 0.95 * without);
  EXPECT_GT(with, 0.1 * without);
}

// A diffuse sphere in even surroundings is as bright as its albedo, seen from outside, where nothing else is.
TEST(Reference, DiffuseSurface_IsAsBrightAsItsAlbedo) {
  TracedScene scene = lit_ball();
  scene.hair = {};
  scene.lights.clear();
  scene.surroundings = white();
  Surface floor;
  floor.mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};
  floor.mesh.normals.assign(4, glm::vec3(0, 0, 1));
  floor.mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  floor.albedo.assign(4, glm::vec3(0.2f, 0.5f, 0.9f));
  scene.surfaces = {floor};
  const Mean mean = mean_where_covered(picture_of(scene, {}, {.samples = 32}));
  const glm::dvec3 albedo(0.2, 0.5, 0.9);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.color[c], albedo[c], 1e-3 + 4 * mean.error[c]);
  EXPECT_EQ(mean.coverage, 576);
}

TEST(Reference, NoHair_IsBlack) {
  TracedScene scene = lit_ball();
  scene.hair = {};
  for (const float value : picture_of(scene, {}, {.samples = 1}).color.pixels) EXPECT_EQ(value, 0);
}

TEST(Reference, LensOfNoWidth_IsAPinhole) {
  TracedScene scene = lit_ball();
  const Picture sharp = picture_of(scene, {.scatterings = 1}, {.samples = 4});
  const Picture blurred = picture_of(scene, {.scatterings = 1, .lens = {0.02, 0.8}}, {.samples = 4});
  const Picture focused = picture_of(scene, {.scatterings = 1, .lens = {0, 0.8}}, {.samples = 4});
  EXPECT_EQ(sharp.color.pixels, focused.color.pixels);
  EXPECT_NE(sharp.color.pixels, blurred.color.pixels);
}

}  // namespace
}  // namespace cuticle::render::reference::reference_test
