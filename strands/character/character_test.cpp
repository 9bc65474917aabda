// A small glTF of our own, written here byte by byte: welding, influences, clips, units and what is refused.
#include "strands/character/character.h"

#include <cstring>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace cuticle::strands::character_test {
namespace {

using testing::HasSubstr;

/// JSON and bytes of a binary glTF.
struct Glb {
  std::string views, accessors, nodes, skins, meshes, animations;
  std::vector<std::byte> bytes;
  int count = 0;

  template <class T>
  int add(const std::vector<T>& values, int component_type, const char* type, std::size_t components) {
    views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", count ? "," : "", bytes.size(),
                         values.size() * sizeof(T));
    accessors += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"}}",
                             count ? "," : "", count, component_type, values.size() / components, type);
    const std::size_t at = bytes.size();
    bytes.resize((at + values.size() * sizeof(T) + 3) / 4 * 4);
    std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(T));
    return count++;
  }
  int floats(const std::vector<float>& values, const char* type, std::size_t components) {
    return add(values, 5126, type, components);
  }

  std::string json() const {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{}],"skins":[{}],)"
        R"("meshes":[{}],"animations":[{}],"buffers":[{{"byteLength":{}}}],"bufferViews":[{}],"accessors":[{}]}})",
        nodes, skins, meshes, animations, bytes.size(), views, accessors);
  }
  std::vector<std::byte> file() const {
    std::string text = json();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::byte> result;
    const auto word = [&](std::uint32_t value) {
      const auto* data = reinterpret_cast<const std::byte*>(&value);
      result.insert(result.end(), data, data + 4);
    };
    word(0x46546C67), word(2), word(std::uint32_t(28 + text.size() + bytes.size()));
    word(std::uint32_t(text.size())), word(0x4E4F534A);
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    result.insert(result.end(), data, data + text.size());
    word(std::uint32_t(bytes.size())), word(0x004E4942);
    result.insert(result.end(), bytes.begin(), bytes.end());
    return result;
  }
};

/// Two triangles, six file vertices at four places, on an arm of two joints that meet at (1, 0, 0).
struct Arm {
  std::vector<float> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<std::uint16_t> joints = std::vector<std::uint16_t>(24, 0);
  std::vector<float> weights = std::vector<float>(24, 0);
  std::vector<std::uint16_t> more_joints;
  std::vector<float> more_weights;
  std::string interpolation = "LINEAR", path = "rotation";
  std::vector<float> times{0.5f, 1.5f};
  std::vector<float> values{0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f};

  Arm() {
    for (std::size_t v = 0; v < 6; ++v) {
      joints[4 * v] = positions[3 * v] > 0.5f ? 1 : 0;
      weights[4 * v] = 1;
    }
  }

  Glb glb() const {
    Glb glb;
    const int position = glb.floats(positions, "VEC3", 3), joint = glb.add(joints, 5123, "VEC4", 4);
    const int weight = glb.floats(weights, "VEC4", 4);
    const int bind = glb.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,  //
                                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                                "MAT4", 16);
    std::string sets = fmt::format("\"POSITION\":{},\"JOINTS_0\":{},\"WEIGHTS_0\":{}", position, joint, weight);
    if (!more_joints.empty()) {
      const int second = glb.add(more_joints, 5123, "VEC4", 4);
      sets += fmt::format(",\"JOINTS_1\":{},\"WEIGHTS_1\":{}", second, glb.floats(more_weights, "VEC4", 4));
    }
    const int time = glb.floats(times, "SCALAR", 1);
    const int value = glb.floats(values, path == "rotation" ? "VEC4" : "VEC3", path == "rotation" ? 4 : 3);
    glb.nodes = R"({"name":"body","mesh":0,"skin":0,"children":[1]},{"name":"upper","children":[2]},)"
                R"({"name":"lower","translation":[1,0,0]})";
    glb.skins = fmt::format(R"({{"joints":[1,2],"inverseBindMatrices":{}}})", bind);
    glb.meshes = fmt::format(R"({{"primitives":[{{"attributes":{{{}}}}}]}})", sets);
    glb.animations = fmt::format(R"({{"name":"Bend","channels":[{{"sampler":0,"target":{{"node":2,"path":"{}"}}}}],)"
                                 R"("samplers":[{{"input":{},"output":{},"interpolation":"{}"}}]}})",
                                 path, time, value, interpolation);
    return glb;
  }
};

