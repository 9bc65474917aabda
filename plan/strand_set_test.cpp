// The hair of a scene before its first frame: grown or from a file, with the strands that are drawn between.
#include "plan/strand_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "plan/fitted_head.h"
#include "plan/plan.h"
#include "strands/formats/formats.h"

namespace cuticle::plan::strand_set_test {
namespace {

using testing::HasSubstr;

scene::Scene grown(int strands) {
  scene::Scene scene;
  scene.strand_count = strands;
  return scene;
}

/// Three strands of three vertices, 10 cm long, as a file of its own.
scene::Scene of_file(int strands) {
  strands::Groom groom;
  for (int s = 0; s < 3; ++s) {
    for (int v = 0; v < 3; ++v) groom.positions.emplace_back(0.02f * float(s), -0.05f * float(v), 0);
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), 3e-5f);
  const auto folder = std::filesystem::path(CUTICLE_BINARY_DIR) / "strand_set_test";
  std::filesystem::create_directories(folder);
  scene::Scene scene;
  scene.groom.file = (folder / "three.hair").string();
  scene.groom.metres_per_unit = 1;
  scene.head.present = false;
  scene.strand_count = strands;
  EXPECT_TRUE(strands::write_groom(scene.groom.file, groom));
  return scene;
}

std::vector<glm::vec3> on_sphere(const glm::vec3& center, float radius) {
  std::vector<glm::vec3> points;
  for (int k = 0; k < 20; ++k) {
    const glm::vec3 direction(std::cos(float(k)), std::sin(1.7f * float(k)), std::cos(2.3f * float(k) + 1));
    points.push_back(center + radius * glm::normalize(direction));
  }
  return points;
}

/// Segments of 50 mm.
StrandSet with_long_segments(const std::string& method, int parts) {
  scene::Scene scene = of_file(0);
  scene.render_method = method;
  scene.groom.segment_parts = parts;
  return *build_strand_set(scene);
}

TEST(StrandSet, LongSegments_AreGivenPartsForLightAndNoted) {
  for (const auto& [method, parts, wanted, note] : {std::tuple{"tiles", 0, 8u, "light is found at 8 places along each"},
                                                    {"tiles", 10, 10u, "light is found at 10 places along each"},
                                                    {"tiles", 1, 1u, "light is interpolated along them"},
                                                    {"lines", 0, 1u, "'lines' interpolates light along them"}}) {
    const StrandSet set = with_long_segments(method, parts);
    EXPECT_EQ(set.segment_parts, wanted) << method << parts;
    EXPECT_THAT(set.notes, testing::Contains(testing::AllOf(HasSubstr("segments are 50 mm long"), HasSubstr(note))));
  }
}

TEST(StrandSet, PartsOfSegments_AreFourMillimetresLong) {
  scene::Scene scene = of_file(0);
  scene.render_method = "tiles";
  scene.groom.metres_per_unit = 0.32;  // segments of 16 mm
  EXPECT_EQ(build_strand_set(scene)->segment_parts, 4u);
}

TEST(StrandSet, SegmentsOfTracedStrands_HaveNoParts) {
  for (const int parts : {0, 4}) EXPECT_EQ(with_long_segments("reference", parts).segment_parts, 1u);
}

TEST(StrandSet, PartsOfSegmentsUnderManyLights_FitTheirBuffers) {
  scene::Scene scene = of_file(0);
  scene.render_method = "tiles";
  scene.material.evaluate = "direct";
  scene.lights.resize(300'000);  // times 9 vertices, up to 8 million
  EXPECT_EQ(build_strand_set(scene)->segment_parts, 2u);
}

TEST(FitSphere, PointsOnASphere_GiveIt) {
  const auto sphere = fit_sphere(on_sphere({0.1f, 1.6f, -0.2f}, 0.09f));
  ASSERT_TRUE(sphere);
  EXPECT_LT(glm::distance(sphere->center, glm::dvec3(0.1f, 1.6f, -0.2f)), 1e-6);
  EXPECT_NEAR(sphere->radius, 0.09, 1e-6);
}

TEST(FitSphere, FewPointsOrOnePlace_IsRefused) {
  EXPECT_FALSE(fit_sphere(std::vector<glm::vec3>(3)));
  EXPECT_FALSE(fit_sphere(std::vector<glm::vec3>(10, glm::vec3(1, 2, 3))));
}

// Roots on the back and the sides of a skull twice as large that faces -x: most lie at +x.
TEST(FittedHead, RootsOfATurnedLargerHead_AreAboutItsScalp) {
  std::vector<glm::vec3> roots;
  for (float around = -1.2f; around < 1.3f; around += 0.3f)
    for (float up = -0.2f; up < 1.4f; up += 0.3f)
      roots.push_back(glm::vec3(0.3f, 1, 0) +
                      0.2f * glm::vec3(std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around)));
  const strands::Head own = strands::make_head();
  const auto head = fitted_head(own, roots);
  ASSERT_TRUE(head) << head.error().message;
  const auto scalp = fit_sphere(head->scalp.positions), before = fit_sphere(own.scalp.positions);
  EXPECT_LT(glm::distance(scalp->center, glm::dvec3(0.3, 1, 0)), 1e-4);
  EXPECT_NEAR(scalp->radius, 0.98 * 0.2, 1e-4);
  const auto nose = [](const strands::Mesh& mesh, const glm::dvec3& middle) {
    glm::dvec3 farthest{0};
    for (const glm::vec3& point : mesh.positions) {
      const glm::dvec3 away = glm::dvec3(point) - middle;
      if (std::hypot(away.x, away.z) > std::hypot(farthest.x, farthest.z)) farthest = away;
    }
    return farthest;
  };
  EXPECT_GT(nose(own.mesh, before->center).z, 0.05);
  EXPECT_LT(nose(head->mesh, scalp->center).x, -0.1) << "it looks away from the roots";
}

TEST(FittedHead, RootsThatAreNoHeads_AreRefused) {
  std::vector<glm::vec3> row;
  for (int k = 0; k < 30; ++k) row.emplace_back(0.1f * float(k), 0.02f * float(k % 3), 0.01f * float(k % 5));
  EXPECT_FALSE(fitted_head(strands::make_head(), row));
  EXPECT_FALSE(fitted_head(strands::make_head(), on_sphere({0, 0, 0}, 3)));
}

TEST(StrandSet, Grown_HasTheStrandsAskedForWithWeightsOfSumOne) {
  const auto set = build_strand_set(grown(700));
  ASSERT_TRUE(set);
  ASSERT_EQ(set->hairs.size(), 700u);
  for (const auto& hair : set->hairs)
    for (std::uint32_t control : hair) EXPECT_LT(control, set->control.strand_count());
  for (const glm::vec3& weights : set->weights) EXPECT_NEAR(weights.x + weights.y + weights.z, 1, 1e-6f);
}

TEST(StrandSet, OfAFileDrawnByLevelOfDetail_StandsInRandomOrder) {
  scene::Scene scene = of_file(3000);
  const auto in_order = build_strand_set(scene);
  const auto entry = std::ranges::find(catalogue().passes, "lines", &registry::Entry::name);
  registry::ParameterValues lines = registry::default_values((*entry)->parameters);
  lines.set("full_px", 1e4);
  scene.passes.emplace("lines", lines);
  const auto set = build_strand_set(scene);
  ASSERT_TRUE(in_order && set);
  const std::array<std::uint32_t, 3> own{0, 0, 0};  // the file's first strand
  EXPECT_EQ(std::ranges::find(in_order->hairs, own) - in_order->hairs.begin(), 0);
  EXPECT_GT(std::ranges::find(set->hairs, own) - set->hairs.begin(), 100);
  const auto sum = [](const StrandSet& strands) {
    return std::accumulate(strands.weights.begin(), strands.weights.end(), glm::dvec3(0),
                           [](const glm::dvec3& total, const glm::vec3& w) { return total + glm::dvec3(w); });
  };
  EXPECT_LT(glm::distance(sum(*set), sum(*in_order)), 1e-9);
}

TEST(StrandSet, FewDrawnStrands_AreAsWideAsTheFibresTheyStandFor) {
  scene::Scene scene = grown(1000);
  scene.groom.radius = 4e-5;
  scene.fibre_count = 5000;
  EXPECT_NEAR(build_strand_set(scene)->radius, 2e-4, 1e-9);
  EXPECT_NEAR(build_strand_set(scene)->fibre_width, 0.2, 1e-6);
  scene.fibre_count = 10;
  EXPECT_NEAR(build_strand_set(scene)->radius, 4e-5, 1e-9) << "never thinner than a fibre";
  EXPECT_EQ(build_strand_set(scene)->fibre_width, 1);
  scene.fibre_count = 1e9;
  EXPECT_NEAR(build_strand_set(scene)->radius, 5e-4, 1e-9) << "at most a millimetre wide";
  EXPECT_NEAR(build_strand_set(scene)->fibre_width, 0.08, 1e-6);
}

TEST(StrandSet, FileWithRadii_ItsStrandsAreFibresUnlessTheSceneCountsThem) {
  scene::Scene scene = of_file(0);
  EXPECT_EQ(build_strand_set(scene)->fibre_width, 1);
  scene.fibre_count = 10.0 * double(build_strand_set(scene)->placed.size());
  EXPECT_NEAR(build_strand_set(scene)->fibre_width, 0.1, 1e-6);
}

TEST(StrandSet, File_DrawsItsOwnStrandsFirstThenFollowers) {
  const auto set = build_strand_set(of_file(8));
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->hairs.size(), 8u);
  for (std::uint32_t s = 0; s < 3; ++s) EXPECT_EQ(set->hairs[s], (std::array<std::uint32_t, 3>{s, s, s}));
  EXPECT_EQ(set->hairs[3], (std::array<std::uint32_t, 3>{0, 1, 2})) << "a leader and the two roots nearest to it";
  for (const glm::vec3& weights : set->weights) EXPECT_NEAR(weights.x + weights.y + weights.z, 1, 1e-6f);
}

