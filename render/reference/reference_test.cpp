// The path tracer: one fibre, furnaces, energy, the same bits whatever the threads, going on from a state.
#include "render/reference/reference.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace cuticle::render::reference::reference_test {
namespace {

constexpr const char* k_clear = "sigma_a=0,beta_m=0.3,beta_n=0.3,alpha=0";

Surroundings white() {
  Surroundings surroundings{make_image(2, 1, {"R", "G", "B"})};
  for (float& value : surroundings.picture.pixels) value = 1;
  return surroundings;
}

TracedScene scene_of(std::string_view model, std::string_view settings) {
  TracedScene scene;
  scene.model = bsdf::find_model(model).value();
  scene.values = bsdf::parse_settings(*scene.model, "", settings).value();
  scene.camera.position = {0, 0, 1};
  scene.camera.resolution = {24, 24};
  return scene;
}

/// Straight fibres across a ball of 5 cm.
strands::Groom ball(int count, float radius) {
  std::mt19937 random(9);
  std::normal_distribution<float> normal;
  strands::Groom hair;
  for (int s = 0; s < count; ++s) {
    const glm::vec3 middle = 0.02f * glm::vec3(normal(random), normal(random), normal(random));
    const glm::vec3 along = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    for (int k = -2; k <= 2; ++k) hair.positions.push_back(middle + 0.012f * float(k) * along);
    hair.offsets.push_back(std::uint32_t(hair.positions.size()));
  }
  hair.radii.assign(hair.positions.size(), radius);
  return hair;
}

/// One fibre along x, seen across all of its width and a little more.
TracedScene one_fibre(std::string_view model, std::string_view settings) {
  TracedScene scene = scene_of(model, settings);
  scene.hair.positions = {{-1, 0, 0}, {1, 0, 0}};
  scene.hair.radii = {1e-2f, 1e-2f};
  scene.hair.offsets = {0, 2};
  scene.camera.vertical_field_of_view = 0.03;
  return scene;
}

Picture picture_of(const TracedScene& scene, const TraceOptions& options, const Quality& quality) {
  auto picture = trace_picture(scene, options, quality, silent_progress());
  EXPECT_TRUE(picture.ok()) << (picture.ok() ? "" : picture.error().message);
  return std::move(picture).value();
}

/// Mean of the colour where hair is, its standard error, and the mean coverage.
struct Mean {
  glm::dvec3 color{0}, error{0};
  double coverage = 0;
};
Mean mean_where_covered(const Picture& picture) {
  Mean mean;
  const Image& image = picture.layers;
  const int channels = image.channels();
  for (std::size_t p = 0; p < image.pixels.size() / std::size_t(channels); ++p) {
    const float* pixel = image.pixels.data() + p * std::size_t(channels);
    mean.coverage += double(pixel[3]);
    for (int c = 0; c < 3; ++c) {
      mean.color[c] += double(pixel[c]);
      mean.error[c] += double(pixel[4 + c]);
    }
  }
  for (int c = 0; c < 3; ++c) {
    mean.color[c] /= mean.coverage;
    mean.error[c] = std::sqrt(mean.error[c]) / mean.coverage;
  }
  return mean;
}

glm::dvec3 far_field(const TracedScene& scene, bsdf::Quantity quantity, const bsdf::Point& at) {
  registry::ParameterValues values = scene.values;
  if (scene.model->entry.name == "chiang") values.set("field", std::string("far"));
  std::vector<glm::dvec3> value(1);
  const bsdf::Request request{quantity, -1, {&at, 1}};
  EXPECT_TRUE(bsdf::evaluate(*scene.model, values, bsdf::Precision::f64, request, value).ok());
  return value[0];
}

struct ModelCase {
  std::string_view model, settings;
};
void PrintTo(const ModelCase& of, std::ostream* out) { *out << of.model; }

class OneFibre : public testing::TestWithParam<ModelCase> {};

// L = S E, without a cosine.
TEST_P(OneFibre, DistantLight_MeanOverTheWidthIsTheFarField) {
  TracedScene scene = one_fibre(GetParam().model, GetParam().settings);
  for (const glm::dvec3& to_light : {glm::dvec3(0, 0, 1), glm::dvec3(0.5, 0.7, 0.2), glm::dvec3(-0.3, -0.2, -0.9)}) {
    scene.lights = {{.name = "key", .to_light = glm::normalize(to_light), .irradiance = {1, 2, 3}}};
    const Mean mean = mean_where_covered(picture_of(scene, {.scatterings = 1}, {.samples = 64}));
    const glm::dvec3 light = scene.lights[0].to_light;
    const glm::dvec3 s = far_field(scene, bsdf::Quantity::S,
                                   {.theta_i = std::asin(light.x),
                                    .theta_o = 0,
                                    .phi = std::atan2(1.0, 0.0) - std::atan2(light.z, light.y),
                                    .phi_o = std::atan2(1.0, 0.0)});
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean.color[c] / (s[c] * double(c + 1)), 1, 0.02 + 4 * mean.error[c] / mean.color[c]) << c;
  }
}

