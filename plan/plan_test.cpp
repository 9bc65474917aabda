// A plan holds what the scene's facts demand, and says why; the rest is left out, with the reason.
#include "plan/plan.h"

#include <algorithm>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/told_strands.h"
#include "render/resource.h"

namespace cuticle::plan::plan_test {
namespace {

using testing::HasSubstr;

constexpr std::string_view k_full = R"(
  "simulation": {"solver": {"classic": {}}, "effects": {"gravity": {}}}, "colliders": {"head": true},
  "lights": [{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}, {"to_light": [1, 1, 0], "irradiance": [1, 1, 1]}],
  "shadow": {"method": {"opacity_map": {}}})";

Plan planned(std::string_view fields) {
  const std::string text = fmt::format(R"({{"schema_version": 1{}{}}})", fields.empty() ? "" : ", ", fields);
  const auto scene = scene::parse_scene(text, "/", "test", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  registry::FrameShape shape;
  shape.lights = std::uint32_t(scene->lights.size());
  shape.substeps = 8;
  return make_plan(*scene, shape);
}

std::vector<std::string> names(const Plan& plan) {
  std::vector<std::string> list;
  for (const PlannedPass& pass : plan.passes) list.emplace_back(pass.entry->name);
  return list;
}

std::string why_left_out(const Plan& plan, std::string_view name) {
  for (const LeftOut& left : plan.left_out)
    if (left.entry->name == name) return left.reason;
  return "it is not left out";
}

TEST(Plan, FullScene_RunsStagesInOrder) {
  EXPECT_THAT(names(planned(k_full)),
              testing::ElementsAre("bake_tables", "classic", "colliders", "gravity", "smooth_strands",
                                   "interpolate_strands", "strands_in_sight", "opacity_map", "surface_shadow", "head",
                                   "cull_strands", "lines", "resolve"));
}

TEST(Plan, RenderMethod_DemandsItsOwnPasses) {
  EXPECT_THAT(names(planned(R"("render": {"method": "tiles"})")),
              testing::ElementsAre("smooth_strands", "interpolate_strands", "strands_in_sight", "head", "tile_lists",
                                   "shade_strands", "tile_sort", "tiles", "resolve"));
  EXPECT_THAT(names(planned(R"("render": {"method": "supersampled"})")),
              testing::ElementsAre("smooth_strands", "interpolate_strands", "head", "shade_strands", "supersampled"));
  EXPECT_THAT(names(planned(R"("render": {"method": "truth"}, "passes": {"truth": {"samples": 4}})")),
              testing::Contains("supersampled"))
      << "the former name";
  EXPECT_EQ(why_left_out(planned(R"("render": {"method": "tiles"})"), "lines"), "strands are drawn by 'tiles'");
}

TEST(Plan, CullingOfStrands_IsForLinesAndQuadsUnlessRefused) {
  EXPECT_EQ(why_left_out(planned(R"("render": {"method": "tiles"})"), "cull_strands"), "strands are drawn by 'tiles'");
  EXPECT_THAT(find_pass(planned(R"("render": {"method": "quads"})"), "cull_strands")->reason,
              HasSubstr("strands are drawn by 'quads'"));
  EXPECT_EQ(why_left_out(planned(R"("render": {"method": "quads"}, "passes": {"cull_strands": {"wanted": false}})"),
                         "cull_strands"),
            "the scene wants strands drawn that are not seen");
}

TEST(Plan, StrandsInSight_AreListedWhereSomebodyAsks) {
  const auto why = [](std::string_view scene) { return why_left_out(planned(scene), "strands_in_sight"); };
  EXPECT_EQ(why(R"("render": {"method": "tiles"})"), "it is not left out");
  EXPECT_EQ(why(R"("render": {"method": "lines"})"), "no pass of this scene reads 'strands_in_sight'");
  EXPECT_EQ(why(R"("render": {"method": "supersampled"})"), "strands are drawn by 'supersampled'");
  EXPECT_EQ(why(R"("render": {"method": "tiles"}, "passes": {"strands_in_sight": {"wanted": false}})"),
            "the scene wants strands shaded that are out of view");
}

TEST(Plan, PassOverThePictureThatCannotRun_DemandsNoDepthAndNoLayers) {
  const auto with = [](std::string_view method, std::string_view pass) {
    return names(planned(fmt::format(R"("render": {{"method": "{}"}}, "passes": {{"{}": {{}}}})", method, pass)));
  };
  for (const auto& [method, pass] : {std::pair("tiles", "temporal_antialiasing"), {"lines", "motion_blur"}})
    EXPECT_EQ(with(method, pass), names(planned(fmt::format(R"("render": {{"method": "{}"}})", method)))) << pass;
  EXPECT_THAT(with("quads", "temporal_antialiasing"),
              testing::IsSupersetOf({"aovs", "pixel_depth", "velocity", "temporal_antialiasing"}));
}

TEST(Plan, MotionBlur_RunsWhereSomethingMoves) {
  const auto with = [](std::string_view fields) {
    return planned(fmt::format(R"("render": {{"method": "tiles"}}, "passes": {{"motion_blur": {{}}}}{}{})",
                               fields.empty() ? "" : ", ", fields));
  };
  const Plan still = with("");
  EXPECT_EQ(why_left_out(still, "motion_blur"), "nothing moves: neither head, hair nor camera");
  EXPECT_EQ(names(still), names(planned(R"("render": {"method": "tiles"})")));
  const std::string_view held = R"("camera": {"position_m": [0, 0, 1], "keys": [{"time_s": 0}, {"time_s": 1}]})";
  EXPECT_EQ(find_pass(with(held), "motion_blur"), nullptr);
  for (const auto& [fields, why] :
       {std::pair(R"("motion": {"bvh": ")" CUTICLE_SOURCE_DIR R"(/scenes/motion/head_turn.bvh"})", "the head moves"),
        {R"("simulation": {"solver": {"classic": {}}})", "the hair is simulated"},
        {R"("camera": {"turntable_deg_per_frame": 2})", "the camera moves"},
        {R"("camera": {"position_m": [0, 0, 1], "keys": [{"time_s": 0}, {"time_s": 1, "target_m": [0, 0.1, 0]}]})",
         "the camera moves"}}) {
    const Plan plan = with(fields);
    ASSERT_NE(find_pass(plan, "motion_blur"), nullptr) << fields;
    EXPECT_THAT(find_pass(plan, "motion_blur")->reason, HasSubstr(why));
  }
}

TEST(Plan, NoLight_HasNoShadowAndNoTables) {
  const Plan plan = planned(R"("shadow": {"method": {"opacity_map": {}}})");
  EXPECT_EQ(find_pass(plan, "opacity_map"), nullptr);
  EXPECT_EQ(find_pass(plan, "bake_tables"), nullptr);
  EXPECT_EQ(why_left_out(plan, "opacity_map"), "the scene has no light");
}

TEST(Plan, NoShadowMethod_HasNoShadow) {
  const Plan plan = planned(R"("lights": [{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}])");
  EXPECT_EQ(find_pass(plan, "opacity_map"), nullptr);
  EXPECT_EQ(why_left_out(plan, "opacity_map"), "the scene names no shadow method");
}

TEST(Plan, ShadowsOfSurfaces_AreWhereHairCastsUnlessRefused) {
  const auto with = [](std::string_view passes) {
    return planned(fmt::format(R"({}, "passes": {{"surface_shadow": {}}})", k_full, passes));
  };
  const Plan unsaid = planned(k_full);
  EXPECT_THAT(find_pass(unsaid, "surface_shadow")->reason, HasSubstr("the scene has shadows"));
  EXPECT_EQ(names(with("{}")), names(unsaid));
  EXPECT_EQ(why_left_out(with(R"({"wanted": false})"), "surface_shadow"),
            "the scene wants no shadows between hair and surfaces");
  const std::string_view light = R"("lights": [{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}])";
  EXPECT_EQ(why_left_out(planned(light), "surface_shadow"), "the scene names no shadow method");
  EXPECT_NE(find_pass(planned(fmt::format(R"({}, "passes": {{"surface_shadow": {{}}}})", light)), "surface_shadow"),
            nullptr)
      << "asked for without a method";
  EXPECT_EQ(why_left_out(planned(fmt::format(R"({}, "head": {{"present": false}})", k_full)), "surface_shadow"),
            "the scene has no head");
}

TEST(Plan, NoColliders_HasNoCollision) {
  const Plan plan = planned(R"("simulation": {"solver": {"classic": {}}, "effects": {"colliders": {}}})");
  EXPECT_EQ(find_pass(plan, "colliders"), nullptr);
  EXPECT_EQ(why_left_out(plan, "colliders"), "the scene has no colliders");
}

TEST(Plan, ColliderThatMovesByItself_IsMet) {
  const Plan plan = planned(R"("simulation": {"solver": {"classic": {}}, "effects": {"colliders": {}}}, "colliders": {
    "spheres": [{"center_m": [0, 0, 0], "radius_m": 0.1, "motion": {"keys": [{"time_s": 0}]}}]})");
  EXPECT_NE(find_pass(plan, "colliders"), nullptr);
}

TEST(Plan, NoSimulation_SimulatesNothing) {
  const Plan plan = planned(R"("colliders": {"head": true})");
  for (const PlannedPass& pass : plan.passes)
    EXPECT_NE(pass.entry->stage, registry::Stage::simulate) << pass.entry->name;
  EXPECT_EQ(why_left_out(plan, "classic"), "the hair is not simulated");
}

TEST(Plan, EffectNotAskedFor_IsLeftOut) {
  const Plan plan = planned(R"("simulation": {"solver": {"classic": {}}})");
  EXPECT_EQ(find_pass(plan, "gravity"), nullptr);
  EXPECT_EQ(why_left_out(plan, "gravity"), "the scene does not ask for 'gravity'");
}

TEST(Plan, NoHead_DrawsNone) {
  EXPECT_EQ(why_left_out(planned(R"("head": {"present": false})"), "head"), "the scene has no head");
}

TEST(Plan, NoPicture_NeitherGeneratesNorShades) {
  const Plan plan = planned(R"("outputs": {"color": false})");
  EXPECT_THAT(names(plan), testing::IsEmpty());
  EXPECT_EQ(why_left_out(plan, "lines"), "no picture is wanted");
}

TEST(Plan, OtherMethod_IsLeftOutByName) {
  EXPECT_EQ(why_left_out(planned(k_full), "none"), "the scene's shadow method is 'opacity_map'");
}

TEST(Plan, Reason_NamesTheFacts) {
  const Plan plan = planned(k_full);
  EXPECT_THAT(find_pass(plan, "opacity_map")->reason, HasSubstr("2 lights"));
  EXPECT_THAT(find_pass(plan, "opacity_map")->reason, HasSubstr("opacity_map"));
}

TEST(Plan, Dispatches_GrowWithLightsAndSubsteps) {
  const Plan plan = planned(k_full);
  EXPECT_EQ(find_pass(plan, "opacity_map")->dispatches % 2, 0u);
  EXPECT_GT(find_pass(plan, "opacity_map")->dispatches, 0u);
  EXPECT_EQ(find_pass(plan, "classic")->dispatches % 8, 0u);
  EXPECT_GT(find_pass(plan, "classic")->dispatches, 0u);
}

TEST(Plan, ModelByItsFormulas_TakesTwoDispatchesMoreForEachLight) {
  const auto dispatches = [](std::string_view method, std::string_view evaluate, std::string_view pass) {
    return find_pass(planned(fmt::format(R"({}, "render": {{"method": "{}"}}, "material": {{"evaluate": "{}"}})",
                                         k_full, method, evaluate)),
                     pass)
        ->dispatches;
  };
  for (const auto& [method, pass] : {std::pair{"tiles", "shade_strands"}, {"lines", "lines"}, {"quads", "quads"}})
    EXPECT_EQ(dispatches(method, "direct", pass), dispatches(method, "tables", pass) + 2 * 2) << method;
}

TEST(Plan, ChannelsOfOtherOpacities_AreShadowedApart) {
  const auto with = [](std::string_view alpha) {
    return planned(fmt::format(R"("lights": [{{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}}],
        "shadow": {{"method": {{"opacity_map": {{}}}}, "fibre_alpha": {}}})",
                               alpha));
  };
  const Plan one = with("0.4"), equal = with("[0.4, 0.4, 0.4]"), two = with("[0.2, 0.4, 0.4]"),
             three = with("[0.2, 0.4, 0.6]");
  const auto dispatches = [](const Plan& plan) { return find_pass(plan, "opacity_map")->dispatches; };
  EXPECT_EQ(to_json(one), to_json(equal));
  EXPECT_EQ(dispatches(two), 2 * dispatches(one));
  EXPECT_EQ(dispatches(three), 3 * dispatches(one));
  EXPECT_FALSE(one.facts.at("coloured_shadow").holds);
  EXPECT_TRUE(two.facts.at("coloured_shadow").holds);
  EXPECT_THAT(find_pass(three, "opacity_map")->reason, HasSubstr("3 times a light: opacity 0.2, 0.4, 0.6"));
}