Result<Character> parsed(const Glb& glb, const Convention& convention = {.metres_per_unit = 1}) {
  return parse_gltf(glb.file(), "arm.glb", convention);
}
Result<Character> parsed(const Arm& arm) { return parsed(arm.glb()); }
std::string refusal(const Glb& glb) {
  const auto character = parsed(glb);
  return character ? "accepted" : character.error().message;
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}
/// Where joint 1 turns the point (2, 0, 0) to.
glm::dvec3 hand(const Character& character, double time) {
  return glm::dvec3(joint_matrices(character, 0, time)[1] * glm::dvec4(2, 0, 0, 1));
}
glm::dvec3 bent(double angle) { return {1 + std::cos(angle), std::sin(angle), 0}; }

TEST(Gltf, NonIndexedMesh_IsWelded) {
  const auto character = parsed(Arm());
  ASSERT_TRUE(character) << character.error().message;
  EXPECT_EQ(character->mesh.positions.size(), 4u);
  EXPECT_EQ(character->mesh.triangles.size(), 2u);
  EXPECT_EQ(character->report.file_vertices, 6u);
  EXPECT_EQ(character->report.welded_conflicts, 0u);
  for (const glm::vec3& normal : character->mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(find_clip(*character, "bend").value(), 0);
}

TEST(Gltf, MoreThanFourInfluences_TheGreatestFourAreKeptAndCounted) {
  Arm arm;
  arm.more_joints.assign(24, 0);
  arm.more_weights.assign(24, 0);
  const std::array<float, 8> weights{0.1f, 0.3f, 0.05f, 0.2f, 0.15f, 0.2f, 0, 0};
  for (std::size_t k = 0; k < 8; ++k) (k < 4 ? arm.weights[k] : arm.more_weights[k - 4]) = weights[k];
  arm.joints[1] = 1;
  const auto character = parsed(arm);
  ASSERT_TRUE(character) << character.error().message;
  EXPECT_EQ(character->report.reduced_vertices, 1u);
  EXPECT_NEAR(character->report.largest_weight_dropped, 0.1, 1e-7);
  const Influences& kept = character->influences[0];
  EXPECT_EQ(kept.joints[0], 1u);
  EXPECT_NEAR(kept.weights.x, 0.3 / 0.85, 1e-6);
  EXPECT_NEAR(kept.weights.x + kept.weights.y + kept.weights.z + kept.weights.w, 1, 1e-6);
}

TEST(Gltf, UnusableWeights_AreDroppedAndCounted) {
  Arm arm;
  arm.weights[0] = 0;                                         // none at all
  arm.weights[4] = -1, arm.weights[5] = 0.5f, arm.joints[5] = 1;                 // one negative
  arm.joints[8] = 7, arm.weights[9] = 0.25f;                  // one names a joint of two
  arm.weights[12] = std::numeric_limits<float>::quiet_NaN();  // welded to the second
  const auto character = parsed(arm);
  ASSERT_TRUE(character) << character.error().message;
  EXPECT_EQ(character->report.unweighted_vertices, 2u);
  EXPECT_EQ(character->report.bad_weights, 2u);
  EXPECT_EQ(character->report.missing_joints, 1u);
  EXPECT_EQ(character->report.welded_conflicts, 1u);
  for (const Influences& one : character->influences) {
    EXPECT_FLOAT_EQ(glm::dot(one.weights, glm::vec4(1)), 1);
    for (std::uint32_t joint : one.joints) EXPECT_LT(joint, 2u);
  }
}

TEST(Gltf, TriangleWithoutArea_IsLeftOutAndCounted) {
  Arm arm;
  arm.positions[6] = 0.5f, arm.positions[7] = 0;
  const auto character = parsed(arm);
  ASSERT_TRUE(character) << character.error().message;
  EXPECT_EQ(character->mesh.triangles.size(), 1u);
  EXPECT_EQ(character->report.degenerate_triangles, 1u);
}

TEST(Clip, LinearRotation_TurnsEvenlyAndStaysAtTheEnds) {
  const auto character = parsed(Arm());
  ASSERT_TRUE(character);
  EXPECT_EQ(character->clips[0].duration, 1.5);
  for (const auto& [time, degrees] : {std::pair(0.0, 0.0), {0.5, 0}, {0.75, 22.5}, {1.0, 45}, {1.5, 90}, {9.0, 90}})
    EXPECT_LT(glm::distance(hand(*character, time), bent(degrees * std::numbers::pi / 180)), 1e-6) << time;
}

TEST(Clip, RotationOfOppositeSign_GoesTheShortWay) {
  Arm arm;
  for (std::size_t k = 4; k < 8; ++k) arm.values[k] = -arm.values[k];
  const auto character = parsed(arm);
  ASSERT_TRUE(character);
  EXPECT_LT(glm::distance(hand(*character, 1.0), bent(std::numbers::pi / 4)), 1e-6);
}

TEST(Clip, Step_HoldsTheKeyBefore) {
  Arm arm;
  arm.interpolation = "STEP";
  const auto character = parsed(arm);
  ASSERT_TRUE(character);
  EXPECT_LT(glm::distance(hand(*character, 1.49), bent(0)), 1e-6);
  EXPECT_LT(glm::distance(hand(*character, 1.5), bent(std::numbers::pi / 2)), 1e-6);
}

TEST(Clip, CubicSpline_IsTheCubicThatItsTangentsName) {
  Arm arm;  // x(t) = 1 + t^3 - 2 t over keys at 0.5 s and 2.5 s, t in seconds from the first
  arm.interpolation = "CUBICSPLINE", arm.path = "translation";
  arm.times = {0.5f, 2.5f};
  const auto x = [](double t) { return 1 + t * t * t - 2 * t; };
  arm.values = {0, 0, 0, 1, 0, 0, -2, 0, 0, 10, 0, 0, float(x(2)), 0, 0, 0, 0, 0};
  const auto character = parsed(arm);
  ASSERT_TRUE(character);
  for (double t : {0.0, 0.3, 1.0, 1.7, 2.0}) EXPECT_NEAR(hand(*character, 0.5 + t).x, 1 + x(t), 1e-6) << t;
}

TEST(Clip, LoopedTime_RepeatsTheClip) {
  const Clip clip{.name = "c", .duration = 1.5};
  EXPECT_NEAR(looped(clip, 3.25), 0.25, 1e-12);
  EXPECT_NEAR(looped(clip, -0.25), 1.25, 1e-12);
  EXPECT_EQ(looped(Clip{}, 7), 0);
}

TEST(Gltf, UnitsAndAxes_AreTurnedToOurs) {
  const auto character = parsed(Arm().glb(), {.metres_per_unit = 0.01, .up = "+z", .forward = "-y"});
  ASSERT_TRUE(character) << character.error().message;
  EXPECT_LT(glm::distance(character->mesh.positions[2], glm::vec3(0, 0, -0.01)), 1e-7f);  // file: (0, 1, 0), backwards
  EXPECT_EQ(character->mesh.normals[0], glm::vec3(0, 1, 0));
  // The joint at (1, 0, 0) turns about the file's z, which is up, and (2, 0, 0) comes to (1, 1, 0).
  const glm::dvec3 moved(joint_matrices(*character, 0, 1.5)[1] * glm::dvec4(0.02, 0, 0, 1));
  EXPECT_LT(glm::distance(moved, glm::dvec3(0.01, 0, -0.01)), 1e-8);
}

TEST(Gltf, MeshWithoutSkin_FollowsItsNode) {
  Glb glb = Arm().glb();
  glb.nodes =
      R"({"name":"body","children":[1]},{"name":"upper","children":[2]},{"name":"lower","translation":[1,0,0],"mesh":0})";
  const auto character = parsed(glb);
  ASSERT_TRUE(character) << character.error().message;
  EXPECT_EQ(character->joints.size(), 3u);
  EXPECT_EQ(character->mesh.positions[0], glm::vec3(1, 0, 0));
  const glm::dmat4 moved = joint_matrices(*character, 0, 1.5)[character->influences[0].joints[0]];
  EXPECT_LT(glm::distance(glm::dvec3(moved * glm::dvec4(2, 0, 0, 1)), glm::dvec3(1, 1, 0)), 1e-6);
}

TEST(Gltf, BrokenParts_AreNamed) {
  const Glb good = Arm().glb();
  const auto with = [&](auto member, const char* from, const char* to) {
    Glb bad = good;
    bad.*member = replaced(bad.*member, from, to);
    return refusal(bad);
  };
  EXPECT_THAT(with(&Glb::nodes, "\"children\":[2]", "\"children\":[9]"), HasSubstr("nodes[1].children: 9"));
  EXPECT_THAT(with(&Glb::nodes, "\"translation\":[1,0,0]", "\"children\":[1]"), HasSubstr("two parents"));
  EXPECT_THAT(with(&Glb::skins, "[1,2]", "[1,9]"), HasSubstr("skins[0]: joint node 9 of 3"));
  EXPECT_THAT(with(&Glb::skins, "[1,2]", "[1,2,0]"), HasSubstr("2 inverse bind matrices for 3 joints"));
  EXPECT_THAT(with(&Glb::accessors, "\"count\":6", "\"count\":7"), HasSubstr("7 elements, but its bytes hold 6"));
  EXPECT_THAT(with(&Glb::accessors, "\"count\":6", "\"count\":4000000000"), HasSubstr("its bytes hold 6"));
  EXPECT_THAT(with(&Glb::animations, "\"node\":2", "\"node\":5"), HasSubstr("animations[0].channels[0]: node 5"));
  Arm falling;
  falling.times = {1.5f, 0.5f};
  EXPECT_THAT(refusal(falling.glb()), HasSubstr("key 1 at 0.5 s"));
  Arm endless;
  endless.positions[4] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal(endless.glb()), HasSubstr("vertex 1 is not finite"));
}

