// What a plan leaves out: grouped, with what would bring it in and what that would cost.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "plan/plan_report.h"

namespace cuticle::plan {

namespace {

constexpr std::string_view k_groups[] = {"simulation", "shadows", "drawing", "picture"};

bool holds(const Plan& plan, const registry::Entry* entry) {
  return std::ranges::any_of(plan.passes, [&](const PlannedPass& pass) { return pass.entry == entry; });
}

/// Whether a pass takes no time of its own: what dispatches and draws nothing, unless it makes a picture or transmittance
/// by work on the CPU, of which no time is known.
bool is_free(const PlannedPass& pass) {
  const registry::Entry& entry = *pass.entry;
  const bool makes_all = entry.stage == registry::Stage::resolve || entry.name == "supersampled";
  return pass.dispatches + pass.draws == 0 && !pass.on_cpu && !makes_all;
}

/// What runs in one plan and not in the other; none: of some of it no time is known.
std::optional<double> ms_of_others(const CostTable& table, const Plan& in, const Plan& not_in, double pixels) {
  double ms = 0;
  for (const PlannedPass& pass : in.passes) {
    if (holds(not_in, pass.entry)) continue;
    const auto own = predicted_ms(table, *pass.entry, in.shape, pixels);
    if (!own && is_free(pass)) continue;
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

namespace {

/// Two digits, in the unit that fits.
std::string in_words(double ms) {
  if (std::abs(ms) < 0.005) return "no time of its own";
  const double digit = std::pow(10, std::floor(std::log10(std::abs(ms))) - 1);
  const double rounded = std::round(ms / digit) * digit;
  return std::abs(rounded) < 1000 ? fmt::format("{:g} ms", rounded) : fmt::format("{:g} s", rounded / 1000);
}

}  // namespace

std::string words_of_cost(const LeftOutEntry& entry) {
  if (!entry.more_ms) return "not measured";
  return (*entry.more_ms >= 0.005 ? "+" : "") + in_words(*entry.more_ms);
}

std::string words_of_saving(const GroupSaving& group) {
  std::string text = fmt::format("{}: {} left out", group.group, group.entries);
  if (group.alternatives > 0) text += fmt::format(", {} of them in favour of another way", group.alternatives);
  if (const std::size_t others = group.entries - group.alternatives; group.not_measured < others)
    text += fmt::format("; the others save {}", in_words(group.ms));
  if (group.not_measured > 0) text += fmt::format(" ({} of them not measured)", group.not_measured);
  return text;
}

}  // namespace cuticle::plan