TEST(Plan, ProportionalChannels_AreShadowedOnceAndRaisedToPowers) {
  const auto dispatches = [](std::string_view alpha) {
    const Plan plan = planned(fmt::format(R"("lights": [{{"to_light": [0, 1, 0], "irradiance": [1, 1, 1]}}],
        "shadow": {{"method": {{"opacity_map": {{"accumulate": "poisson"}}}}, "fibre_alpha": {}}})",
                                          alpha));
    return find_pass(plan, "opacity_map")->dispatches;
  };
  EXPECT_EQ(dispatches("[0.2, 0.4, 0.6]"), dispatches("0.4") + 2);
  EXPECT_EQ(dispatches("[0.001, 0.4, 0.6]"), 3 * dispatches("0.4"));
}

/// Scenes that together run every pass of the catalogue but those of characters.
std::vector<Plan> many_plans() {
  std::vector<Plan> plans;
  for (const char* method : {"lines", "quads", "tiles", "cards", "supersampled", "reference"})
    for (const char* evaluate : {"tables", "direct"})
      plans.push_back(planned(fmt::format(
          R"({}, "render": {{"method": "{}"}}, "material": {{"model": {{"chiang": {{}}}}, "evaluate": "{}"}},
             "floor": {{"height_m": -0.2}}, "passes": {{"ambient_occlusion": {{}}, "temporal_antialiasing": {{}},
             "depth_of_field": {{}}, "motion_blur": {{}}, "velocity": {{}}, "surface_shadow": {{}}, "dual_scattering": {{}}}})",
          k_full, method, evaluate)));
  return plans;
}

