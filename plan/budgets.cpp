#include "plan/budgets.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "core/file.h"
#include "core/json/json.h"
#include "plan/opacity_runs.h"
#include "sim/solver.h"

namespace cuticle::plan {

namespace {

struct Part {
  std::string_view name;
  double scene::Budgets::*wanted;
};
constexpr Part k_parts[] = {{"shadow", &scene::Budgets::shadow},
                            {"coverage", &scene::Budgets::coverage},
                            {"shading", &scene::Budgets::shading},
                            {"motion", &scene::Budgets::motion}};

Json row_json(const AccuracyRow& row) {
  return {{"part", row.part},   {"method", row.method},   {"settings", row.settings},
          {"error", row.error}, {"at_most", row.at_most}, {"grooms", row.grooms}};
}

AccuracyRow row_of(const Json& json) {
  return {json.at("part").text(),    json.at("method").text(),    json.at("settings").text(),
          json.at("error").number(), json.at("at_most").number(), int(json.at("grooms").whole())};
}

Result<const registry::Entry*> entry_of(std::span<const registry::Entry* const> entries, std::string_view name) {
  const auto found = std::ranges::find(entries, name, &registry::Entry::name);
  if (found == entries.end()) return usage_error(fmt::format("'{}' is not in this build", name));
  return *found;
}

/// Whether the scene has the part at all, so that there is something to choose.
bool has_part(const Plan& plan, const scene::Scene& scene, std::string_view part) {
  if (part == "shadow") return scene.shadow && plan.facts.at("light").holds && scene.outputs.color;
  if (part == "motion") return scene.simulation.solver.has_value();
  return scene.outputs.color && plan.facts.at("drawn_on_device").holds && scene.render_method != "cards" &&
         (part == "coverage" || scene.material.evaluate == "tables");
}

/// Of a part: what keeps the error wanted; only the solver that the scene has is in question.
std::vector<AccuracyRow> candidates(const scene::Scene& scene, const AccuracyTable& accuracy, std::string_view part,
                                    double wanted) {
  std::vector<AccuracyRow> rows;
  for (const AccuracyRow& row : accuracy.rows)
    if (row.part == part && (wanted == 0 || row.at_most <= wanted) &&
        (part != "motion" || row.method == scene.simulation.solver->name))
      rows.push_back(row);
  return rows;
}

std::string no_candidate(const AccuracyTable& accuracy, std::string_view part, double wanted) {
  const AccuracyRow* best = nullptr;
  for (const AccuracyRow& row : accuracy.rows)
    if (row.part == part && (!best || row.at_most < best->at_most)) best = &row;
  if (!best) return fmt::format("budgets.error.{}: the study's table has nothing of it", part);
  return fmt::format("budgets.error.{} = {:g}: no setting keeps it; the nearest, {} {}, stays below {:.3g}", part,
                     wanted, best->method, best->settings, best->at_most);
}

/// The candidates of each part in question. What nobody limits stays as the scene has it, unless time or memory is
/// short.
std::vector<std::vector<AccuracyRow>> parts_of(const scene::Scene& scene, const Plan& plan,
                                               const AccuracyTable& accuracy) {
  std::vector<std::vector<AccuracyRow>> parts;
  for (const Part& part : k_parts) {
    const double wanted = *scene.budgets.*part.wanted;
    if (!has_part(plan, scene, part.name) || (wanted == 0 && part.name == "motion")) continue;
    if (wanted == 0 && scene.budgets->frame_ms == 0 && scene.budgets->memory_mb == 0) continue;
    if (auto rows = candidates(scene, accuracy, part.name, wanted); !rows.empty()) parts.push_back(std::move(rows));
  }
  return parts;
}

registry::FrameShape shape_with(const scene::Scene& scene, registry::FrameShape shape) {
  if (!scene.simulation.solver) return shape;
  const auto solver = sim::find_effect(scene.simulation.solver->name);
  if (solver && (*solver)->substeps)
    shape.substeps = (*solver)->substeps(scene.simulation.solver->values, 1 / scene.frames_per_second);
  return shape;
}

/// Of all passes that do something; none: some have no time on this device, and are added to `untimed`.
std::optional<double> expected_ms(const scene::Scene& scene, const registry::FrameShape& shape,
                                  const DeviceTraits& device, const CostTable& costs, std::span<const AccuracyRow> rows,
                                  std::set<std::string>& untimed) {
  const Plan plan = make_plan(scene, shape_with(scene, shape), device);
  double ms = 0;
  bool all_timed = true;
  for (const PlannedPass& pass : plan.passes) {
    if (pass.dispatches + pass.draws == 0 && !(pass.on_cpu && pass.entry->name == scene.simulation.solver->name))
      continue;
    const auto row = std::ranges::find(rows, pass.entry->name, &AccuracyRow::method);
    const std::string name =
        row == rows.end() || row->part != "shadow" ? std::string(pass.entry->name) : cost_name(*row);
    const auto time = costs.passes.find(name);
    if (time == costs.passes.end()) {
      untimed.insert(name);
      all_timed = false;
      continue;
    }
    const bool is_method = pass.entry->kind == registry::EntryKind::method;
    ms += (is_method ? opacity_runs(scene).runs : 1) * (time->second.fixed + time->second.per_pixel * pixels_of(scene) +
                                                        time->second.per_unit * units_of(*pass.entry, plan.shape));
  }
  return all_timed ? std::optional(ms) : std::nullopt;
}

/// Whether one choice is better than another, both within the errors wanted.
bool is_better(const BudgetChoice& a, const BudgetChoice& b, const scene::Budgets& wanted) {
  const bool errors_wanted = wanted.shadow + wanted.coverage + wanted.shading + wanted.motion > 0;
  const auto errors = [](const BudgetChoice& choice) {
    double sum = 0;
    for (const AccuracyRow& row : choice.rows) sum += row.at_most;
    return sum;
  };
  const double a_ms = *a.expected_ms, b_ms = *b.expected_ms;
  if (errors_wanted) return a_ms < b_ms || (a_ms == b_ms && errors(a) < errors(b));
  return errors(a) < errors(b) || (errors(a) == errors(b) && a_ms < b_ms);
}

/// All combinations of the parts' candidates from part k on.
class Search {
 public:
  Search(const scene::Scene& scene, const registry::FrameShape& shape, const DeviceTraits& device,
         const CostTable& costs, const MemoryTable& memory)
      : given_(scene), shape_(shape), device_(device), costs_(costs), memory_(memory) {}

