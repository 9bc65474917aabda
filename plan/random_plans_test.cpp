// Scenes put together by chance from everything that a scene can have: of every effect, solver, shadow method and pass,
// it is planned if and only if its facts hold, the scene chose it, and somebody wants what it makes.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "plan/scene_changes.h"
#include "render/resource.h"

namespace cuticle::plan::random_plans_test {
namespace {

using render::Access, render::Use;

scene::Scene scene_by_chance(std::mt19937& chance) {
  scene::Scene scene;
  const unsigned one_in = 2 + chance() % 6;
  for (const SceneChange& change : scene_changes())
    if (chance() % one_in == 0) change.make(scene);
  scene.outputs.color = chance() % 8 != 0;
  return scene;
}

bool makes(const Use& use) { return use.access == Access::writes || use.access == Access::changes; }

bool asks(const Use& use) { return use.access == Access::reads || use.access == Access::may_read; }

bool is_output(const Plan& plan, std::string_view resource) {
  return std::ranges::find(plan.outputs, resource) != plan.outputs.end();
}

/// Whether some pass of the plan other than `but` has a use of the resource that fits.
bool some_pass(const Plan& plan, std::string_view resource, const registry::Entry* but, auto&& fits) {
  return std::ranges::any_of(plan.passes, [&](const PlannedPass& pass) {
    return pass.entry != but && std::ranges::any_of(uses_of(*pass.entry), [&](const Use& use) {
             return use.resource == resource && fits(use);
           });
  });
}

/// Whether a use counts in this plan: for all frames, or for a resource that is asked for and a fact that holds.
bool counts(const Plan& plan, const Use& use) {
  const bool asked = use.for_resource.empty() || is_output(plan, use.for_resource) ||
                     some_pass(plan, use.for_resource, nullptr, [](const Use& other) { return asks(other); });
  return asked && (use.where_fact.empty() || plan.facts.find(use.where_fact)->second.holds);
}

/// Whether anybody wants what the entry makes: it is an output, or another planned pass asks for it.
bool is_wanted(const Plan& plan, const registry::Entry& entry) {
  return std::ranges::any_of(uses_of(entry), [&](const Use& use) {
    return makes(use) && (is_output(plan, use.resource) || some_pass(plan, use.resource, &entry, [&](const Use& other) {
                            return asks(other) && counts(plan, other);
                          }));
  });
}

/// Resources that some pass can make: the others the scene gives.
std::set<std::string_view> made_by_any() {
  std::set<std::string_view> made;
  for (const registry::Entry* entry : catalogue().passes)
    for (const Use& use : uses_of(*entry))
      if (use.access == Access::writes) made.insert(use.resource);
  return made;
}

/// A resource that the entry must read and no planned pass makes; empty: there is none.
std::string_view missing_source(const Plan& plan, const registry::Entry& entry) {
  static const std::set<std::string_view> made = made_by_any();
  for (const Use& use : uses_of(entry))
    if (use.access == Access::reads && made.contains(use.resource) &&
        !some_pass(plan, use.resource, nullptr, [](const Use& other) { return other.access == Access::writes; }))
      return use.resource;
  return {};
}

/// What the scene names of which it can have one.
bool is_chosen(const scene::Scene& scene, const registry::Entry& entry) {
  if (entry.kind == registry::EntryKind::method) return scene.shadow && scene.shadow->name == entry.name;
  const auto solvers = catalogue().solvers;
  if (std::ranges::find(solvers, &entry) == solvers.end()) return true;
  return scene.simulation.solver && scene.simulation.solver->name == entry.name;
}

struct Seen {
  int planned = 0, left_out = 0;
};

void expect_planned_as_demanded(const scene::Scene& scene, std::map<const registry::Entry*, Seen>& seen) {
  registry::FrameShape shape;
  shape.lights = std::uint32_t(scene.lights.size());
  const Plan plan = make_plan(scene, shape);
  std::set<const registry::Entry*> found;
  for (const PlannedPass& pass : plan.passes) {
    const registry::Entry& entry = *pass.entry;
    ++seen[&entry].planned;
    EXPECT_TRUE(found.insert(&entry).second) << entry.name << " is planned twice";
    EXPECT_TRUE(registry::judge(entry, plan.facts).demanded) << entry.name;
    EXPECT_TRUE(is_chosen(scene, entry)) << entry.name;
    EXPECT_FALSE(pass.reason.empty()) << entry.name;
    EXPECT_TRUE(uses_of(entry).empty() || is_wanted(plan, entry)) << entry.name << " makes what nobody wants";
    EXPECT_EQ(missing_source(plan, entry), "") << entry.name;
  }
  for (const LeftOut& left : plan.left_out) {
    const registry::Entry& entry = *left.entry;
    ++seen[&entry].left_out;
    EXPECT_TRUE(found.insert(&entry).second) << entry.name << " is planned and left out";
    EXPECT_FALSE(left.reason.empty()) << entry.name;
    const bool could_run = registry::judge(entry, plan.facts).demanded && is_chosen(scene, entry) &&
                           (uses_of(entry).empty() || is_wanted(plan, entry)) && missing_source(plan, entry).empty();
    EXPECT_FALSE(could_run) << entry.name << " is left out because: " << left.reason;
  }
  for (const auto& entries : {catalogue().solvers, catalogue().effects, catalogue().methods, catalogue().passes})
    for (const registry::Entry* entry : entries) EXPECT_TRUE(found.contains(entry)) << entry->name;
}

TEST(RandomPlans, EveryEffectAndPass_IsPlannedIfAndOnlyIfItsFactsHoldAndItsResultIsWanted) {
  std::mt19937 chance(2026);
  std::map<const registry::Entry*, Seen> seen;
  for (int k = 0; k < 2000 && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(k);
    expect_planned_as_demanded(scene_by_chance(chance), seen);
  }
  for (const auto& [entry, times] : seen) {
    EXPECT_GT(times.planned, 0) << entry->name << " was never planned";
    EXPECT_GT(times.left_out, 0) << entry->name << " was never left out";
  }
}

}  // namespace
}  // namespace cuticle::plan::random_plans_test