std::size_t place(const Plan& plan, const registry::Entry* entry) {
  return std::size_t(std::ranges::find(plan.passes, entry, &PlannedPass::entry) - plan.passes.begin());
}

TEST(Plan, Resource_IsMadeBeforeItIsRead) {
  for (const Plan& plan : many_plans())
    for (const PlannedResource& resource : plan.resources)
      for (const registry::Entry* writer : resource.writers)
        for (const registry::Entry* reader : resource.readers)
          EXPECT_LT(place(plan, writer), place(plan, reader))
              << resource.name << ": " << writer->name << ", " << reader->name;
}

TEST(Plan, PassOfThePicture_MakesWhatIsReadOrWanted) {
  for (const Plan& plan : many_plans())
    for (const PlannedPass& pass : plan.passes) {
      const auto uses = uses_of(*pass.entry);
      EXPECT_TRUE(uses.empty() || std::ranges::any_of(plan.resources,
                                                      [&](const PlannedResource& resource) {
                                                        const bool wanted =
                                                            std::ranges::find(plan.outputs, resource.name) !=
                                                            plan.outputs.end();
                                                        return (wanted || !resource.readers.empty()) &&
                                                               std::ranges::find(resource.writers, pass.entry) !=
                                                                   resource.writers.end();
                                                      }))
          << pass.entry->name;
    }
}