TEST(StrandSet, FileWithMoreStrandsThanAskedFor_DrawsThemAll) {
  EXPECT_EQ(build_strand_set(of_file(1))->hairs.size(), 3u);
}

TEST(StrandSet, FileTurnsAboutTheMiddleOfItsRoots) {
  EXPECT_LT(glm::distance(build_strand_set(of_file(3))->pivot, glm::dvec3(0.02, 0, 0)), 1e-6);
}

TEST(StrandSet, HeadOfAFlatGroom_NamesTheKey) {
  scene::Scene scene = of_file(3);
  scene.head_colliders = true;
  const auto set = build_strand_set(scene);
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().message, HasSubstr("colliders.head"));
}

TEST(StrandSet, GrowingOnAMeshThatIsNoHead_IsRefusedByKey) {
  scene::Scene scene = grown(10);
  scene.head.mesh = CUTICLE_SOURCE_DIR "/scenes/fins/ear_fins.obj";
  const auto set = build_strand_set(scene);
  ASSERT_FALSE(set);
  EXPECT_THAT(set.error().message, HasSubstr("head.mesh"));
}

TEST(StrandSet, MeshColliders_BecomeDistanceFieldsAndOpenOnesAreRefused) {
  scene::Scene scene = grown(30);
  scene.simulation.solver = {"exact", {}};
  scene.mesh_colliders = {{.file = CUTICLE_SOURCE_DIR "/scenes/shoulders/shoulders.obj", .spacing = 0.02}};
  const auto set = build_strand_set(scene);
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->fields.size(), 1u);
  EXPECT_THAT(set->notes, testing::Contains(HasSubstr("collider shoulders.obj: 26 x 24 x 16 nodes")));
  scene.mesh_colliders[0].file = CUTICLE_SOURCE_DIR "/scenes/fins/ear_fins.obj";
  const auto open = build_strand_set(scene);
  ASSERT_FALSE(open);
  EXPECT_THAT(open.error().message, HasSubstr("ear_fins.obj: "));
  EXPECT_THAT(open.error().message, HasSubstr(" open edges, allowed 0"));
}