  void walk(std::span<const std::vector<AccuracyRow>> parts, const scene::Scene& scene, std::vector<AccuracyRow> rows) {
    if (parts.empty()) {
      weigh(scene, std::move(rows));
      return;
    }
    for (const AccuracyRow& row : parts.front()) {
      const auto changed = with_setting(scene, row);
      if (!changed) continue;
      std::vector<AccuracyRow> more = rows;
      more.push_back(row);
      walk(parts.subspan(1), *changed, std::move(more));
    }
  }

  BudgetChoice result() const {
    if (best_) return *best_;
    BudgetChoice refused{given_, {}, {}, 0, 0, {}};
    const scene::Budgets& wanted = *given_.budgets;
    if (quickest_.at_most == k_endless)
      refused.refused = without_time();
    else if (wanted.frame_ms > 0 && quickest_.at_most > wanted.frame_ms)
      refused.refused =
          fmt::format("budgets.frame_ms = {:g}: the quickest settings take {:.3g} ms, below {:.3g} with 95 %",
                      wanted.frame_ms, quickest_.expected, quickest_.at_most);
    else if (wanted.memory_mb > 0 && leanest_ > 1e6 * wanted.memory_mb)
      refused.refused = fmt::format("budgets.memory_mb = {:g}: the leanest settings take {:.4g} MB", wanted.memory_mb,
                                    1e-6 * leanest_);
    else
      refused.refused = fmt::format("budgets.frame_ms = {:g} and memory_mb = {:g}: no settings keep both",
                                    wanted.frame_ms, wanted.memory_mb);
    return refused;
  }

 private:
  void weigh(const scene::Scene& scene, std::vector<AccuracyRow> rows) {
    BudgetChoice choice{scene, std::move(rows), {}, 0, 0, {}};
    std::set<std::string> untimed;
    choice.expected_ms = expected_ms(scene, shape_, device_, costs_, choice.rows, untimed);
    if (!choice.expected_ms) return keep_untimed(std::move(untimed));
    choice.at_most_ms = *choice.expected_ms * costs_.most_over_expected;
    choice.expected_bytes = bytes_with(choice.rows);
    if (choice.at_most_ms < quickest_.at_most) quickest_ = {*choice.expected_ms, choice.at_most_ms};
    leanest_ = std::min(leanest_, choice.expected_bytes);
    const scene::Budgets& wanted = *given_.budgets;
    if (wanted.frame_ms > 0 && choice.at_most_ms > wanted.frame_ms) return;
    if (wanted.memory_mb > 0 && choice.expected_bytes > 1e6 * wanted.memory_mb) return;
    if (!best_ || is_better(choice, *best_, wanted)) best_ = std::move(choice);
  }

  /// What every choice lacks the time of; else what any does.
  void keep_untimed(std::set<std::string> untimed) {
    const std::set<std::string> before = std::exchange(untimed_, std::move(untimed));
    if (before.empty()) return;
    std::set<std::string> both;
    std::ranges::set_intersection(before, untimed_, std::inserter(both, both.end()));
    if (both.empty())
      untimed_.insert(before.begin(), before.end());
    else
      untimed_ = std::move(both);
  }

  std::string without_time() const {
    if (costs_.passes.empty()) return "no times are measured on this device: cuticle plan --calibrate";
    return fmt::format(
        "budgets: no time of '{}' is measured on this device; cuticle plan --calibrate times all passes but "
        "those of fins",
        fmt::join(untimed_, "', '"));
  }