TEST(Plan, PathsTraced_LeaveOutWhatRasteringReads) {
  const Plan plan =
      planned(fmt::format(R"({}, "render": {{"method": "reference"}}, "passes": {{"surface_shadow": {{}}}})", k_full));
  EXPECT_EQ(why_left_out(plan, "head"), "no pass of this scene reads 'drawn_surfaces'");
  EXPECT_EQ(why_left_out(plan, "bake_tables"), "no pass of this scene reads 'tables'");
  EXPECT_EQ(find_pass(plan, "opacity_map"), nullptr);
}

TEST(Plan, MotionVectors_BringWhatTheyAreMadeOf) {
  const Plan plan = planned(R"("render": {"method": "quads"}, "passes": {"temporal_antialiasing": {}})");
  EXPECT_EQ(find_pass(plan, "aovs")->reason, "'pixel_depth' reads 'layers'; 'velocity' reads 'layers'");
  EXPECT_EQ(find_pass(plan, "interpolate_velocities"), nullptr) << "velocities are in no file";
  EXPECT_NE(
      find_pass(planned(R"("render": {"method": "quads"}, "passes": {"velocity": {}})"), "interpolate_velocities"),
      nullptr);
}

TEST(Plan, EveryEntry_IsPlannedOrLeftOutOnce) {
  const Plan plan = planned(k_full);
  const scene::Catalogue& all = catalogue();
  EXPECT_EQ(plan.passes.size() + plan.left_out.size(),
            all.methods.size() + all.solvers.size() + all.effects.size() + all.passes.size());
}