TEST_P(OneFibre, EvenSurroundings_MeanIsTheAlbedo) {
  TracedScene scene = one_fibre(GetParam().model, GetParam().settings);
  scene.surroundings = white();
  const Mean mean = mean_where_covered(picture_of(scene, {}, {.samples = 64}));
  const glm::dvec3 albedo = far_field(scene, bsdf::Quantity::albedo, {.theta_o = 0, .phi_o = std::numbers::pi / 2});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.color[c], albedo[c], 0.003 + 4 * mean.error[c]) << c;
}

INSTANTIATE_TEST_SUITE_P(Models, OneFibre,
                         testing::Values(ModelCase{"chiang", "sigma_a=0.1/0.3/0.9,beta_m=0.3,beta_n=0.3,alpha=-0.05"},
                                         ModelCase{"marschner", "sigma_a=0.1/0.3/0.9"},
                                         ModelCase{"kajiya_kay", ""}));

struct Furnace {
  std::string_view model, settings;
  int fibres;
};
void PrintTo(const Furnace& of, std::ostream* out) { *out << of.model << " " << of.fibres; }
class Furnaces : public testing::TestWithParam<Furnace> {};

// Hair that absorbs nothing cannot be told from the surroundings.
TEST_P(Furnaces, DenseBall_IsInvisibleWithinThreeStandardErrors) {
  TracedScene scene = scene_of(GetParam().model, GetParam().settings);
  scene.hair = ball(GetParam().fibres, 4e-4f);
  scene.surroundings = white();
  scene.camera.vertical_field_of_view = 0.08;
  const Mean mean = mean_where_covered(picture_of(scene, {}, {.samples = 16}));
  EXPECT_GT(mean.error.y, 0);
  EXPECT_NEAR(mean.color.y, 1, 3 * mean.error.y) << "standard error " << mean.error.y;
  std::printf("%s, %d fibres: %.4f +- %.4f, coverage %.2f\n", GetParam().model.data(), GetParam().fibres, mean.color.y,
              mean.error.y, mean.coverage / 576);
}

INSTANTIATE_TEST_SUITE_P(Densities, Furnaces,
                         testing::Values(Furnace{"chiang", k_clear, 100}, Furnace{"chiang", k_clear, 1000},
                                         Furnace{"chiang", k_clear, 6000},
                                         Furnace{"chiang", "sigma_a=0,beta_m=0.15,beta_n=0.2,alpha=-0.05", 1000}));

TracedScene lit_ball() {
  TracedScene scene = scene_of("chiang", "sigma_a=0.06/0.1/0.2,beta_m=0.3,beta_n=0.3,alpha=0");
  scene.hair = ball(1000, 4e-4f);
  scene.lights = {{.name = "key", .to_light = glm::normalize(glm::dvec3(1, 1, 1)), .irradiance = {3, 3, 3}},
                  {.name = "rim", .to_light = {0, 0, -1}, .irradiance = {1, 2, 1}}};
  scene.camera.vertical_field_of_view = 0.08;
  return scene;
}

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
  const double counted = sum({"scatterings_1", "scatterings_2", "scatterings_3", "scatterings_4_7", "scatterings_8_15",
                              "scatterings_16_on"});
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
  const Picture a = picture_of(lit_ball(), {}, {.samples = 16}), b = picture_of(lit_ball(), {.seed = 1}, {.samples = 16});
  const Mean of_a = mean_where_covered(a), of_b = mean_where_covered(b);
  EXPECT_NE(a.color.pixels, b.color.pixels);
  EXPECT_NEAR(of_a.color.x, of_b.color.x, 4 * (of_a.error.x + of_b.error.x));
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
  for (const std::uintmax_t size : {std::filesystem::file_size(state.path) - 1, std::uintmax_t(20), std::uintmax_t(0)}) {
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

// A lamp far away is a distant light.
TEST(Reference, LampFarAway_LightsAsADistantLight) {
  TracedScene scene = lit_ball();
  scene.lights.resize(1);
  const Mean distant = mean_where_covered(picture_of(scene, {.scatterings = 2}, {.samples = 8}));
  const double away = 1000;
  scene.lights[0].lamp = Lamp{.position = away * scene.lights[0].to_light, .intensity = glm::dvec3(3 * away * away)};
  const Mean lamp = mean_where_covered(picture_of(scene, {.scatterings = 2}, {.samples = 8}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(lamp.color[c] / distant.color[c], 1, 2e-3);
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
