// Every error of a scene file names source, key and what is allowed; what is given is read, what is absent has its
// default.
#include "scene/scene.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "core/image/image.h"

namespace cuticle::scene::scene_test {
namespace {

using registry::Entry;
using registry::Parameter;
using registry::ParameterType;
using testing::HasSubstr;

constexpr Parameter k_fibre[] = {{"eta", ParameterType::real, "1", 1.05, 3, "1.55", {}, "index"},
                                 {"sigma_a", ParameterType::rgb, "1", 0, 100, "0.2", {}, "absorption"}};
constexpr Parameter k_slices[] = {{"slices", ParameterType::integer, "1", 2, 256, "16", {}, "slices"}};

Entry named(std::string_view name, registry::ParameterTable table = {}) {
  Entry entry;
  entry.name = name;
  entry.parameters = table;
  return entry;
}
Entry distant_method() {
  static constexpr std::string_view k_demands[] = {"distant_lights"};
  Entry entry = named("distant");
  entry.demands = k_demands;
  return entry;
}
const Entry k_distant_method = distant_method();
const Entry k_model = named("marschner", k_fibre), k_layout = named("nalu"), k_solver = named("classic"),
            k_gravity = named("gravity"), k_method = named("opacity_map", k_slices), k_pass = named("lines");

Catalogue catalogue() {
  Catalogue entries;
  entries.models = {&k_model};
  entries.layouts = {&k_layout};
  entries.solvers = {&k_solver};
  entries.effects = {&k_gravity};
  entries.methods = {&k_method, &k_distant_method};
  entries.passes = {&k_pass};
  return entries;
}

Result<Scene> parsed(const std::string& fields) {
  return parse_scene(fmt::format(R"({{"schema_version": 1{}{}}})", fields.empty() ? "" : ", ", fields), "/", "s.json",
                     catalogue());
}

void expect_refused(const std::string& fields, std::initializer_list<const char*> words) {
  const auto scene = parsed(fields);
  ASSERT_FALSE(scene) << fields;
  EXPECT_EQ(scene.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(scene.error().message, HasSubstr("s.json"));
  for (const char* word : words) EXPECT_THAT(scene.error().message + " | " + scene.error().hint, HasSubstr(word));
}

TEST(Scene, Empty_HasTheDefaults) {
  const auto scene = parsed("");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->strand_count, 4095);
  EXPECT_EQ(scene->strand_vertices, 30);
  EXPECT_EQ(scene->material.model.name, "marschner");
  EXPECT_EQ(scene->material.model.values.real("eta"), 1.55);
  EXPECT_TRUE(scene->head.present);
  EXPECT_TRUE(scene->camera.automatic);
  EXPECT_FALSE(scene->shadow || scene->simulation.solver || scene->motion);
}

TEST(Scene, Degrees_AreReadAsRadians) {
  const auto scene = parsed(R"("camera": {"fov_deg": 90, "position_m": [0, 0, 2]})");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_NEAR(scene->camera.camera.vertical_field_of_view, 1.5707963267948966, 1e-15);
  EXPECT_FALSE(scene->camera.automatic);
}

TEST(Scene, DirectionToLight_IsNormalised) {
  const auto scene = parsed(R"("lights": [{"to_light": [0, 3, 4], "irradiance": [1, 2, 3]}])");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_LT(glm::distance(scene->lights[0].to_light, glm::dvec3(0, 0.6, 0.8)), 1e-15);
  EXPECT_EQ(scene->lights[0].irradiance, glm::dvec3(1, 2, 3));
}

TEST(Scene, Blocks_CarryTheirParametersAndDefaults) {
  const auto scene = parsed(R"("material": {"model": {"marschner": {"sigma_a": [0.1, 0.2, 0.3]}}},
    "shadow": {"method": {"opacity_map": {"slices": 8}}}, "simulation": {"solver": {"classic": {}}, "effects": {"gravity": {}}})");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->material.model.values.rgb("sigma_a"), glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(scene->material.model.values.real("eta"), 1.55);
  EXPECT_EQ(scene->shadow->values.integer("slices"), 8);
  EXPECT_TRUE(scene->simulation.effects.contains("gravity"));
}

TEST(Scene, OpacityOfACrossing_IsOneNumberOrOneAChannel) {
  const auto alpha_of = [](std::string_view alpha) {
    const auto scene =
        parsed(fmt::format(R"("shadow": {{"method": {{"opacity_map": {{}}}}, "fibre_alpha": {}}})", alpha));
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
    return scene && scene->fibre_alpha ? *scene->fibre_alpha : glm::dvec3(-1);
  };
  EXPECT_FALSE(parsed("")->fibre_alpha);
  EXPECT_EQ(alpha_of("0.3"), glm::dvec3(0.3));
  EXPECT_EQ(alpha_of("[0, 0.5, 1]"), glm::dvec3(0, 0.5, 1));
}

TEST(Scene, OpacityOfACrossingOutOfRange_NamesChannelValueAndRange) {
  const auto refused = [](const char* alpha, std::initializer_list<const char*> words) {
    expect_refused(fmt::format(R"("shadow": {{"method": {{"opacity_map": {{}}}}, "fibre_alpha": {}}})", alpha), words);
  };
  refused("1.25", {"shadow.fibre_alpha = 1.25", "0 .. 1"});
  refused("[0.1, -0.5, 0.2]", {"shadow.fibre_alpha[1] = -0.5", "0 .. 1"});
  refused("[0.1, 0.5]", {"shadow.fibre_alpha", "3 numbers", "0 .. 1"});
  refused(R"("dark")", {"shadow.fibre_alpha", "a number or [r, g, b]", "string"});
}

TEST(Scene, UnknownKey_NamesItTheNearestAndAllAllowed) {
  expect_refused(R"("lihgts": [])", {"lihgts", "write 'lights'", "camera"});
  expect_refused(R"("camera": {"fov": 20})", {"camera", "'fov'", "fov_deg"});
}

TEST(Scene, UnknownBlock_NamesTheRegisteredOnes) {
  expect_refused(R"("shadow": {"method": {"opacity_mpa": {}}})", {"shadow.method", "opacity_mpa", "opacity_map"});
  expect_refused(R"("simulation": {"solver": {"classic": {}}, "effects": {"wind": {}}})",
                 {"simulation.effects", "wind", "gravity"});
}

TEST(Scene, BlockWithoutOrWithTwoNames_IsRefused) {
  expect_refused(R"("shadow": {"method": {}})", {"shadow.method", "exactly one", "opacity_map"});
}

TEST(Scene, NumberOutOfRange_NamesKeyValueAndRange) {
  expect_refused(R"("strand_vertices": 1000)", {"strand_vertices", "1000", "2 .. 256"});
  expect_refused(R"("lights": [{"to_light": [0, 1, 0], "irradiance": [1, -2, 1]}])",
                 {"lights[0].irradiance[1]", "-2", "0 .. "});
}

TEST(Scene, ParameterOutOfRange_NamesTheBlockAndTheRange) {
  expect_refused(R"("material": {"model": {"marschner": {"eta": 9}}})",
                 {"material.model.marschner", "eta", "9", "1.05", "3"});
}

TEST(Scene, WrongType_NamesWhatWasExpected) {
  expect_refused(R"("camera": {"fov_deg": "wide"})", {"camera.fov_deg", "a number", "string"});
  expect_refused(R"("strand_count": 10.5)", {"strand_count", "10.5", "whole number"});
  expect_refused(R"("camera": {"position_m": [1, 2]})", {"camera.position_m", "3 numbers"});
  expect_refused(R"("outputs": {"color": 1})", {"outputs.color", "true or false"});
}

TEST(Scene, MissingKey_IsNamed) {
  expect_refused(R"("lights": [{"irradiance": [1, 1, 1]}])", {"lights[0].to_light", "missing"});
  const auto scene = parse_scene("{}", "/", "s.json", catalogue());
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("schema_version"));
}

TEST(Scene, OtherVersion_IsRefused) {
  const auto scene = parse_scene(R"({"schema_version": 2})", "/", "s.json", catalogue());
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("schema_version = 2 is newer than 1"));
}