TEST(Plan, Text_ListsPassesReasonsAndWhatIsLeftOut) {
  const std::string text = to_text(planned(R"("head": {"present": false})"));
  EXPECT_THAT(text, HasSubstr("lines"));
  EXPECT_THAT(text, HasSubstr("the scene has no head"));
}

std::string refusal_of_told_strands(std::string_view fields) {
  const auto scene =
      scene::parse_scene(fmt::format(R"({{"schema_version": 1, {}}})", fields), "/", "test", catalogue());
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
  const Result<void> checked = check_told_strands(*scene);
  return checked ? "" : checked.error().message;
}

TEST(ToldStrands, WayOfDrawingThatCannotTell_IsRefusedByName) {
  for (std::string_view way : {"lines", "quads", "cards"})
    for (std::string_view output : {"deep", "cryptomatte"})
      EXPECT_THAT(refusal_of_told_strands(
                      fmt::format(R"("render": {{"method": "{}"}}, "outputs": {{"{}": true}})", way, output)),
                  HasSubstr(fmt::format("'{}' does not tell strands apart", way)));
  for (std::string_view way : {"tiles", "supersampled", "reference"})
    EXPECT_EQ(refusal_of_told_strands(fmt::format(R"("render": {{"method": "{}"}}, "outputs": {{"deep": true}})", way)),
              "");
  EXPECT_EQ(refusal_of_told_strands(R"("render": {"method": "lines"})"), "") << "not asked for";
}

TEST(ToldStrands, PassThatMovesLight_IsRefusedWhereItRuns) {
  constexpr std::string_view k_lens = R"("outputs": {"deep": true}, "passes": {"depth_of_field": {}}, "render")";
  EXPECT_THAT(refusal_of_told_strands(fmt::format(R"({}: {{"method": "tiles"}})", k_lens)),
              HasSubstr("'depth_of_field' moves light between pixels"));
  EXPECT_EQ(refusal_of_told_strands(fmt::format(R"({}: {{"method": "reference"}})", k_lens)), "");
  constexpr std::string_view k_blur =
      R"("outputs": {"deep": true}, "passes": {"motion_blur": {}}, "render": {"method": "tiles"})";
  EXPECT_EQ(refusal_of_told_strands(k_blur), "") << "nothing moves";
  EXPECT_THAT(refusal_of_told_strands(fmt::format(R"({}, "camera": {{"turntable_deg_per_frame": 1}})", k_blur)),
              HasSubstr("'motion_blur' moves light between pixels"));
}

TEST(ToldStrands, SlicesOfDepth_AreRefused) {
  EXPECT_THAT(
      refusal_of_told_strands(
          R"("outputs": {"deep": true}, "passes": {"tile_sort": {"slices": 8}}, "render": {"method": "tiles"})"),
      HasSubstr("strands of one slice are not sorted"));
}

}  // namespace
}  // namespace cuticle::plan::plan_test
