#include "plan/frame_plan.h"

#include <algorithm>

#include <fmt/core.h>

namespace cuticle::plan {

namespace {

using registry::Fact;
using registry::Stage;

bool demands(const registry::Entry& entry, std::string_view fact) {
  return std::ranges::find(entry.demands, fact) != entry.demands.end();
}

/// Light is asked for on the side of a strand that the camera sees (docs/conventions.md, "Transmittance"); the passes
/// of the stage write into the same transmittance, one after the other.
bool receives_by_view(const registry::Entry& entry) { return entry.stage == Stage::shadow; }

/// The facts of the frame that this pass waits for, each with what it is called there.
std::vector<std::pair<std::string_view, const Fact*>> waits_for(const registry::Entry& entry,
                                                                const FrameMeasures& measures) {
  if (entry.stage == Stage::simulate) {
    std::vector<std::pair<std::string_view, const Fact*>> facts{{"hair_awake", &measures.hair_awake}};
    if (entry.name == "colliders") facts.emplace_back("colliders_in_reach", &measures.colliders_in_reach);
    return facts;
  }
  std::vector<std::pair<std::string_view, const Fact*>> facts;
  if (needs_hair(entry)) facts.emplace_back("hair_seen", &measures.hair_seen);
  const bool made_of_hair = entry.stage == Stage::generate || entry.stage == Stage::shadow;
  const bool else_changed = (demands(entry, "surfaces") && measures.surfaces_changed.holds) ||
                            (receives_by_view(entry) && measures.view_changed.holds);
  if (made_of_hair && !else_changed) facts.emplace_back("hair_changed", &measures.hair_changed);
  return facts;
}

/// Nothing in view is other than it was.
bool same_picture(const FrameMeasures& measures) {
  const bool hair = measures.hair_changed.holds && measures.hair_seen.holds;
  return !hair && !measures.surfaces_changed.holds && !measures.view_changed.holds;
}

FramePass judge(const PlannedPass& pass, const FrameMeasures& measures) {
  const Stage stage = pass.entry->stage;
  if (stage != Stage::simulate && same_picture(measures))
    return {&pass, false,
            fmt::format("as in the frame before: {}; {}", measures.hair_changed.why, measures.view_changed.why)};
  for (const auto& [name, fact] : waits_for(*pass.entry, measures))
    if (!fact->holds) return {&pass, false, fact->why};
  return {&pass, true, pass.reason};
}

}  // namespace

bool needs_hair(const registry::Entry& entry) {
  if (entry.stage == Stage::generate || entry.stage == Stage::shadow) return true;
  return demands(entry, "strands") && entry.stage != Stage::prepare;
}

bool FramePlan::runs(std::string_view pass) const {
  const auto found =
      std::ranges::find_if(passes, [&](const FramePass& each) { return each.pass->entry->name == pass; });
  return found != passes.end() && found->runs;
}

bool FramePlan::paints() const {
  return std::ranges::any_of(
      passes, [](const FramePass& pass) { return pass.runs && pass.pass->entry->stage > Stage::simulate; });
}

FramePlan plan_frame(const Plan& plan, int frame, const FrameMeasures& measures) {
  FramePlan made{frame,
                 {{"hair_awake", measures.hair_awake},
                  {"colliders_in_reach", measures.colliders_in_reach},
                  {"hair_changed", measures.hair_changed},
                  {"surfaces_changed", measures.surfaces_changed},
                  {"view_changed", measures.view_changed},
                  {"hair_seen", measures.hair_seen}},
                 {}};
  for (const PlannedPass& pass : plan.passes) made.passes.push_back(judge(pass, measures));
  return made;
}

}  // namespace cuticle::plan