TEST(Scene, CameraKeys_TakeWhatIsAbsentFromTheKeyAbove) {
  const Scene scene = parsed(R"("camera": {"target_m": [0, 1, 0], "keys": [
      {"time_s": 0, "position_m": [0, 1, 2], "fov_deg": 45}, {"time_s": 2, "target_m": [0, 1.5, 0]}]})")
                          .value();
  ASSERT_EQ(scene.camera.keys.size(), 2u);
  EXPECT_FALSE(scene.camera.automatic);
  EXPECT_EQ(scene.camera.keys[0].target, glm::dvec3(0, 1, 0));
  EXPECT_EQ(scene.camera.keys[1].position, glm::dvec3(0, 1, 2));
  EXPECT_EQ(scene.camera.keys[1].vertical_field_of_view, scene.camera.keys[0].vertical_field_of_view);
}

TEST(Scene, CameraKeysOutOfRange_AreRefused) {
  expect_refused(R"("camera": {"keys": [{"time_s": 0}]})", {"camera.keys[0].position_m", "missing"});
  expect_refused(R"("camera": {"position_m": [0, 0, 1], "keys": [{"time_s": 1}, {"time_s": 0.5}]})",
                 {"camera.keys[1].time_s", "0.5", "order"});
  expect_refused(R"("camera": {"position_m": [0, 0, 1], "keys": [{"time_s": 1, "position_m": [0, 3, 0]}]})",
                 {"camera.keys[0]", "camera.up", "parallel"});
}