/// The frame of a scene of this repository.
registry::FrameShape published(const std::string& name, std::uint32_t* casting = nullptr) {
  const auto scene = scene::load_scene(CUTICLE_SOURCE_DIR "/scenes/" + name + ".json", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  const auto set = build_strand_set(*scene);
  EXPECT_TRUE(set) << (set ? "" : set.error().message);
  if (casting) *casting = std::uint32_t(std::lround(scene->caster_share * double(set->hairs.size())));
  return shape_of(*scene, *set);
}

TEST(FrameShape, OfScenesAfterASystem_IsAsPublished) {
  const registry::FrameShape nalu = published("nalu"), frostbite = published("frostbite");
  EXPECT_EQ(nalu.strands, 4095u);
  EXPECT_EQ(nalu.vertices, 122850u) << "123,000";
  EXPECT_EQ(frostbite.vertices, 240000u);
  std::uint32_t casting = 0;
  const registry::FrameShape thick = published("hairworks", &casting), split = published("hairworks_split");
  EXPECT_EQ(thick.strands, 200000u);
  EXPECT_EQ(casting, 20000u);
  EXPECT_NEAR(split.control_vertices, 10000, 100);
  EXPECT_EQ(split.vertices, 500000u);
}

TEST(FrameShape, CountsStrandsVerticesAndSubsteps) {
  scene::Scene scene = grown(100);
  scene.strand_vertices = 20;
  scene.lights.resize(2);
  const auto set = build_strand_set(scene);
  const registry::FrameShape shape = shape_of(scene, *set);
  EXPECT_EQ(shape.strands, 100u);
  EXPECT_EQ(shape.vertices, 2000u);
  EXPECT_EQ(shape.segments, 1900u);
  EXPECT_EQ(shape.lights, 2u);
  EXPECT_EQ(shape.control_strands, set->control.strand_count());
  EXPECT_EQ(shape.substeps, 1u);
}

}  // namespace
}  // namespace cuticle::plan::strand_set_test