  double bytes_with(std::span<const AccuracyRow> rows) const {
    double bytes = memory_.of_scene;
    for (const AccuracyRow& row : rows)
      if (const auto change = memory_.change.find(memory_name(row)); change != memory_.change.end())
        bytes += change->second;
    return bytes;
  }

  static constexpr double k_endless = std::numeric_limits<double>::infinity();
  const scene::Scene& given_;
  const registry::FrameShape& shape_;
  const DeviceTraits& device_;
  const CostTable& costs_;
  const MemoryTable& memory_;
  std::optional<BudgetChoice> best_;
  struct {
    double expected = k_endless, at_most = k_endless;
  } quickest_;
  double leanest_ = k_endless;
  std::set<std::string> untimed_;  ///< passes, and settings of shadow methods, that have no time
};

}  // namespace

Result<AccuracyTable> read_accuracy_table(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  const auto json = Json::parse(text);
  if (!json) return bad_input(fmt::format("{}: {}", path, json.error().message));
  try {
    AccuracyTable table{json->at("made").text(), {}};
    for (const Json& row : json->at("rows")) table.rows.push_back(row_of(row));
    return table;
  } catch (const Json::Mismatch& mismatch) {
    return bad_input(fmt::format("{}: {}", path, mismatch.what()));
  }
}

Result<void> write_accuracy_table(const std::string& path, const AccuracyTable& table) {
  Json rows = Json::list();
  for (const AccuracyRow& row : table.rows) rows.push_back(row_json(row));
  return write_text_file(path, Json{{"made", table.made}, {"rows", rows}}.dump(1) + "\n");
}

std::string cost_name(const AccuracyRow& row) {
  return row.settings.empty() ? row.method : row.method + " " + row.settings;
}

Result<scene::Scene> with_setting(const scene::Scene& scene, const AccuracyRow& row) {
  scene::Scene changed = scene;
  if (row.part == "shadow") {
    CUTICLE_ASSIGN(const registry::Entry* method, entry_of(catalogue().methods, row.method));
    CUTICLE_ASSIGN(auto values, registry::parse_assignments(method->parameters, row.settings));
    changed.shadow = {row.method, std::move(values)};
  } else if (row.part == "coverage") {
    changed.render_method = row.method;
    if (row.settings.empty()) return changed;
    CUTICLE_ASSIGN(const registry::Entry* pass, entry_of(catalogue().passes, row.method));
    CUTICLE_ASSIGN(changed.passes[row.method], registry::parse_assignments(pass->parameters, row.settings));
  } else if (row.part == "shading") {
    changed.material.lut_size = std::atoi(row.settings.c_str() + row.settings.find('=') + 1);
  } else if (changed.simulation.solver) {
    CUTICLE_ASSIGN(const registry::Entry* solver, entry_of(catalogue().solvers, row.method));
    CUTICLE_ASSIGN(const auto values, registry::parse_assignments(solver->parameters, row.settings));
    changed.simulation.solver->values.set("inner_step", values.all().at("inner_step"));
  }
  return changed;
}

std::string memory_name(const AccuracyRow& row) { return fmt::format("{} {}", row.part, cost_name(row)); }

std::vector<AccuracyRow> rows_in_question(const scene::Scene& scene, const registry::FrameShape& shape,
                                          const DeviceTraits& device, const AccuracyTable& accuracy) {
  std::vector<AccuracyRow> rows;
  for (const std::vector<AccuracyRow>& part : parts_of(scene, make_plan(scene, shape, device), accuracy))
    rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

BudgetChoice choose(const scene::Scene& scene, const registry::FrameShape& shape, const DeviceTraits& device,
                    const AccuracyTable& accuracy, const CostTable& costs, const MemoryTable& memory) {
  const Plan plan = make_plan(scene, shape, device);
  for (const Part& part : k_parts)
    if (const double wanted = *scene.budgets.*part.wanted;
        wanted > 0 && has_part(plan, scene, part.name) && candidates(scene, accuracy, part.name, wanted).empty())
      return {scene, {}, {}, 0, 0, no_candidate(accuracy, part.name, wanted)};
  Search search(scene, shape, device, costs, memory);
  search.walk(parts_of(scene, plan, accuracy), scene, {});
  return search.result();
}

std::string to_text(const BudgetChoice& choice, const scene::Budgets& wanted) {
  if (!choice.refused.empty()) return choice.refused + "\n";
  std::string text;
  for (const AccuracyRow& row : choice.rows)
    text += fmt::format("{:<9} {} {}: error {:.3g} expected, below {:.3g} with 95 %\n", row.part, row.method,
                        row.settings, row.error, row.at_most);
  text += fmt::format("{:<9} {:.3g} ms expected, below {:.3g} with 95 %{}\n", "frame", *choice.expected_ms,
                      choice.at_most_ms,
                      wanted.frame_ms > 0 ? fmt::format(", {:g} allowed", wanted.frame_ms) : std::string());
  if (wanted.memory_mb > 0)
    text += fmt::format("{:<9} {:.3g} MB expected, {:g} allowed\n", "memory", 1e-6 * choice.expected_bytes,
                        wanted.memory_mb);
  return text;
}

}  // namespace cuticle::plan