TEST(Scene, MissingFile_IsNamedWithItsKey) {
  expect_refused(R"("groom": {"file": "gone.hair"})", {"groom.file", "/gone.hair"});
  expect_refused(R"("motion": {"bvh": "gone.bvh"})", {"motion.bvh", "/gone.bvh"});
}

TEST(Scene, Environment_AddsLightsUpToEightInAll) {
  const std::string name = (std::filesystem::temp_directory_path() / "cuticle_scene_sky.exr").string();
  Image sky = make_image(8, 4, {"R", "G", "B"});
  for (float& value : sky.pixels) value = 1;
  ASSERT_TRUE(write_exr(name, sky, ExrType::single));
  const std::string key =
      R"("lights": [{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}], "environment": {"file": ")" + name;
  const auto scene = parsed(key + R"(", "lights": 7})");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->lights.size(), 8u);
  expect_refused(key + R"(", "lights": 8})", {"environment.lights", "8 in all"});
  std::filesystem::remove(name);
}

TEST(Scene, EnvironmentWithoutAFile_IsTheBuiltInSky) {
  const auto scene = parsed(R"("environment": {"lights": 2})");
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->lights.size(), 2u);
  EXPECT_EQ(scene->lights[0].name, "environment 1");
  EXPECT_EQ(scene->lights[1].name, "environment 2");
}

TEST(Scene, PointLight_IsALightWithAPlaceAndASpotACone) {
  const auto scene =
      parsed(R"("point_lights": [{"position_m": [0, 2, 0], "intensity": [1, 2, 3]}, {"position_m": [1, 2, 0],
    "intensity": [1, 1, 1], "spot": {"to_m": [1, 0, 0], "inner_deg": 30, "outer_deg": 45}}],
    "lights": [{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}])");
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->lights.size(), 3u);
  ASSERT_TRUE(scene->lights[1].point_light && scene->lights[2].point_light && !scene->lights[0].point_light);
  EXPECT_EQ(scene->lights[1].point_light->intensity, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene->lights[1].point_light->outer_angle, k_all_around);
  EXPECT_EQ(scene->lights[2].point_light->axis, glm::dvec3(0, -1, 0));
  EXPECT_NEAR(scene->lights[2].point_light->outer_angle, 0.7853981633974483, 1e-15);
}

TEST(Scene, BadPointLight_IsRefused) {
  const std::string point_light = R"({"position_m": [0, 2, 0], "intensity": [1, 1, 1])",
                    spot = point_light + R"(, "spot": {"to_m": )";
  expect_refused(R"("point_lights": [{"position_m": [0, 2, 0]}])", {"point_lights[0].intensity", "missing"});
  expect_refused(R"("point_lights": [)" + spot + R"([0, 2, 0], "outer_deg": 20}}])",
                 {"point_lights[0].spot.to_m", "stands"});
  expect_refused(R"("point_lights": [)" + spot + R"([0, 0, 0], "outer_deg": 20, "inner_deg": 20}}])",
                 {"point_lights[0].spot.inner_deg", "20", "below"});
  expect_refused(R"("shadow": {"method": {"distant": {}}}, "point_lights": [)" + point_light + "}]",
                 {"'distant'", "distant lights"});
  std::string nine = point_light + "}";
  for (int k = 1; k < 8; ++k) nine += ", " + point_light + "}";
  expect_refused(R"("lights": [{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}], "point_lights": [)" + nine + "]",
                 {"point_lights", "8 in all"});
}

TEST(Scene, VariableInAFileName_IsReplacedOrNamed) {
  expect_refused(R"("character": {"file": "${CUTICLE_NOT_SET}/a.glb"})",
                 {"character.file", "CUTICLE_NOT_SET is not set"});
  setenv("CUTICLE_SCENE_TEST", "/nowhere", 1);
  expect_refused(R"("character": {"file": "${CUTICLE_SCENE_TEST}/a.glb"})", {"no file '/nowhere/a.glb'"});
}

TEST(Scene, CharacterBesideWhatItReplaces_IsRefused) {
  expect_refused(R"("character": {"file": "a.glb"}, "colliders": {"head": true})", {"character", "colliders"});
  expect_refused(R"("character": {"file": "a.glb", "skinning": "cubic"})", {"character.skinning", "dual_quaternion"});
}

