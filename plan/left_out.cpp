// What a plan leaves out: grouped, with what would bring it in and what that would cost.
#include <algorithm>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "plan/plan_report.h"

namespace cuticle::plan {

namespace {

constexpr std::string_view k_groups[] = {"simulation", "shadows", "drawing", "picture"};

bool holds(const Plan& plan, const registry::Entry* entry) {
  return std::ranges::any_of(plan.passes, [&](const PlannedPass& pass) { return pass.entry == entry; });
}

/// What runs in one plan and not in the other; none: of some of it no time is known. What dispatches and draws nothing
/// takes none of its own.
std::optional<double> ms_of_others(const CostTable& table, const Plan& in, const Plan& not_in, double pixels) {
  double ms = 0;
  for (const PlannedPass& pass : in.passes) {
    if (holds(not_in, pass.entry)) continue;
    const auto own = predicted_ms(table, *pass.entry, in.shape, pixels);
    if (!own && pass.dispatches + pass.draws == 0 && !pass.on_cpu) continue;
    if (!own) return std::nullopt;
    ms += *own;
  }
  return ms;
}

LeftOutEntry explain(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs, const LeftOut& left) {
  LeftOutEntry entry{.left = &left, .way = way_in(scene, plan.shape, costs.device, *left.entry), .more_ms = {}};
  if (!entry.way) return entry;
  entry.is_alternative =
      std::ranges::any_of(plan.passes, [&](const PlannedPass& pass) { return !holds(entry.way->plan, pass.entry); });
  if (!costs.table) return entry;
  const auto added = ms_of_others(*costs.table, entry.way->plan, plan, pixels_of(scene)),
             spared = ms_of_others(*costs.table, plan, entry.way->plan, pixels_of(scene));
  if (added && spared) entry.more_ms = *added - *spared;
  return entry;
}

std::size_t place_of(std::string_view group) {
  return std::size_t(std::ranges::find(k_groups, group) - std::begin(k_groups));
}

}  // namespace

std::string_view group_of(const registry::Entry& entry) {
  using registry::Stage;
  if (entry.stage == Stage::simulate) return "simulation";
  if (entry.kind == registry::EntryKind::method || entry.stage == Stage::shadow) return "shadows";
  return entry.stage < Stage::resolve ? "drawing" : "picture";
}

std::vector<LeftOutEntry> explain_left_out(const scene::Scene& scene, const Plan& plan, const PlanCosts& costs) {
  std::vector<LeftOutEntry> entries;
  for (const LeftOut& left : plan.left_out) entries.push_back(explain(scene, plan, costs, left));
  std::ranges::stable_sort(entries, {}, [](const LeftOutEntry& entry) {
    return std::pair(place_of(group_of(*entry.left->entry)), entry.left->entry->name);
  });
  return entries;
}

std::vector<GroupSaving> savings(std::span<const LeftOutEntry> left_out) {
  std::vector<GroupSaving> groups;
  for (std::string_view group : k_groups) groups.push_back({group});
  for (const LeftOutEntry& entry : left_out) {
    GroupSaving& group = groups[place_of(group_of(*entry.left->entry))];
    ++group.entries;
    if (entry.is_alternative)
      ++group.alternatives;
    else if (entry.more_ms)
      group.ms += *entry.more_ms;
    else
      ++group.not_measured;
  }
  return groups;
}

std::string words_of_way(const LeftOutEntry& entry) {
  return entry.way ? fmt::format("{}", fmt::join(entry.way->changes, " and ")) : "no change of up to four keys does";
}

std::string words_of_cost(const LeftOutEntry& entry) {
  return entry.more_ms ? fmt::format("{:+.2f} ms", *entry.more_ms) : "not measured";
}

std::string words_of_saving(const GroupSaving& group) {
  std::string text = fmt::format("{}: {} left out", group.group, group.entries);
  if (group.not_measured < group.entries - group.alternatives) text += fmt::format(", {:.2f} ms saved", group.ms);
  if (group.alternatives > 0) text += fmt::format(", {} of them other ways of what runs", group.alternatives);
  if (group.not_measured > 0) text += fmt::format(", {} not measured", group.not_measured);
  return text;
}

}  // namespace cuticle::plan