TEST(Gltf, NoGltf_IsRefused) {
  const std::string text = "this is no glTF file";
  const auto character = parse_gltf(std::as_bytes(std::span(text)), "x.glb");
  ASSERT_FALSE(character);
  EXPECT_THAT(character.error().message, HasSubstr("x.glb: no glTF 2.0"));
}

TEST(BoneNames, OfManyPrograms_ArePlain) {
  for (const char* name :
       {"b_LeftHand_011", "mixamorig:LeftHand", "hand.L", "hand_l", "Left_Hand", "DEF-hand.L", "Bip01 L Hand"})
    EXPECT_EQ(plain_bone_name(name), "lefthand") << name;
  EXPECT_EQ(plain_bone_name("pelvis"), plain_bone_name("b_Hip_01"));
  EXPECT_EQ(plain_bone_name("Spine01"), plain_bone_name("spine.1"));
  EXPECT_NE(plain_bone_name("Spine1"), plain_bone_name("Spine2"));
  EXPECT_EQ(plain_bone_name(""), "");
}

TEST(BoneMap, Override_GoesBeforeNameBeforePlainName) {
  const std::vector<std::string> ours{"Head", "LeftHand", "Tail", "Jaw"},
      theirs{"b_Head_05", "Head", "hand.L", "tail", "Tail_01"};
  const auto map = map_bones(ours, theirs, {{"Head", "b_Head_05"}});
  ASSERT_TRUE(map);
  ASSERT_EQ(map->pairs.size(), 2u);
  EXPECT_EQ(map->pairs[0].theirs + map->pairs[0].rule, "b_Head_05override");
  EXPECT_EQ(map->pairs[1].theirs + map->pairs[1].rule, "hand.Lplain name");
  EXPECT_EQ(map->ambiguous, std::vector<std::string>{"Tail"});
  EXPECT_EQ(map->unmapped, std::vector<std::string>{"Jaw"});
  EXPECT_FALSE(map_bones(ours, theirs, {{"Head", "Skull"}}).ok());
}