TEST(Scene, NotJson_NamesLineAndColumn) {
  const auto scene = parse_scene(R"({"schema_version": 1,)", "/", "s.json", catalogue());
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, HasSubstr("s.json: not JSON at line 1, column 22"));
}

TEST(Scene, Mistake_IsNamedWithLineAndColumn) {
  const auto message = [](const char* text) { return parse_scene(text, "/", "s.json", catalogue()).error().message; };
  EXPECT_THAT(message("{\"schema_version\": 1,\n  \"camera\": {\"fov\": 30}}"),
              HasSubstr("s.json:2:14: camera: unknown key 'fov'"));
  EXPECT_THAT(message("{\"schema_version\": 1,\n  \"camera\": {\"fov_deg\": 300}}"),
              HasSubstr("s.json:2:14: camera.fov_deg = 300"));
}

TEST(CheckScene, ManyMistakes_AreAllListedInTheirPlaces) {
  const std::string path = (std::filesystem::temp_directory_path() / "cuticle_many_mistakes.json").string();
  std::ofstream(path) << "{\"schema_version\": 1,\n \"nonsense\": 3,\n \"strand_count\": -5,\n"
                         " \"lights\": [{\"to_light\": [0, 1], \"irradiance\": [1, 1, \"x\"]}],\n"
                         " \"camera\": {\"fov_deg\": 300}}";
  std::vector<std::string> messages;
  for (const Error& error : check_scene(path, catalogue())) messages.push_back(error.message);
  EXPECT_THAT(messages,
              testing::ElementsAre(HasSubstr(":2:2: unknown key 'nonsense'"), HasSubstr(":4:14: lights[0].to_light"),
                                   HasSubstr("lights[0].irradiance[2]"), HasSubstr("camera.fov_deg = 300"),
                                   HasSubstr(":3:2: strand_count = -5")));
  std::ofstream(path) << R"({"schema_version": 1})";
  EXPECT_TRUE(check_scene(path, catalogue()).empty());
  std::filesystem::remove(path);
}

TEST(Scene, Comments_AreSkipped) {
  EXPECT_TRUE(parse_scene("{ // version\n\"schema_version\": 1}", "/", "s.json", catalogue()));
}

TEST(Scene, KeyWithoutItsUnit_IsOfferedWithIt) { expect_refused(R"("camera": {"fov": 30})", {"write 'fov_deg'"}); }

TEST(Scene, ZeroDirection_IsRefused) {
  expect_refused(R"("lights": [{"to_light": [0, 0, 0], "irradiance": [1, 1, 1]}])", {"lights[0].to_light", "zero"});
}

TEST(Scene, CapsulesAndBoxes_BecomeRoundedBoxes) {
  const Scene scene = parsed(R"("colliders": {
    "capsules": [{"from_m": [0, 0, 0], "to_m": [0.2, 0, 0], "radius_m": 0.03}],
    "boxes": [{"center_m": [1, 2, 3], "size_m": [2, 4, 6], "rounding_m": 0.5,
               "turn_axis": [0, 0, 2], "turn_degrees": 90}]
  })")
                          .value();
  ASSERT_EQ(scene.boxes.size(), 2u);
  EXPECT_EQ(scene.boxes[0].center, glm::dvec3(0.1, 0, 0));
  EXPECT_EQ(scene.boxes[0].half_size, glm::dvec3(0, 0.1, 0));
  EXPECT_LT(glm::distance(scene.boxes[0].axes[1], glm::dvec3(1, 0, 0)), 1e-15);
  EXPECT_EQ(scene.boxes[1].half_size, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.boxes[1].radius, 0.5);
  EXPECT_LT(glm::distance(scene.boxes[1].axes[0], glm::dvec3(0, 1, 0)), 1e-15);
}

TEST(Scene, BoxesOutOfRange_AreRefused) {
  expect_refused(R"("colliders": {"boxes": [{"center_m": [0, 0, 0], "size_m": [1, 1, 1], "turn_degrees": 5}]})",
                 {"colliders.boxes[0].turn_axis", "zero"});
  expect_refused(R"("colliders": {"boxes": [{"center_m": [0, 0, 0], "size_m": [1, -1, 1]}]})",
                 {"colliders.boxes[0].size_m[1]", "-1"});
  expect_refused(R"("colliders": {"capsules": [{"from_m": [0, 0, 0], "radius_m": 1}]})",
                 {"colliders.capsules[0].to_m", "missing"});
}

