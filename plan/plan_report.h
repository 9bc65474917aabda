#pragma once
// A plan told to a person: facts, passes with their cost, and what was left out with what would bring it in.
#include <map>
#include <optional>
#include <string>

#include "plan/cost_table.h"
#include "plan/frame_plan.h"
#include "plan/scene_changes.h"

namespace cuticle::plan {

/// What is known of a plan's cost on a device. All may be absent: then it reads "not measured".
struct PlanCosts {
  DeviceTraits device;
  std::optional<CostTable> table;
  std::optional<FramePlan> frame;                          ///< its passes in the order of the plan that is reported
  std::map<std::string, double, std::less<>> measured_ms;  ///< of that frame
  std::map<std::string, std::size_t, std::less<>> bytes;   ///< device memory by what holds it
};

/// "simulation", "shadows", "drawing" or "picture".
std::string_view group_of(const registry::Entry& entry);

/// An entry that the plan leaves out.
struct LeftOutEntry {
  const LeftOut* left = nullptr;
  std::optional<WayIn> way;       ///< none: no change of up to four keys
  std::optional<double> more_ms;  ///< what a frame would take more, of the changed plan; none: not measured
  bool is_alternative = false;    ///< it would take the place of what runs
};
/// In the order of the groups, then of names.
std::vector<LeftOutEntry> explain_left_out(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs);

/// What the left-out entries of a group would take together, alternatives aside; and how many were not measured.
struct GroupSaving {
  std::string_view group;
  std::size_t entries = 0, not_measured = 0, alternatives = 0;
  double ms = 0;
};
std::vector<GroupSaving> savings(std::span<const LeftOutEntry> left_out);

/// "floor": {...}; +1.20 ms or "not measured"; "shadows: 9 left out, ...".
std::string words_of_way(const LeftOutEntry& entry);
std::string words_of_cost(const LeftOutEntry& entry);
std::string words_of_saving(const GroupSaving& group);

std::string report_text(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs);
std::string report_json(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs);
/// Everything about one pass. Error: usage naming the nearest, where there is none of the name.
Result<std::string> report_why(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs,
                               std::string_view pass);
/// A Graphviz graph: facts, the passes that they demand, and what these hand to each other.
std::string report_dot(const Plan& plan);

}  // namespace cuticle::plan