TEST(Convention, WrongKeys_AreNamed) {
  const auto refused = [](const char* json) {
    const auto convention = parse_convention(json, "map.json");
    return convention ? "accepted" : convention.error().message;
  };
  EXPECT_TRUE(parse_convention(R"({"metres_per_unit": 0.01, "up": "+z", "forward": "-y", "bones": {"a": "b"}})", "m"));
  EXPECT_THAT(refused(R"({"units": 1})"), HasSubstr("map.json: unknown key 'units'"));
  EXPECT_THAT(refused(R"({"up": "z"})"), HasSubstr("'z' is no axis"));
  EXPECT_THAT(refused(R"({"up": "+z", "forward": "-z"})"), HasSubstr("lie along one axis"));
  EXPECT_THAT(refused(R"({"metres_per_unit": -1})"), HasSubstr("-1"));
  EXPECT_THAT(refused("[]"), HasSubstr("not a JSON object"));
}

TEST(Units, LongestSide_NamesThem) {
  EXPECT_EQ(guess_character_units(1.7).metres_per_unit, 1);
  EXPECT_EQ(guess_character_units(155).metres_per_unit, 0.01);
  EXPECT_EQ(guess_character_units(1e7).metres_per_unit, 1);
}

}  // namespace
}  // namespace cuticle::strands::character_test