TEST(Scene, CollidersWithAMotion_MoveByThemselves) {
  const Scene scene = parsed(R"("colliders": {
    "spheres": [{"center_m": [0, 0, 1], "radius_m": 0.1},
                {"center_m": [0, 0, 0], "radius_m": 0.2, "motion": {"keys": [{"time_s": 2, "position_m": [1, 2, 3]}]}}],
    "boxes": [{"center_m": [0, 0, 0], "size_m": [2, 4, 6], "motion": {"on_head": true, "keys": [
               {"time_s": 0}, {"time_s": 0.5, "turn_axis": [0, 0, 2], "turn_degrees": 90}]}}]
  })")
                          .value();
  ASSERT_EQ(scene.colliders.size(), 1u);
  ASSERT_EQ(scene.boxes.size(), 0u);
  ASSERT_EQ(scene.moving_colliders.size(), 2u);
  const MovingShape &sphere = scene.moving_colliders[0], &box = scene.moving_colliders[1];
  EXPECT_EQ(std::get<Sphere>(sphere.shape).radius, 0.2);
  EXPECT_EQ(sphere.motion.at(0), (Placement{{1, 0, 0, 0}, {1, 2, 3}}));
  EXPECT_FALSE(sphere.on_head);
  EXPECT_EQ(std::get<RoundedBox>(box.shape).half_size, glm::dvec3(1, 2, 3));
  EXPECT_TRUE(box.on_head);
  const double half = std::sqrt(0.5);
  EXPECT_LT(glm::distance(box.motion.at(0.25).of({1, 0, 0}), glm::dvec3(half, half, 0)), 1e-15);
}

TEST(Scene, MotionsOutOfRange_AreRefused) {
  const auto refused = [](const std::string& motion, std::initializer_list<const char*> words) {
    expect_refused(R"("colliders": {"spheres": [{"center_m": [0, 0, 0], "radius_m": 1, "motion": )" + motion + "}]}",
                   words);
  };
  refused(R"({})", {"colliders.spheres[0].motion.keys", "missing"});
  refused(R"({"keys": []})", {"colliders.spheres[0].motion.keys", "empty"});
  refused(R"({"keys": [{"position_m": [0, 0, 0]}]})", {"motion.keys[0].time_s", "missing"});
  refused(R"({"keys": [{"time_s": 1}, {"time_s": 0.5}]})", {"motion.keys[1]", "0.5", "order"});
  refused(R"({"keys": [{"time_s": 1, "turn_degrees": 5}]})", {"motion.keys[0].turn_axis", "zero"});
}

TEST(Scene, MeshColliders_NeedAFileAndASpacing) {
  expect_refused(R"("colliders": {"meshes": [{"file": "none.obj", "spacing_m": 0.01}]})",
                 {"colliders.meshes[0].file", "none.obj"});
  expect_refused(R"("colliders": {"meshes": [{"file": "none.obj", "spacing_m": 0}]})",
                 {"colliders.meshes[0].spacing_m", "0"});
}

TEST(Scene, CameraWithoutView_IsRefused) {
  expect_refused(R"("camera": {"position_m": [0, 1, 0], "target_m": [0, 0, 0]})", {"camera.up", "parallel"});
  expect_refused(R"("camera": {"near_m": 5, "far_m": 2})", {"camera.near_m", "5", "2"});
}

TEST(Scene, GroomFile_HasNoHeadUnlessAsked) {
  const auto folder = std::filesystem::path(CUTICLE_BINARY_DIR) / "scene_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.hair") << "x";
  const auto load = [&](const std::string& more) {
    return parse_scene(fmt::format(R"({{"schema_version": 1, "groom": {{"file": "a.hair"}}{}}})", more),
                       folder.string(), "s.json", catalogue());
  };
  ASSERT_TRUE(load(""));
  EXPECT_FALSE(load("")->head.present);
  EXPECT_TRUE(load(R"(, "head": {})")->head.present);
}

TEST(Scene, HeadMeshThatIsNotThere_IsTheProceduralHeadOnlyWhereAsked) {
  const auto load = [](const std::string& more) {
    return parse_scene(fmt::format(R"({{"schema_version": 1, "head": {{"mesh": "no_such.obj"{}}}}})", more), ".",
                       "s.json", catalogue());
  };
  ASSERT_FALSE(load(""));
  EXPECT_THAT(load("").error().message, testing::HasSubstr("no_such.obj"));
  const auto scene = load(R"(, "or_procedural": true)");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->head.mesh.empty());
  EXPECT_THAT(scene->notes, testing::Contains(testing::HasSubstr("the procedural head is used")));
}

}  // namespace
}  // namespace cuticle::scene::scene_test
